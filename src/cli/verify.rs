//! `soapfilm verify`: measures this machine's GPU against the references.

use std::{path::PathBuf, sync::Arc};

use clap::Args;
use serde_json::json;

use super::{AdapterArguments, PHYSICS_IS_LESS_CERTAIN, failure, progress::Bar};
use crate::{
    export::Progress,
    gpu::Gpu,
    input::load_scene,
    output::{check_target, print, write_text},
    plan::Resources,
    scene::Scene,
    verify::{Check, Extent, Part, Run},
};

/// Measure this machine's GPU against the references; fails if a check fails
#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm verify\n  soapfilm verify optics picture --json checks.json")]
pub struct Arguments {
    /// What to verify: some of optics, picture, crowd, transport, flow, rims and stability, or all
    #[arg(default_value = "all", value_name = "PART", value_parser = parts)]
    parts: Vec<Parts>,
    /// Also run the checks that take longer than minutes
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
    arguments.json.as_deref().map_or(Ok(()), check_target)?;
    let gpu = arguments.adapter.open()?;
    let checks = measure(arguments, &gpu)?;
    if let Some(path) = &arguments.json {
        write_text(path, &serde_json::to_string_pretty(&document(&gpu, &checks))?)?;
    }
    let failed: Vec<&str> = checks.iter().filter(|check| !check.passed()).map(|check| check.name.as_str()).collect();
    anyhow::ensure!(failed.is_empty(), "{} of {} checks failed: {}", failed.len(), checks.len(), failed.join("; "));
    Ok(print(format_args!("all {} checks passed\n", checks.len()))?)
}

/// Runs the parts and prints each check.
fn measure(arguments: &Arguments, gpu: &Gpu) -> anyhow::Result<Vec<Check>> {
    let parts: Vec<Part> = arguments.parts.iter().flat_map(|parts| parts.0.iter().copied()).collect();
    let bar = Arc::new(Bar::new("verify"));
    let progress = Progress::new(parts.iter().map(|part| part.seconds()).sum(), bar.clone());
    let print = |line: &str| bar.print(|| print(format_args!("{line}\n")));
    print(&format!("{:<5} {:<WIDTH$} {:>9} {:>9}", "", "check", "measured", "at most"))?;
    let mut checks: Vec<Check> = Vec::new();
    for part in &parts {
        let done = progress.parts(part.seconds(), part.checks());
        let mut report = |check: Check| {
            // Minutes of measuring would follow without a reader; no file has been begun.
            print(&line(&check)).unwrap_or_else(|error| std::process::exit(failure::report(&error.into()).into()));
            done.add(1);
            checks.push(check);
        };
        let extent = if arguments.long { Extent::Long } else { Extent::Full };
        Run { gpu, extent, preset: &preset, report: &mut report }.part(*part)?;
    }
    if parts.iter().any(|part| matches!(part, Part::Optics | Part::Picture)) {
        print(PHYSICS_IS_LESS_CERTAIN)?;
    }
    Ok(checks)
}

/// A preset, with all that it names.
fn preset(name: &str) -> Option<(Scene, Resources)> {
    // Each preset loads, as a test shows; without this one its checks fail.
    load_scene(name).ok().map(|loaded| (loaded.scene, loaded.resources))
}

/// Characters of a check's name; longer ones move the numbers to the right.
const WIDTH: usize = 80;

/// A check as a line of text.
fn line(check: &Check) -> String {
    let verdict = if check.passed() { "pass" } else { "FAIL" };
    let [measured, limit] = [check.measured, check.limit].map(readable);
    format!("{verdict:<5} {:<WIDTH$} {measured:>9} {limit:>9} {}", check.name, check.unit()).trim_end().to_owned()
}

/// A number with three significant digits.
fn readable(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    // Rounded first, so that 0.9996 is 1.00 and not 1.000.
    let rounded = format!("{value:.2e}");
    let Some((_, exponent)) = rounded.split_once('e') else { return rounded };
    match exponent.parse::<i32>() {
        Ok(exponent @ -3..=5) => format!("{value:.*}", (2 - exponent).max(0) as usize),
        _ => rounded,
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let written = [
            (0.0, "0"),
            (1.0, "1.00"),
            (0.9996, "1.00"),
            (-0.012_345, "-0.0123"),
            (0.001, "0.00100"),
            (0.000_999_9, "0.00100"),
            (0.000_123, "1.23e-4"),
            (12.34, "12.3"),
            (1234.5, "1234"),
            (123_456.0, "123456"),
            (2.5e7, "2.50e7"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in written {
            assert_eq!(readable(value), text);
        }
    }

    #[test]
    fn lines_say_pass_or_fail_and_the_unit() {
        let line = |name: &str, measured| line(&Check::at_most(name, measured, 0.5));
        assert!(line("water: dE2000 mean", 0.25).starts_with("pass  water: dE2000 mean"));
        assert!(line("water: dE2000 mean", 0.25).ends_with("    0.250     0.500 dE2000"));
        assert!(line("drift of mass", 0.75).starts_with("FAIL  drift of mass"));
        assert!(line("drift of mass", f64::NAN).ends_with("      NaN     0.500"));
    }
}
