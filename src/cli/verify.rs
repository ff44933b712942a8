//! `soapfilm verify`: measures this machine's GPU against the references.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::{AdapterArguments, PHYSICS_IS_LESS_CERTAIN};
use crate::{
    gpu::Gpu,
    output::write_text,
    verify::{Check, Extent, Part, Run},
};

/// Measure this machine's GPU against the references; fails if a check does
#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm verify\n  soapfilm verify optics picture --json checks.json")]
pub struct Arguments {
    /// What to verify: some of optics, picture, transport, flow, rims and stability, or all of them
    #[arg(default_value = "all", value_name = "PART", value_parser = parts)]
    parts: Vec<Parts>,
    /// Run the checks that take longer than minutes too
    #[arg(long)]
    long: bool,
    /// Write the checks to a JSON file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

#[derive(Clone)]
struct Parts(Vec<Part>);

fn parts(name: &str) -> Result<Parts, String> {
    if name == "all" {
        return Ok(Parts(Part::ALL.to_vec()));
    }
    let named = Part::ALL.iter().find(|part| part.name() == name).ok_or_else(|| {
        let known: Vec<_> = Part::ALL.iter().map(|part| part.name()).collect();
        format!("use one of {}, all", known.join(", "))
    })?;
    Ok(Parts(vec![*named]))
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let gpu = arguments.adapter.open()?;
    let mut checks: Vec<Check> = Vec::new();
    println!("{:<72} {:>12} {:>12}", "check", "measured", "limit");
    let mut report = |check: Check| {
        let verdict = if check.passed() { "" } else { "  FAILED" };
        println!("{:<72} {:>12.4e} {:>12.4e}{verdict}", check.name, check.measured, check.limit);
        checks.push(check);
    };
    let extent = if arguments.long { Extent::Long } else { Extent::Full };
    let mut run = Run { gpu: &gpu, extent, report: &mut report };
    let parts: Vec<Part> = arguments.parts.iter().flat_map(|parts| parts.0.iter().copied()).collect();
    for part in &parts {
        run.part(*part)?;
    }
    if parts.iter().any(|part| matches!(part, Part::Optics | Part::Picture)) {
        println!("{PHYSICS_IS_LESS_CERTAIN}");
    }
    if let Some(path) = &arguments.json {
        write_text(path, &serde_json::to_string_pretty(&document(&gpu, &checks))?)?;
    }
    let failed = checks.iter().filter(|check| !check.passed()).count();
    anyhow::ensure!(failed == 0, "{failed} of {} checks failed", checks.len());
    Ok(())
}

fn document(gpu: &Gpu, checks: &[Check]) -> serde_json::Value {
    let rows = checks.iter().map(|check| {
        let Check { name, measured, limit } = check;
        json!({ "name": name, "measured": measured, "limit": limit, "passed": check.passed() })
    });
    json!({
        "adapter": gpu.adapter_name(),
        "driver": gpu.driver(),
        "physics": PHYSICS_IS_LESS_CERTAIN,
        "checks": rows.collect::<Vec<_>>(),
    })
}
