//! Films that end somewhere: on a bath, on a ring, at a drop.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use soapfilm::{
    gpu::{
        Gpu,
        decide_remap::RemapRule,
        drain::DrainLaw,
        film::{ControlBlock, Field, FreeMotion, Rules, Surroundings, film_areas},
        flow::FlowSolver,
        readback::Readback,
        sample_tracer::Gathered,
        timing::Recorder,
        transport_case::values,
    },
    physics::{
        film::{
            Cap, InitialFilm, PATCH_THICKNESS, PrescribedFlow, Profile, Regeneration, patch_speed,
            properties::{DENSITY, Drainage, VISCOSITY},
        },
        flow::{FlowCase, FlowCaseKind, FlowForces, Mode, fit_oscillation},
        sphere::{CubedSphere, HaloTable, PaddedField},
        transport::Scheme,
    },
    verify::reference,
};

use crate::support::{gpu, load, mean_and_max, radiance, renderer, still};

const DT_S: f64 = 1.0 / 60.0;

fn read(gpu: &Gpu, solver: &FlowSolver, buffer: &wgpu::Buffer) -> Vec<f64> {
    let bytes = Readback::of_buffer(gpu, buffer, buffer.size()).wait(gpu).unwrap();
    solver.inner(&bytemuck::pod_collect_to_vec(&bytes)).into_iter().map(f64::from).collect()
}

/// A film that moves, on a bubble of 5 cm.
struct Film {
    field: Field,
    motion: FreeMotion,
    forces: FlowForces,
    air: PrescribedFlow,
    step: u32,
}

const GRAVITY: DVec3 = DVec3::new(0.0, 0.0, -196.0);

impl Film {
    /// A fresh film of 700 nm that sorts itself.
    fn fresh(gpu: &Gpu, cap: Option<Cap>, drop_rad: Option<f64>) -> Self {
        let film = InitialFilm::Blown { thickness_nm: 700.0, stratification: 0.0, seed: 1 };
        let forces = FlowForces { gravity: GRAVITY, drag: 2.0, air_drag: 0.0, viscosity: 0.04 };
        Self::new(gpu, 64, (cap, drop_rad), film.profile(), (forces, PrescribedFlow::draught(1, 1.0)))
    }

    fn new(
        gpu: &Gpu,
        cells: usize,
        (cap, drop_rad): (Option<Cap>, Option<f64>),
        profile: Profile,
        (forces, air): (FlowForces, PrescribedFlow),
    ) -> Self {
        let rules = Rules {
            scheme: Scheme::Map,
            limiter: true,
            gathered: Gathered::Nothing,
            conserved: true,
            remap: RemapRule { error_limit_cells: RemapRule::ERROR_LIMIT_CELLS, latest_ticks: 12 },
            map_coarsening: 1,
            coarse_flow: true,
            cap,
            drop_rad,
        };
        let mut field = Field::new(gpu, CubedSphere::new(cells).unwrap(), rules).unwrap();
        let mut recorder = Recorder::new(gpu);
        field.seed(&mut recorder, profile).unwrap();
        let motion = FreeMotion::new(&mut recorder, &field).unwrap();
        recorder.submit(&Default::default());
        Self { field, motion, forces, air, step: 0 }
    }

    fn run(&mut self, gpu: &Gpu, steps: u32) {
        let (forces, air) = (self.forces, self.air.clone());
        let mean_nm = self.field.mean();
        for _ in 0..steps {
            let around = Surroundings { forces, air: &air, pushes: &[], mean_nm, thinned_nm: 0.0, black_nm: 1.0 };
            let mut recorder = Recorder::new(gpu);
            let from_s = f64::from(self.step) * DT_S;
            self.motion.advance(&mut recorder, &mut self.field, &around, (from_s, DT_S), 1).unwrap();
            recorder.submit(&Default::default());
            self.step += 1;
        }
        gpu.wait().unwrap();
    }

