//! Every pass as naga sees it.

use naga::{
    Module, ShaderStage,
    valid::{Capabilities, ModuleInfo, ValidationFlags, Validator},
};
use soapfilm::gpu::shaders::{Library, SOURCES};

/// Names of the passes: one for each file in `shaders/pass/`.
pub fn names() -> Vec<&'static str> {
    let names: Vec<_> = SOURCES.iter().filter_map(|(name, _)| name.strip_prefix("pass/")).collect();
    assert!(!names.is_empty(), "no passes found");
    names
}

/// Composes and parses a pass; the message of a failure names it.
pub fn parse(pass: &str) -> Result<Module, String> {
    let composed = Library::Embedded.compose(pass).map_err(|error| format!("{pass}: {error}"))?;
    naga::front::wgsl::parse_str(&composed.wgsl).map_err(|error| {
        let place = error.location(&composed.wgsl).map(|at| composed.place(at.line_number as usize));
        format!("{pass}: {}: {}", place.unwrap_or_default(), error.message())
    })
}

/// Validates a pass under what WebGPU guarantees everywhere: no optional feature at all.
pub fn validate(pass: &str, module: &Module) -> Result<ModuleInfo, String> {
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(module)
        .map_err(|error| format!("{pass}: {}", error.emit_to_string(&Library::Embedded.compose(pass).unwrap().wgsl)))
}

/// Entry points of a pass.
pub fn entry_points(module: &Module) -> Vec<(ShaderStage, String)> {
    module.entry_points.iter().map(|entry| (entry.stage, entry.name.clone())).collect()
}
