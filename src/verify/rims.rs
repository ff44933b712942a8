//! Films that end somewhere, on a bath, on a ring, at a drop: what flows there, what leaves, and what rises from the rim.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::{
    Run,
    free_film::{FreeFilm, RULES, field},
    played::largest,
};
use crate::{
    gpu::{Gpu, GpuError, film::Rules, flow::FlowSolver, grid::film_areas, readback::Readback, timing::Recorder},
    physics::{
        film::{
            Cap, InitialFilm, PrescribedFlow, Regeneration,
            model::DrainLaw,
            patch_speed,
            properties::{DENSITY, Drainage, VISCOSITY},
        },
        flow::{FlowCase, FlowCaseKind, FlowForces, Mode, fit_oscillation},
        sphere::{HaloTable, PaddedField},
    },
};

/// That of the earth on a bubble of [`RADIUS_M`], 1/s².
const GRAVITY: DVec3 = DVec3::new(0.0, 0.0, -196.0);
const RADIUS_M: f64 = 9.80665 / 196.0;
const STEP_S: f64 = 1.0 / 60.0;
/// Liquid that sums in f32 may lose: some parts in ten million.
const LOSS: f64 = 1e-6;
/// Thickness at which nothing is left to drain, nm.
const BLACK_NM: f64 = 10.0;

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    half_a_film(run)?;
    tight(run)?;
    image(run)?;
    drop(run)?;
    drainage(run)?;
    patch(run)?;
    regeneration(run)
}

/// A fresh film of 700 nm that sorts itself.
fn fresh<'a>(run: &Run<'a>, cells: usize, cap: Option<Cap>, drop_rad: Option<f64>) -> Result<FreeFilm<'a>, GpuError> {
    let film = InitialFilm::Blown { thickness_nm: 700.0, stratification: 0.0, seed: 1 }.profile();
    let forces = FlowForces { gravity: GRAVITY, drag: 2.0, air_drag: 0.0, viscosity: 0.04 };
    let field = field(run.gpu, cells, Rules { cap, drop_rad, ..RULES }, film)?;
    FreeFilm::new(run.gpu, field, forces, PrescribedFlow::draught(1, 1.0))
}

/// A field of the flow, in the order of its grid.
fn read(gpu: &Gpu, solver: &FlowSolver, buffer: &wgpu::Buffer) -> Result<Vec<f64>, GpuError> {
    let bytes = Readback::of_buffer(gpu, buffer, buffer.size()).wait(gpu)?;
    Ok(solver.inner(&bytemuck::pod_collect_to_vec(&bytes)).into_iter().map(f64::from).collect())
}

/// The stream functions of (2, 1) and (3, 2) are 0 on the equator: these modes of the whole film are modes of the half, at the same frequency.
fn half_a_film(run: &mut Run<'_>) -> Result<(), GpuError> {
    const STEPS: u32 = 60;
    let cap = Cap::HEMISPHERE;
    for (degree, order) in [(2, 1), (3, 2)].into_iter().take(run.short_or_full(1, 2)) {
        let mode = Mode::new(degree, order, 0).ok();
        let case = mode.and_then(|mode| FlowCase::new(FlowCaseKind::Sloshing, DVec3::Z, mode, 1.0, 0.0).ok());
        let Some(case) = case.map(|case| case.with_film(1.0, 0.0)) else { continue };
        let dt = case.span_s() / f64::from(STEPS);
        let mut solver = FlowSolver::new(run.gpu, 32);
        solver.end_at(run.gpu, Some(cap));
        let grid = solver.sphere();
        let cells = |value: &dyn Fn(DVec3) -> f64| -> Vec<f32> {
            (0..grid.cells()).map(|cell| value(cap.folded(grid.cell_direction(cell))) as f32).collect()
        };
        run.gpu.upload(solver.log_thickness(), &solver.padded(&cells(&|x| case.log_thickness(x))));
        let mut recorder = Recorder::new(run.gpu);
        solver.seed(&mut recorder, &cells(&|x| case.zeta(x, -0.5 * dt)))?;
        recorder.submit(&Default::default());
        let (areas, mut samples) = (film_areas(grid, cap), Vec::new());
        for _ in 0..STEPS {
            let mut recorder = Recorder::new(run.gpu);
            solver.step(&mut recorder, dt, &case.forces())?;
            solver.carry_log_thickness(&mut recorder, dt)?;
            recorder.submit(&Default::default());
            let zeta = read(run.gpu, &solver, solver.zeta())?;
            let part = |cell: usize| areas[cell] * zeta[cell] * case.mode_at(grid.cell_direction(cell));
            samples.push((0..grid.cells()).map(part).sum());
        }
        let frequency = fit_oscillation(&samples, dt).map_or(f64::NAN, |found| found.frequency);
        let name = format!("a film on a bath, sloshing mode ({degree}, {order}): error of the frequency");
        run.at_most(name, (frequency / case.frequency() - 1.0).abs(), 2e-3);
    }
    Ok(())
}