    /// The mean thickness of the film, nm, and what the device says has left it.
    fn liquid(&mut self, gpu: &Gpu) -> (f64, f64) {
        let (sphere, cap) = (self.field.sphere(), self.field.rules().cap);
        let areas = cap.map_or(sphere.areas(), |cap| film_areas(sphere, cap));
        let nm = values(gpu, &mut self.field).unwrap();
        let control: ControlBlock = bytemuck::pod_read_unaligned(&self.field.read_control(gpu).wait(gpu).unwrap());
        let total: f64 = areas.iter().zip(nm).map(|(area, nm)| area * nm).sum();
        (total / areas.iter().sum::<f64>(), control.drained_nm.into())
    }

    /// The largest flux across any part of a circle of latitude, as a part of the largest between any two points above.
    fn leak(&self, gpu: &Gpu, rim: f64) -> f64 {
        let solver = self.motion.flow();
        let (grid, psi) = (solver.sphere(), read(gpu, solver, solver.psi()));
        let field = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| psi[cell]);
        let range = |values: Vec<f64>| {
            let (low, high) = values.into_iter().fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            high - low
        };
        let on_rim = (0..360).map(|k| {
            let (sin, cos) = (f64::from(k) * TAU / 360.0).sin_cos();
            field.bilinear(DVec3::new(rim.sin() * cos, rim.sin() * sin, rim.cos()))
        });
        let above = (0..grid.cells()).filter(|cell| grid.cell_direction(*cell).z > rim.cos()).map(|cell| psi[cell]);
        range(on_rim.collect()) / range(above.collect())
    }
}

/// ψ = Y of (2, 1) and (3, 2) is 0 on the equator: these modes of the whole film are modes of the half, at the same frequency.
#[test]
fn half_a_film_sloshes_at_the_frequency_of_its_modes() {
    let Some(gpu) = gpu() else { return };
    for mode in [(2, 1), (3, 2)] {
        let case = FlowCase::new(FlowCaseKind::Sloshing, DVec3::Z, Mode::new(mode.0, mode.1, 0).unwrap(), 1.0, 0.0);
        let case = case.unwrap().with_film(1.0, 0.0);
        let (cap, dt) = (Cap::HEMISPHERE, case.span_s() / 60.0);
        let mut solver = FlowSolver::new(&gpu, 32);
        solver.end_at(&gpu, Some(cap));
        let grid = solver.sphere();
        let cells = |value: &dyn Fn(DVec3) -> f64| -> Vec<f32> {
            (0..grid.cells()).map(|cell| value(cap.folded(grid.cell_direction(cell))) as f32).collect()
        };
        gpu.upload(solver.log_thickness(), &solver.padded(&cells(&|x| case.log_thickness(x))));
        let mut recorder = Recorder::new(&gpu);
        solver.seed(&mut recorder, &cells(&|x| case.zeta(x, -0.5 * dt))).unwrap();
        recorder.submit(&Default::default());
        let (areas, mut samples) = (film_areas(grid, cap), Vec::new());
        for _ in 0..60 {
            let mut recorder = Recorder::new(&gpu);
            solver.step(&mut recorder, dt, &case.forces()).unwrap();
            solver.carry_log_thickness(&mut recorder, dt).unwrap();
            recorder.submit(&Default::default());
            let zeta = read(&gpu, &solver, solver.zeta());
            let part = |cell: usize| areas[cell] * zeta[cell] * case.mode_at(grid.cell_direction(cell));
            samples.push((0..grid.cells()).map(part).sum());
        }
        let found = fit_oscillation(&samples, dt).unwrap();
        eprintln!("measured: half a film, {mode:?}: {found:?}, exact {}", case.frequency());
        assert!((found.frequency / case.frequency() - 1.0).abs() < 2e-3, "{mode:?} {found:?}");
    }
}

