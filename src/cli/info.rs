//! `soapfilm info`: adapters, drivers, limits, features.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::AdapterArguments;
use crate::{
    gpu::{Gpu, device::OPTIONAL_FEATURES},
    output::{print, write_text},
};

/// List the graphics adapters and the features that soapfilm uses.
#[derive(Args)]
#[command(after_help = "Examples:\n  soapfilm info\n  soapfilm info --json\n  soapfilm info --json info.json")]
pub struct Arguments {
    /// Print JSON instead of text, or write it to a file besides the text
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    json: Option<Option<PathBuf>>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let gpu = arguments.adapter.open()?;
    let report = report(&gpu);
    let json = format!("{report:#}");
    match &arguments.json {
        Some(None) => print(format_args!("{json}\n"))?,
        Some(Some(path)) => {
            write_text(path, &json)?;
            print(for_people(&report))?;
        }
        None => print(for_people(&report))?,
    }
    Ok(())
}

/// The report in lines.
fn for_people(report: &Value) -> String {
    let mut lines = vec![format!("soapfilm {}", text(&report["version"]))];
    for adapter in list(&report["adapters"]) {
        let [name, backend, kind] = ["name", "backend", "type"].map(|key| text(&adapter[key]));
        lines.push(format!("found      {name} ({backend}, {kind})"));
    }
    lines.push(format!("uses       {}, driver {}", text(&report["adapter"]), text(&report["driver"])));
    for feature in list(&report["features"]) {
        let used = if feature["used"] == true { "used" } else { "not available; soapfilm works without it" };
        lines.push(format!("feature    {}: {used}", text(&feature["name"])));
    }
    let limit = |name: &str| report["limits"][name].as_u64().unwrap_or(0);
    lines.push(format!("textures   up to {} pixels per side", limit("max_texture_dimension_2d")));
    lines.push(format!("buffers    up to {}", bytes(limit("max_buffer_size"))));
    lines.push(format!("bindings   of storage up to {}", bytes(limit("max_storage_buffer_binding_size"))));
    lines.join("\n") + "\n"
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or("unknown")
}

/// A number of bytes in the largest unit that it fills.
fn bytes(count: u64) -> String {
    let units = [("TiB", 40), ("GiB", 30), ("MiB", 20), ("KiB", 10)];
    let unit = units.into_iter().find(|(_, shift)| count >> shift > 0);
    unit.map_or_else(|| format!("{count} bytes"), |(name, shift)| format!("{} {name}", count >> shift))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_have_units() {
        assert_eq!(
            [0, 1023, 1024, 128 << 20, 5 << 30].map(bytes),
            ["0 bytes", "1023 bytes", "1 KiB", "128 MiB", "5 GiB"]
        );
    }

    #[test]
    fn people_get_text() {
        let report = json!({
            "version": "1.2.3",
            "adapters": [{ "name": "A", "backend": "Vulkan", "type": "Cpu", "driver": "d" }],
            "adapter": "A (Vulkan)",
            "driver": "d 1",
            "features": [{ "name": "TIMESTAMP_QUERY", "used": true }],
            "limits": { "max_texture_dimension_2d": 8192, "max_buffer_size": 1 << 28, "max_storage_buffer_binding_size": 1 << 27 },
        });
        let text = for_people(&report);
        assert!(text.contains("found      A (Vulkan, Cpu)\nuses       A (Vulkan), driver d 1\n"), "{text}");
        assert!(text.contains("TIMESTAMP_QUERY: used") && text.contains("128 MiB") && !text.contains('{'), "{text}");
    }
}