/// The largest flux across any part of a circle of latitude, as a part of the largest between any two points above it.
fn leak(gpu: &Gpu, film: &FreeFilm<'_>, rim: f64) -> Result<f64, GpuError> {
    let solver = film.motion.flow();
    let (grid, psi) = (solver.sphere(), read(gpu, solver, solver.psi())?);
    let field = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| psi[cell]);
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), psi| (low.min(psi), high.max(psi)));
        high - low
    };
    let mut on_rim = (0..360).map(|k| {
        let (sin, cos) = (f64::from(k) * TAU / 360.0).sin_cos();
        field.bilinear(DVec3::new(rim.sin() * cos, rim.sin() * sin, rim.cos()))
    });
    let mut above = (0..grid.cells()).filter(|cell| grid.cell_direction(*cell).z > rim.cos()).map(|cell| psi[cell]);
    Ok(range(&mut on_rim) / range(&mut above))
}

/// Nothing flows across a rim, and no film is lost.
fn tight(run: &mut Run<'_>) -> Result<(), GpuError> {
    let rims = [("a bath", FRAC_PI_2, 2e-3), ("a ring at 126°", 2.2, 2e-2), ("a ring at 69°", 1.2, 2e-2)];
    let steps = run.short_or_full(6, 30);
    for (name, rim, limit) in rims.into_iter().take(run.short_or_full(2, 3)) {
        let cap = if rim == FRAC_PI_2 { Cap::HEMISPHERE } else { Cap::above(rim) };
        let mut film = fresh(run, 64, Some(cap), None)?;
        let (before, _) = film.liquid()?;
        film.run(steps, STEP_S)?;
        let early = leak(run.gpu, &film, rim)?;
        film.run(2 * steps, STEP_S)?;
        let (late, (after, _)) = (leak(run.gpu, &film, rim)?, film.liquid()?);
        run.at_most(format!("{name}: flow across its rim, part of the largest"), early.max(late), limit);
        run.at_most(format!("{name}: film gained or lost, part of it"), (after / before - 1.0).abs(), LOSS);
    }
    Ok(())
}

/// Each remap samples beyond the rim what is within, and each step makes the vorticity there its image.
fn image(run: &mut Run<'_>) -> Result<(), GpuError> {
    let mut film = fresh(run, run.short_or_full(32, 64), Some(Cap::HEMISPHERE), None)?;
    let steps = run.short_or_full(30, 120);
    film.run(steps, STEP_S)?;
    let solver = film.motion.flow();
    let (grid, zeta) = (solver.sphere(), read(run.gpu, solver, solver.zeta())?);
    let mirrored = |cell: usize, values: &[f64]| {
        let (panel, i, j) = grid.cell(cell);
        let panel = [0, 1, 2, 3, 5, 4][panel];
        values[(panel * grid.n() + grid.n() - 1 - j) * grid.n() + i]
    };
    let odd = largest((0..grid.cells()).map(|cell| (zeta[cell] + mirrored(cell, &zeta)).abs()))
        / largest(zeta.iter().map(|zeta| zeta.abs()));
    let nm = film.thickness()?;
    let even = largest((0..grid.cells()).map(|cell| (nm[cell] - mirrored(cell, &nm)).abs()));
    // Places of images are f32: a hundred-thousandth of a cell, across which both change by no more than themselves.
    let name = format!("a film on a bath after {steps} steps");
    run.at_most(format!("{name}: vorticity that is not odd, part of the largest"), odd, 1e-4);
    run.at_most(format!("{name}: thickness that is not even, nm"), even, 0.05);
    Ok(())
}

