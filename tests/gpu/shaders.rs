//! Every pass composes, validates with no optional capability, and translates to what each backend needs.

use std::{
    collections::{BTreeMap, BTreeSet},
    process::Command,
};

use naga::{
    Module, ShaderStage,
    back::{PipelineConstants, glsl, hlsl, msl, pipeline_constants::process_overrides, spv},
    proc::BoundsCheckPolicies,
    valid::ModuleInfo,
};

use soapfilm::gpu::{
    kernel::{Entries, Kernel},
    passes::kernels,
    pipelines::SHARED_CONSTANTS,
};

use crate::{
    passes::{entries_together, parse, validate},
    support::{REQUIRE_TOOLS, has_tools},
};

/// Values for the constants that a module declares.
fn specialisations(kernel: &Kernel, module: &Module) -> Result<Vec<PipelineConstants>, String> {
    let shared: Vec<_> = SHARED_CONSTANTS.iter().map(|(name, value)| (*name, *value)).collect();
    let mut declared = BTreeSet::new();
    for (_, constant) in module.overrides.iter() {
        let name = constant.name.as_deref().unwrap_or_default();
        let own = kernel.overrides.iter().any(|constant| constant.name == name && !constant.values.is_empty());
        if !own && shared.iter().all(|(known, _)| *known != name) {
            return Err(format!("{}: no values to test for `{name}`", kernel.pass));
        }
        if constant.init.is_some() {
            return Err(format!("{}: `{name}` has a default: a value that is forgotten must be refused", kernel.pass));
        }
        declared.insert(name);
    }
    let of_all = shared.into_iter().filter(|(name, _)| declared.contains(name));
    let whole = |own: BTreeMap<&'static str, u32>| {
        own.into_iter().chain(of_all.clone()).map(|(name, value)| (name.to_owned(), f64::from(value))).collect()
    };
    Ok(kernel.specialisations(|name| declared.contains(name)).into_iter().map(whole).collect())
}

/// Runs a check on each specialised entry point of each kernel and fails with all that went wrong.
fn for_each_entry_point(check: impl Fn(&str, &Module, &ModuleInfo, (ShaderStage, &str)) -> Result<(), String>) {
    let (mut failures, mut checks) = (Vec::new(), 0);
    let kernels = kernels();
    for kernel in &kernels {
        let pass = kernel.pass;
        let done = (|| {
            let module = parse(pass)?;
            let info = validate(pass, &module)?;
            for constants in specialisations(kernel, &module)? {
                for (stage, entry) in entries_together(kernel).into_iter().flatten() {
                    let (module, info) = process_overrides(&module, &info, Some((stage, entry)), &constants)
                        .map_err(|error| format!("{pass}: {entry} with {constants:?}: {error}"))?;
                    check(pass, &module, &info, (stage, entry)).map_err(|error| format!("{pass}: {entry}: {error}"))?;
                    checks += 1;
                }
            }
            Ok::<(), String>(())
        })();
        failures.extend(done.err());
    }
    assert!(failures.is_empty(), "{} of {} kernels fail:\n{}", failures.len(), kernels.len(), failures.join("\n"));
    assert!(checks >= kernels.len(), "only {checks} entry points were checked");
}

fn spirv(module: &Module, info: &ModuleInfo, (stage, entry): (ShaderStage, &str)) -> Result<Vec<u32>, String> {
    let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: entry.to_owned() };
    let options = spv::Options { lang_version: (1, 3), ..Default::default() };
    spv::write_vec(module, info, &options, Some(&pipeline)).map_err(|error| error.to_string())
}

#[test]
fn every_pass_becomes_spirv() {
    for_each_entry_point(|_, module, info, entry| {
        let words = spirv(module, info, entry)?;
        if words.len() > 20 { Ok(()) } else { Err("empty module".to_owned()) }
    });
}

#[test]
fn every_pass_becomes_msl() {
    for_each_entry_point(|_, module, info, (stage, entry)| {
        let pipeline = msl::PipelineOptions { entry_point: Some((stage, entry.to_owned())), ..Default::default() };
        // Metal 2.0: what macOS 10.13 has.
        let options = msl::Options { lang_version: (2, 0), ..Default::default() };
        msl::write_string(module, info, &options, &pipeline).map(|_| ()).map_err(|error| error.to_string())
    });
}

#[test]
fn every_pass_becomes_hlsl() {
    for_each_entry_point(|_, module, info, (stage, entry)| {
        let pipeline = hlsl::PipelineOptions { entry_point: Some((stage, entry.to_owned())) };
        let options = hlsl::Options::default();
        let mut text = String::new();
        let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
        writer.write(module, info, None).map(|_| ()).map_err(|error| error.to_string())
    });
}

#[test]
fn every_pass_becomes_glsl() {
    for_each_entry_point(|_, module, info, (stage, entry)| {
        let pipeline = glsl::PipelineOptions { shader_stage: stage, entry_point: entry.to_owned(), multiview: None };
        let options = glsl::Options::default();
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)
            .and_then(|mut writer| writer.write())
            .map(|_| ())
            .map_err(|error| error.to_string())
    });
}

/// Where the tool is there, somebody else's validator reads the SPIR-V too.
#[test]
fn spirv_val_agrees() {
    if !has_tools(&["spirv-val"], REQUIRE_TOOLS) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pass.spv");
    for_each_entry_point(|_, module, info, entry| {
        let words = spirv(module, info, entry)?;
        std::fs::write(&file, bytemuck::cast_slice::<u32, u8>(&words)).map_err(|error| error.to_string())?;
        let told = Command::new("spirv-val").args(["--target-env", "vulkan1.1"]).arg(&file).output();
        let told = told.map_err(|error| error.to_string())?;
        if told.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&told.stderr).into_owned()) }
    });
}

#[test]
fn a_broken_pass_would_be_noticed() {
    let module =
        naga::front::wgsl::parse_str("override N: u32; @compute @workgroup_size(1) fn f() { _ = N; }").unwrap();
    let info = validate("tonemap", &module).unwrap();
    assert!(process_overrides(&module, &info, None, &PipelineConstants::default()).is_err(), "a missing constant");
    let entries = Entries::Compute(vec!["f"]);
    let kernel = Kernel { pass: "made up", entries, bindings: vec![], overrides: vec![] };
    assert!(specialisations(&kernel, &module).unwrap_err().contains("`N`"));
    let needs_features = naga::front::wgsl::parse_str("@group(0) @binding(0) var t: texture_cube_array<f32>;").unwrap();
    assert!(validate("tonemap", &needs_features).is_err(), "an optional capability");
}
