//! `soapfilm info`: adapters, drivers, limits, features.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::AdapterArguments;
use crate::{
    gpu::{Gpu, device::OPTIONAL_FEATURES},
    output::{print, write_text},
};

/// List the graphics adapters and what soapfilm uses of them.
#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm info --json info.json")]
pub struct Arguments {
    /// Also write it all to a JSON file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let gpu = arguments.adapter.open()?;
    let report = report(&gpu);
    print(format_args!("soapfilm {}\n", env!("CARGO_PKG_VERSION")))?;
    for adapter in report["adapters"].as_array().into_iter().flatten() {
        let [name, backend, kind] = ["name", "backend", "type"].map(|key| text(&adapter[key]));
        print(format_args!("found     {name} ({backend}, {kind})\n"))?;
    }
    print(format_args!("uses      {}, driver {}\n", text(&report["adapter"]), text(&report["driver"])))?;
    print(format_args!("features  {}\n", text(&report["features"])))?;
    print(format_args!("limits    {}\n", report["limits"]))?;
    if let Some(path) = &arguments.json {
        write_text(path, &serde_json::to_string_pretty(&report)?)?;
    }
    Ok(())
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

fn report(gpu: &Gpu) -> Value {
    let adapters = pollster::block_on(gpu.instance.enumerate_adapters(wgpu::Backends::all()));
    let adapters: Vec<Value> = adapters.iter().map(|adapter| describe(&adapter.get_info())).collect();
    let limits = gpu.device.limits();
    let features: Vec<Value> = OPTIONAL_FEATURES
        .iter_names()
        .map(|(name, feature)| json!({ "name": name, "used": gpu.device.features().contains(feature) }))
        .collect();
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "adapters": adapters,
        "adapter": gpu.adapter_name(),
        "driver": gpu.driver(),
        "features": features,
        "limits": {
            "max_texture_dimension_2d": limits.max_texture_dimension_2d,
            "max_storage_buffer_binding_size": limits.max_storage_buffer_binding_size,
            "max_buffer_size": limits.max_buffer_size,
        },
    })
}

fn describe(info: &wgpu::AdapterInfo) -> Value {
    json!({
        "name": info.name,
        "backend": format!("{:?}", info.backend),
        "type": format!("{:?}", info.device_type),
        "driver": format!("{} {}", info.driver, info.driver_info).trim(),
    })
}