/// A drop holds the film fast: half a drop in from its rim nothing flows, but for what interpolation makes.
fn drop(run: &mut Run<'_>) -> Result<(), GpuError> {
    let radius = 15f64.to_radians();
    let mut leaks = [0.0; 2];
    for (drop_rad, found) in [None, Some(radius)].into_iter().zip(&mut leaks) {
        let mut film = fresh(run, 64, None, drop_rad)?;
        let (before, _) = film.liquid()?;
        film.run(60, STEP_S)?;
        let name = if drop_rad.is_some() { "a film with a drop" } else { "a film without a drop" };
        run.at_most(format!("{name}: film gained or lost, part of it"), (film.liquid()?.0 / before - 1.0).abs(), LOSS);
        *found = leak(run.gpu, &film, PI - 0.5 * radius)?;
    }
    let [free, held] = leaks;
    run.at_most("flow through the middle of a drop, part of the largest", held, 1e-3);
    run.at_most("flow through the middle of a drop, over the flow of a film without a drop", held / free, 0.1);
    Ok(())
}

/// Drainage alone, fifteen hundred times as fast as in life, from 2 µm everywhere: the thickness is the exact one, and what the film lacks
/// is in the drop or the bath.
fn drainage(run: &mut Run<'_>) -> Result<(), GpuError> {
    const FACTOR: f64 = 1500.0;
    const NM: f64 = 2000.0;
    let steps = run.short_or_full(40, 120);
    for (name, cap, drop_rad) in [("a drop", None, 0.1), ("a bath", Some(Cap::HEMISPHERE), 0.0)] {
        let even = field(run.gpu, run.short_or_full(32, 64), Rules { cap, ..RULES }, |_| NM)?;
        let mut film = FreeFilm::new(run.gpu, even, FlowForces::default(), PrescribedFlow::default())?;
        let flux = 1e-18 * FACTOR * DENSITY / (12.0 * VISCOSITY) * STEP_S;
        let law =
            DrainLaw { gravity: GRAVITY, flux, black_nm: BLACK_NM, drop_rad, patch_radius: 1.0, ..DrainLaw::default() };
        film.field.drain(Some((law, 4)));
        film.run(steps, STEP_S)?;
        let exact = Drainage { thickness_m: 1e-9 * NM, radius_m: RADIUS_M, viscosity: VISCOSITY };
        let time_s = FACTOR * STEP_S * f64::from(steps);
        let (grid, nm) = (film.sphere(), film.thickness()?);
        let error = largest((0..grid.cells()).filter_map(|cell| {
            let z = grid.cell_direction(cell).z;
            (z > 0.05).then(|| (nm[cell] / (1e9 * exact.thickness_m(z.acos(), time_s)) - 1.0).abs())
        }));
        let (mean, drained) = film.liquid()?;
        run.at_most(format!("drained into {name}: error of the thickness, part of it"), error, 0.01);
        run.at_most(
            format!("drained into {name}: film and drained gained or lost"),
            ((mean + drained) / NM - 1.0).abs(),
            LOSS,
        );
    }
    Ok(())
}

