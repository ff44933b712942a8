//! `soapfilm flow`: the flow solver against flows whose answer is known, on the GPU.

use std::{ops::RangeInclusive, path::PathBuf};

use clap::Args;
use glam::DVec3;
use serde_json::{Value, json};

use super::{AdapterArguments, parse, progress::progress};
use crate::{
    gpu::{
        flow::Cycles,
        flow_case::{FlowOutcome, FlowRun},
    },
    output::{check_target, print, write_text},
    physics::flow::{FlowCase, FlowCaseKind, Mode},
};

/// Run a test of the flow solver against an exact solution on the unit sphere.
#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm flow --case rossby-haurwitz --cells 64 --steps 80 --json norms.json")]
pub struct Arguments {
    /// The test case
    #[arg(long, value_name = "rossby-haurwitz|stationary|sloshing|decay|poisson")]
    case: FlowCaseKind,
    /// Cells along an edge of the cube
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=512))]
    cells: u32,
    /// Steps per wavelength, turn, period or e-folding
    #[arg(long, value_name = "M", default_value_t = 80, value_parser = clap::value_parser!(u32).range(4..=1_000_000))]
    steps: u32,
    /// Number of wavelengths, turns, periods or e-foldings
    #[arg(long, value_name = "R", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=4_000))]
    repeat: u32,
    /// Degree of the harmonic of sloshing, decay and poisson [default: 1 for sloshing, else 5]
    #[arg(long, value_name = "L")]
    degree: Option<u32>,
    /// Order of this harmonic [default: 1 for sloshing, else 4, or the degree if it is smaller]
    #[arg(long, value_name = "m")]
    order: Option<u32>,
    /// Axis of the flow; of gravity in sloshing, upwards
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,1", value_parser = parse::direction, allow_hyphen_values = true)]
    axis: DVec3,
    /// ω, the solid rotation of rossby-haurwitz and stationary
    #[arg(long, value_name = "W", default_value_t = 1.0, value_parser = parse::within(LARGEST), allow_hyphen_values = true)]
    omega: f64,
    /// K, the strength of the wave, or of the P₃ of the jet [default: 1 for rossby-haurwitz, 0.1 for stationary]
    #[arg(long, value_name = "K", value_parser = parse::within(LARGEST), allow_hyphen_values = true)]
    k: Option<f64>,
    /// a of ln h = -a z in sloshing; negative: upside down and unstable
    #[arg(long, value_name = "A", default_value_t = 1.0, value_parser = parse::within(-20.0..=20.0), allow_hyphen_values = true)]
    stratification: f64,
    /// Drag of the air in sloshing, 1/s
    #[arg(long, value_name = "ALPHA", default_value_t = 0.0, value_parser = parse::within(0.0..=1e6))]
    drag: f64,
    /// Write the norms to a JSON file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// What a GPU's numbers bear of speeds: their squares are summed.
const LARGEST: RangeInclusive<f64> = -1e6..=1e6;

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let case = case(arguments)?;
    arguments.json.as_deref().map_or(Ok(()), check_target)?;
    let run = FlowRun {
        case,
        cells: arguments.cells,
        steps_per_span: arguments.steps,
        spans: arguments.repeat,
        cycles: Cycles::default(),
    };
    let gpu = arguments.adapter.open()?;
    let progress = progress("flow", 1);
    let part = progress.part(run.all_steps().into());
    let outcome = run.measure_watched(&gpu, &|steps| part.add(steps))?;
    drop(progress);
    anyhow::ensure!(
        is_finite(&outcome),
        "the flow is no longer finite on the GPU: take more --steps, or weaker driving"
    );
    let mut line = format!("{}: l2 {:.3e}", case.kind().name(), outcome.l2);
    if outcome.energy_drift.is_finite() {
        line += &format!(", energy drift {:.2e}", outcome.energy_drift);
    }
    if let (FlowCaseKind::Sloshing, Some(found)) = (case.kind(), outcome.oscillation) {
        line += &format!("; frequency {:.6} (exact {:.6})", found.frequency, case.frequency());
        line += &format!(", growth {:.6} (exact {:.6})", found.growth, case.growth());
    }
    let cpu_ms = outcome.cpu.as_secs_f64() * 1e3;
    print(format_args!("{line}; {} dispatches and {cpu_ms:.2} ms of process CPU per step\n", outcome.dispatches))?;
    if let Some(path) = &arguments.json {
        write_text(path, &serde_json::to_string_pretty(&report(arguments, &case, &outcome))?)?;
    }
    Ok(())
}

/// Whether a run has an answer. What a case has no answer for, as a drift of nothing, does not count.
fn is_finite(outcome: &FlowOutcome) -> bool {
    let found = outcome.oscillation.map_or([0.0; 2], |found| [found.frequency, found.growth]);
    [outcome.l2, found[0], found[1]].iter().all(|number| number.is_finite())
}

fn case(arguments: &Arguments) -> anyhow::Result<FlowCase> {
    let sloshes = arguments.case == FlowCaseKind::Sloshing;
    let degree = arguments.degree.unwrap_or(if sloshes { 1 } else { 5 });
    let order = arguments.order.unwrap_or(if sloshes { 1 } else { 4.min(degree) });
    let default = if arguments.case == FlowCaseKind::RossbyHaurwitz { 1.0 } else { 0.1 };
    let (mode, k) = (Mode::new(degree, order, u32::from(sloshes))?, arguments.k.unwrap_or(default));
    anyhow::ensure!(
        !sloshes || arguments.stratification != 0.0,
        "without stratification nothing sloshes: use a value other than 0"
    );
    let case = FlowCase::new(arguments.case, arguments.axis, mode, arguments.omega, k)?;
    Ok(case.with_film(arguments.stratification, arguments.drag))
}

/// The norms; what a case has no answer for is null.
fn report(arguments: &Arguments, case: &FlowCase, outcome: &FlowOutcome) -> Value {
    let number = |value: f64| value.is_finite().then_some(value);
    let mut report = json!({
        "case": case.kind().name(),
        "cells": arguments.cells,
        "steps": arguments.steps,
        "repeat": arguments.repeat,
        "l2": number(outcome.l2),
        "energy_drift": number(outcome.energy_drift),
        "enstrophy_drift": number(outcome.enstrophy_drift),
        "angular_momentum_drift": number(outcome.angular_momentum_drift),
        "dispatches_per_step": outcome.dispatches,
        "cpu_ms_per_step": outcome.cpu.as_secs_f64() * 1e3,
        "wall_ms_per_step": outcome.wall.as_secs_f64() * 1e3,
    });
    if case.kind() == FlowCaseKind::Sloshing {
        report["frequency"] = json!(outcome.oscillation.map(|found| found.frequency));
        report["frequency_exact"] = json!(case.frequency());
        report["growth"] = json!(outcome.oscillation.map(|found| found.growth));
        report["growth_exact"] = json!(case.growth());
    }
    report
}