#[test]
fn nothing_flows_across_a_rim_and_no_film_is_lost() {
    let Some(gpu) = gpu() else { return };
    for (name, rim, limit) in [("bath", FRAC_PI_2, 2e-3), ("ring above", 1.2, 2e-2), ("ring below", 2.2, 2e-2)] {
        let cap = if name == "bath" { Cap::HEMISPHERE } else { Cap::above(rim) };
        let mut film = Film::fresh(&gpu, Some(cap), None);
        let (before, _) = film.liquid(&gpu);
        film.run(&gpu, 30);
        let early = film.leak(&gpu, rim);
        film.run(&gpu, 60);
        let (late, (after, _)) = (film.leak(&gpu, rim), film.liquid(&gpu));
        eprintln!("measured: {name}: leak {early:.2e} and {late:.2e}, liquid {:.2e}", after / before - 1.0);
        assert!(early.max(late) < limit, "{name}: {early} {late}");
        // Corrections are f32: a few parts in ten million.
        assert!((after / before - 1.0).abs() < 1e-6, "{name}: {before} {after}");
    }
}

/// Each remap samples beyond the rim what is within, and each step makes the vorticity there its image.
#[test]
fn the_image_of_a_film_on_a_bath_stays_its_image() {
    let Some(gpu) = gpu() else { return };
    let mut film = Film::fresh(&gpu, Some(Cap::HEMISPHERE), None);
    film.run(&gpu, 120);
    let solver = film.motion.flow();
    let (grid, zeta) = (solver.sphere(), read(&gpu, solver, solver.zeta()));
    let mirrored = |cell: usize, values: &[f64]| {
        let (panel, i, j) = grid.cell(cell);
        let panel = [0, 1, 2, 3, 5, 4][panel];
        values[(panel * grid.n() + grid.n() - 1 - j) * grid.n() + i]
    };
    let largest = zeta.iter().fold(0.0, |most: f64, zeta| most.max(zeta.abs()));
    let odd = mean_and_max((0..grid.cells()).map(|cell| (zeta[cell] + mirrored(cell, &zeta)).abs())).1;
    let nm = values(&gpu, &mut film.field).unwrap();
    let even = mean_and_max((0..grid.cells()).map(|cell| (nm[cell] - mirrored(cell, &nm)).abs()));
    eprintln!(
        "measured: after 2 s vorticity is odd to {:.1e} of {largest}, thickness even to {even:?} nm",
        odd / largest
    );
    // Places of images are f32: a hundred-thousandth of a cell, across which both change by no more than themselves.
    assert!(odd < 1e-4 * largest && even.1 < 0.05, "{odd} {even:?}");
}

#[test]
fn a_drop_holds_the_film_fast_and_no_film_is_lost() {
    let Some(gpu) = gpu() else { return };
    let radius = 15f64.to_radians();
    let [free, held] = [None, Some(radius)].map(|drop| {
        let mut film = Film::fresh(&gpu, None, drop);
        let (before, _) = film.liquid(&gpu);
        film.run(&gpu, 60);
        let drift = film.liquid(&gpu).0 / before - 1.0;
        assert!(drift.abs() < 1e-6, "{drift}");
        film.leak(&gpu, PI - 0.5 * radius)
    });
    eprintln!("measured: flow through the middle of a drop {held:.1e}, of free film {free:.1e}");
    // Half a drop in from its rim nothing flows at all; what is left is the interpolation.
    assert!(held < 1e-3 && free > 1e-2, "{held} {free}");
}