/// One thin patch in even film, far from the rim: it keeps its size, and rises as its weight and the film's viscosity let it.
fn patch(run: &mut Run<'_>) -> Result<(), GpuError> {
    const DRAG_1_S: f64 = 8.0;
    const NM: f64 = 700.0;
    const LACK: f64 = 0.15;
    const RADIUS: f64 = 0.08;
    // A patch that is slow beside viscosity at its own scale, as the formula has it.
    let gravity = 0.1 * GRAVITY;
    let start = 70f64.to_radians();
    let middle = DVec3::new(start.sin(), 0.0, start.cos());
    // 1, 10 and 2e-4 m²/s, of which the second stops a patch within a step.
    for viscosity in [0.04, 0.4, 0.08].into_iter().take(run.short_or_full(1, 3)) {
        let forces = FlowForces { gravity, drag: DRAG_1_S, air_drag: 0.0, viscosity };
        let even = field(run.gpu, run.short_or_full(64, 128), Rules { cap: Some(Cap::HEMISPHERE), ..RULES }, |_| NM)?;
        let mut film = FreeFilm::new(run.gpu, even, forces, PrescribedFlow::default())?;
        let patches = vec![(middle, 1.0 - LACK, 0)];
        let law = DrainLaw { patch_radius: RADIUS, patches, black_nm: BLACK_NM, ..DrainLaw::default() };
        film.field.drain(Some((law, 1)));
        film.run(1, STEP_S)?;
        film.field.drain(None);
        let (grid, areas) = (film.sphere(), film.areas());
        let seen = |film: &mut FreeFilm<'_>| {
            let nm = film.thickness()?;
            let deficit = |cell: usize| areas[cell] * (NM - nm[cell]).max(0.0);
            let center: DVec3 = (0..grid.cells()).map(|cell| deficit(cell) * grid.cell_direction(cell)).sum();
            let thin = (0..grid.cells()).filter(|cell| NM - nm[*cell] > 0.5 * LACK * NM);
            let area: f64 = thin.map(|cell| areas[cell]).sum();
            Ok::<_, GpuError>((center.normalize().z.acos(), (area / PI).sqrt()))
        };
        let mut moments = vec![seen(&mut film)?];
        for _ in 0..2 {
            film.run(24, STEP_S)?;
            moments.push(seen(&mut film)?);
        }
        let [first, early, late] = [moments[0], moments[1], moments[2]];
        let speed = (early.0 - late.0) / (24.0 * STEP_S);
        let slope = -gravity.z * (0.5 * (early.0 + late.0)).sin();
        let expected = patch_speed(LACK, RADIUS, slope, viscosity, DRAG_1_S);
        let mm2_s = 1e6 * viscosity * RADIUS_M * RADIUS_M;
        let size = (first.1 / RADIUS - 1.0).abs().max((late.1 / RADIUS - 1.0).abs());
        run.at_most(
            format!("a patch in film of {mm2_s:.0} mm²/s: error of its speed"),
            (speed / expected - 1.0).abs(),
            0.2,
        );
        run.at_most(format!("a patch in film of {mm2_s:.0} mm²/s: error of its size"), size, 0.2);
    }
    Ok(())
}

/// What regenerates at a rim of even film goes to its reservoir, and is what the patches lack.
fn regeneration(run: &mut Run<'_>) -> Result<(), GpuError> {
    const RIM: f64 = 1.9;
    const RADIUS: f64 = 0.08;
    const RATE_1_S: f64 = 40.0;
    /// Steps for which a film hears of a patch, so that no remap misses it.
    const HEARD: f64 = 8.0;
    const NM: f64 = 700.0;
    let steps = run.short_or_full(30, 90);
    let cap = Cap::above(RIM);
    let even = field(run.gpu, run.short_or_full(48, 64), Rules { cap: Some(cap), ..RULES }, |_| NM)?;
    let mut film = FreeFilm::new(run.gpu, even, FlowForces::default(), PrescribedFlow::default())?;
    let regeneration = Regeneration { rim: RIM, radius: RADIUS, amount: 3.0, seed: 5 };
    let (mut reservoir, mut returned, mut lost): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for step in 1..=steps {
        let now = f64::from(step);
        let patches = regeneration.patches(RATE_1_S, (now - HEARD).max(0.0) * STEP_S, now * STEP_S);
        let patches =
            patches.map(|patch| (patch.middle, patch.thickness, (now - patch.time_s / STEP_S) as u32)).collect();
        let law = DrainLaw { patch_radius: RADIUS, patches, black_nm: BLACK_NM, ..DrainLaw::default() };
        film.field.drain(Some((law, 6)));
        film.run(1, STEP_S)?;
        if step % 15 == 0 {
            let (mean, drained) = film.liquid()?;
            returned = returned.max(reservoir - drained);
            reservoir = drained;
            lost = lost.max(((mean + drained) / NM - 1.0).abs());
        }
    }
    // Each covers a thousandth of the cap; where two overlap, the later one finds less.
    let part = RADIUS.powi(2) / (2.0 * (1.0 - RIM.cos()));
    let patches = regeneration.patches(RATE_1_S, 0.0, STEP_S * f64::from(steps));
    let expected: f64 = patches.map(|patch| NM * part * (1.0 - patch.thickness)).sum();
    run.at_most("regeneration at a ring: film and reservoir gained or lost", lost, LOSS);
    run.at_most("regeneration at a ring: liquid that came back, nm", returned, 0.0);
    run.at_most("regeneration at a ring: error of what the patches lack", (reservoir / expected - 1.0).abs(), 0.2);
    Ok(())
}
