//! Every pass as naga sees it.

use naga::{
    Module, ShaderStage,
    valid::{Capabilities, ModuleInfo, ValidationFlags, Validator},
};
use soapfilm::gpu::{
    kernel::{Entries, Kernel},
    shaders::Library,
};

/// Names of the files of a folder of `shaders/`, without the ending.
pub fn file_names(folder: &str) -> Vec<String> {
    let folder = format!("{}/shaders/{folder}", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path().with_extension(""));
    let mut names: Vec<_> = files.map(|path| path.file_name().unwrap().to_str().unwrap().to_owned()).collect();
    names.sort();
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

/// Entry points of a kernel, those together that make a pipeline.
pub fn entries_together(kernel: &Kernel) -> Vec<Vec<(ShaderStage, &'static str)>> {
    match &kernel.entries {
        Entries::Compute(entries) => entries.iter().map(|entry| vec![(ShaderStage::Compute, *entry)]).collect(),
        Entries::Draw { vertices, fragment } => {
            let with_fragment = |vertex| vec![(ShaderStage::Vertex, vertex), (ShaderStage::Fragment, *fragment)];
            vertices.iter().copied().map(with_fragment).collect()
        }
    }
}