/// Drainage alone, ten thousand times as fast as in life, from 2 µm everywhere: the thickness is the exact one, and what the film lacks is in
/// the drop.
#[test]
fn a_film_drains_as_it_does_in_closed_form() {
    let Some(gpu) = gpu() else { return };
    let (factor, ticks) = (1500.0, 120);
    for (cap, drop_rad) in [(None, 0.1), (Some(Cap::HEMISPHERE), 0.0)] {
        let still = (FlowForces::default(), PrescribedFlow::default());
        let mut film = Film::new(&gpu, 64, (cap, None), Box::new(|_| 2000.0), still);
        let flux = 1e-18 * factor * DENSITY / (12.0 * VISCOSITY) * DT_S;
        let law =
            DrainLaw { gravity: GRAVITY, flux, black_nm: 10.0, drop_rad, patch_radius: 1.0, ..DrainLaw::default() };
        film.field.drain(Some((law, 4)));
        film.run(&gpu, ticks);
        // Gravity of 9.8 m/s² on 5 cm, to the rounding of the constant above.
        let exact = Drainage { thickness_m: 2e-6, radius_m: 9.80665 / 196.0, viscosity: VISCOSITY };
        let time_s = factor * DT_S * f64::from(ticks);
        let (grid, nm) = (film.field.sphere(), values(&gpu, &mut film.field).unwrap());
        let errors = (0..grid.cells()).filter_map(|cell| {
            let z = grid.cell_direction(cell).z;
            (z > 0.05).then(|| (nm[cell] / (1e9 * exact.thickness_m(z.acos(), time_s)) - 1.0).abs())
        });
        let error = mean_and_max(errors);
        let (mean, drained) = film.liquid(&gpu);
        eprintln!(
            "measured: drainage to {:.0} nm at the top: {error:?}, {drained:.3} nm drained",
            1e9 * exact.apex_m(time_s)
        );
        assert!(error.1 < 0.01, "{error:?}");
        assert!(drained > 5.0 && ((mean + drained) / 2000.0 - 1.0).abs() < 1e-6, "{mean} {drained}");
    }
}

/// One thin patch in even film, far from the rim: it keeps its size, and rises as its weight and the film's viscosity let it.
#[test]
fn a_patch_rises_at_its_speed_and_keeps_its_size() {
    let Some(gpu) = gpu() else { return };
    // 1 and 2e-4 m²/s; a tenth of gravity, for a patch that is slow beside viscosity at its own scale, as the formula has it.
    for (viscosity, drag) in [(0.04, 8.0), (0.08, 8.0)] {
        let (radius, start, lack) = (0.08, 70f64.to_radians(), 0.15);
        let gravity = 0.1 * GRAVITY;
        let forces = FlowForces { gravity, drag, air_drag: 0.0, viscosity };
        let even = (forces, PrescribedFlow::default());
        let mut film = Film::new(&gpu, 128, (Some(Cap::HEMISPHERE), None), Box::new(|_| 700.0), even);
        let middle = DVec3::new(start.sin(), 0.0, start.cos());
        let patches = vec![(middle, 1.0 - lack, 0)];
        film.field.drain(Some((DrainLaw { patch_radius: radius, patches, black_nm: 10.0, ..DrainLaw::default() }, 1)));
        film.run(&gpu, 1);
        film.field.drain(None);
        let grid = film.field.sphere();
        let areas = film_areas(grid, Cap::HEMISPHERE);
        let seen = |film: &mut Film| {
            let nm = values(&gpu, &mut film.field).unwrap();
            let deficit = |cell: usize| areas[cell] * (700.0 - nm[cell]).max(0.0);
            let centre: DVec3 = (0..grid.cells()).map(|cell| deficit(cell) * grid.cell_direction(cell)).sum();
            let thin = (0..grid.cells()).filter(|cell| 700.0 - nm[*cell] > 0.5 * lack * 700.0);
            let area: f64 = thin.map(|cell| areas[cell]).sum();
            (centre.normalize().z.acos(), (area / PI).sqrt())
        };
        let at_first = seen(&mut film);
        film.run(&gpu, 24);
        let early = seen(&mut film);
        film.run(&gpu, 24);
        let late = seen(&mut film);
        let speed = (early.0 - late.0) / (24.0 * DT_S);
        let slope = -gravity.z * (0.5 * (early.0 + late.0)).sin();
        let expected = patch_speed(lack, radius, slope, viscosity, drag);
        eprintln!(
            "measured: a patch of {radius} rad, viscosity {viscosity}: {speed:.4} rad/s, by weight and viscosity {expected:.4}; \
             radius {:.4} at first, {:.4} later",
            at_first.1, late.1
        );
        assert!((speed / expected - 1.0).abs() < 0.2, "{speed} {expected}");
        assert!(
            (at_first.1 / radius - 1.0).abs() < 0.2 && (late.1 / radius - 1.0).abs() < 0.2,
            "{at_first:?} {late:?}"
        );
    }
}

