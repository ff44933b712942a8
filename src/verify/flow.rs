//! The flow solver against flows whose answer is known, and against its f64 twin's order of accuracy.

use glam::DVec3;

use super::{Run, phenomena, sorting};
use crate::{
    gpu::{
        GpuError,
        flow::Cycles,
        flow_case::{FlowOutcome, FlowRun},
    },
    physics::flow::{FlowCase, FlowCaseKind, Mode},
};

/// A case about an axis; its numbers are right by construction, and both constructors say so.
fn case(kind: FlowCaseKind, axis: DVec3, (degree, order): (u32, u32), k: f64) -> Option<FlowCase> {
    FlowCase::new(kind, axis.normalize(), Mode::new(degree, order, 0).ok()?, 1.0, k).ok()
}

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    rossby_haurwitz(run)?;
    stationary(run)?;
    poisson(run)?;
    decay(run)?;
    sloshing(run)?;
    sorting::run(run)?;
    phenomena::run(run)
}

/// Measures a case, if there is one.
fn measured(
    run: &Run<'_>,
    case: Option<FlowCase>,
    cells: u32,
    steps: u32,
    spans: u32,
) -> Result<Option<FlowOutcome>, GpuError> {
    let outcome =
        |case| FlowRun { case, cells, steps_per_span: steps, spans, cycles: Cycles::default() }.measure(run.gpu);
    case.map(outcome).transpose()
}

fn rossby_haurwitz(run: &mut Run<'_>) -> Result<(), GpuError> {
    let wave = |axis| case(FlowCaseKind::RossbyHaurwitz, axis, (1, 1), 1.0);
    for (name, axis) in [("Rossby-Haurwitz wave", DVec3::Z), ("the same about (1,1,1)", DVec3::ONE)] {
        if let Some(found) = measured(run, wave(axis), 64, 80, 1)? {
            run.at_most(format!("{name}, one wavelength, l2 of vorticity"), found.l2, 0.023);
        }
    }
    if let Some(found) = measured(run, wave(DVec3::Z), 64, 80, 2)? {
        run.at_most("Rossby-Haurwitz wave, two wavelengths, energy drift", found.energy_drift.abs(), 0.01);
    }
    Ok(())
}

fn stationary(run: &mut Run<'_>) -> Result<(), GpuError> {
    let oblique = DVec3::new(0.9, -0.3, 0.5);
    for (name, axis, k, limit) in [
        ("solid rotation about (1,1,1)", DVec3::ONE, 0.0, 1e-3),
        ("a jet about (1,1,1)", DVec3::ONE, 0.1, 5e-3),
        ("a jet about (0.9,-0.3,0.5)", oblique, 0.1, 5e-3),
    ] {
        let turns = if run.is_long() || axis == DVec3::ONE { 10 } else { 2 };
        if let Some(found) = measured(run, case(FlowCaseKind::Stationary, axis, (1, 1), k), 64, 80, turns)? {
            run.at_most(format!("{name}, {turns} turns, l2 of vorticity"), found.l2, limit);
        }
    }
    Ok(())
}

fn poisson(run: &mut Run<'_>) -> Result<(), GpuError> {
    let harmonic = || case(FlowCaseKind::Poisson, DVec3::Z, (5, 4), 1.0);
    let (coarse, fine) = (measured(run, harmonic(), 32, 4, 1)?, measured(run, harmonic(), 64, 4, 1)?);
    if let (Some(coarse), Some(fine)) = (coarse, fine) {
        run.at_most("Poisson's equation, N = 64, l2 of the stream function", fine.l2, 1e-4);
        run.at_most("the same over N = 32: a quarter for second order", fine.l2 / coarse.l2, 0.25);
    }
    Ok(())
}

fn decay(run: &mut Run<'_>) -> Result<(), GpuError> {
    for mode in [(2, 0), (5, 3)] {
        if let Some(found) = measured(run, case(FlowCaseKind::Decay, DVec3::ONE, mode, 0.0), 32, 40, 1)? {
            run.at_most(format!("viscous decay of ({}, {}), one e-folding, l2", mode.0, mode.1), found.l2, 3e-3);
        }
    }
    Ok(())
}

fn sloshing(run: &mut Run<'_>) -> Result<(), GpuError> {
    let slosh = |mode, a, drag| case(FlowCaseKind::Sloshing, DVec3::Z, mode, 0.0).map(|case| case.with_film(a, drag));
    for (mode, drag) in [((1, 1), 0.0), ((2, 1), 0.0), ((3, 2), 0.0), ((4, 4), 0.0), ((3, 2), 0.4)] {
        let case = slosh(mode, 1.0, drag);
        if let (Some(case), Some(found)) = (case, measured(run, case, 32, 80, 1)?) {
            let frequency = found.oscillation.map_or(f64::NAN, |found| found.frequency);
            let name = format!("sloshing mode ({}, {}), drag {drag}: error of the frequency", mode.0, mode.1);
            run.at_most(name, (frequency / case.frequency() - 1.0).abs(), 2e-3);
        }
    }
    let case = slosh((3, 2), -1.0, 0.0);
    if let (Some(case), Some(found)) = (case, measured(run, case, 32, 40, 2)?) {
        let growth = found.oscillation.map_or(f64::NAN, |found| found.growth);
        run.at_most("Rayleigh-Taylor growth, relative error", (growth / case.growth() - 1.0).abs(), 0.02);
    }
    Ok(())
}