#[test]
fn what_regenerates_at_a_rim_goes_to_its_reservoir() {
    let Some(gpu) = gpu() else { return };
    let cap = Cap::above(1.9);
    let regeneration = Regeneration { rim: 1.9, radius: 0.08, amount: 3.0, seed: 5 };
    let mut film = Film::fresh(&gpu, Some(cap), None);
    let (before, _) = film.liquid(&gpu);
    let mut reservoir = vec![0.0];
    for step in 0..90 {
        let now = f64::from(step + 1);
        let patches = regeneration.patches(40.0, (now - 8.0).max(0.0) * DT_S, now * DT_S);
        let patches =
            patches.map(|patch| (patch.middle, patch.thickness, (now - patch.time_s / DT_S) as u32)).collect();
        film.field.drain(Some((DrainLaw { patch_radius: 0.08, patches, black_nm: 10.0, ..DrainLaw::default() }, 6)));
        film.run(&gpu, 1);
        if step % 30 == 29 {
            let (mean, drained) = film.liquid(&gpu);
            reservoir.push(drained);
            eprintln!(
                "measured: {drained:.3} nm of {before:.1} in the reservoir, {:.1e} lost",
                (mean + drained) / before - 1.0
            );
            assert!(((mean + drained) / before - 1.0).abs() < 1e-6, "{mean} {drained} {before}");
        }
    }
    // 60 patches of 0.08 rad, each a thousandth of the cap's area, lack 15 % of the film.
    let each = 0.5 * (2.0 - PATCH_THICKNESS[0] - PATCH_THICKNESS[1]) * 0.08f64.powi(2) / (2.0 * (1.0 - 1.9f64.cos()));
    assert!((0.5..1.5).contains(&(reservoir[3] / before / (60.0 * each))), "{reservoir:?}");
    assert!(reservoir.windows(2).all(|pair| pair[1] > pair[0]), "{reservoir:?}");
}

/// The same bits however the history was cut into frames, with patches on their way.
#[test]
fn a_film_on_a_bath_is_a_function_of_its_scene_and_tick() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("bath");
    loaded.scene.bubbles[0].film.cells = 64;
    loaded.scene.bubbles[0].regeneration = 5.0;
    loaded.scene.motion.drainage = 100.0;
    let film = |renderer: &mut soapfilm::gpu::Renderer, time_s: f64| {
        renderer.bring(&still(&loaded, [64, 36], time_s)).unwrap();
        renderer.read_film(0).unwrap().unwrap().1.wait(&renderer.gpu).unwrap()
    };
    let at_once = film(&mut renderer, 0.7);
    for time_s in [0.1, 0.26, 0.41, 0.6] {
        film(&mut renderer, time_s);
    }
    assert!(film(&mut renderer, 0.7) == at_once, "bits differ");
    assert!(film(&mut renderer, 0.6) != at_once, "and it moves");
}

#[test]
fn a_bath_looks_as_its_f64_twin_does() {
    let Some(mut renderer) = renderer() else { return };
    for preset in ["bath", "ring"] {
        let mut loaded = load(preset);
        loaded.scene.bubbles[0].film.state = soapfilm::scene::FilmStateName::Rest;
        let want = still(&loaded, [64, 36], 0.0);
        let found = radiance(&mut renderer, &want);
        let truth = reference::radiance(&want.picture.draw, &Default::default(), &|| ()).unwrap();
        let brightest = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        let error = mean_and_max(found.iter().zip(&truth).map(|(a, b)| (*a - *b).abs().max_element() / brightest));
        eprintln!("measured: {preset} against f64, parts of the brightest: {error:?}");
        assert!(error.0 < 4e-3, "{preset}: {error:?}");
    }
}
