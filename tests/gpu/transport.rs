//! Transport on the GPU against its f64 twin. Published benchmarks are in `benchmarks`.

use glam::DVec3;
use rayon::prelude::*;
use soapfilm::{
    gpu::{
        Gpu,
        film::{Field, Rules},
        passes::decide_remap::RemapRule,
        passes::sample_tracer::Gathered,
        passes::trace_step::Step,
        timing::Recorder,
        transport_case::values,
    },
    physics::{
        film::{InitialFilm, PrescribedFlow},
        sphere::CubedSphere,
        transport::{FlowMap, PERIOD, Scheme, Tracer, TracerKind, Wind, WindKind, backtrace},
    },
};

use crate::support::{gpu, mean_and_max};

const RULES: Rules = Rules {
    scheme: Scheme::Map,
    limiter: false,
    gathered: Gathered::Nothing,
    conserved: true,
    // As if the map were never too distorted, so that remaps come when the twin has them.
    remap: remap(20),
    map_coarsening: 1,
    flow_cells: 64,
    cap: None,
    drop_rad: None,
};

const fn remap(latest_ticks: u32) -> RemapRule {
    RemapRule { error_limit_cells: f32::MAX, latest_ticks }
}

/// Moves a field through steps of a tick each.
fn moved(
    gpu: &Gpu,
    grid: CubedSphere,
    rules: Rules,
    initial: impl Fn(DVec3) -> f64 + Sync,
    steps: impl Iterator<Item = Step>,
) -> Vec<f64> {
    let mut field = Field::new(gpu, grid, rules).unwrap();
    field.seed(gpu, initial);
    for step in steps {
        let mut recorder = Recorder::new(gpu);
        field.advance(&mut recorder, &step, 1).unwrap();
        recorder.submit(&Default::default());
    }
    values(gpu, &mut field).unwrap()
}

/// The same steps in f64. Per step and cell f32 rounds the position to 6e-8 (which the steepest slope of bells of radius 1/2,
/// 0.9 π a radian, turns into 2e-7) and the sums of a lookup to as much; 60 steps that add in the worst case are 2.5e-5.
#[test]
fn the_gpu_matches_its_f64_twin() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
    let tracer = Tracer::new(TracerKind::CosineBells, wind.tracer_rotation());
    let (grid, dt) = (CubedSphere::new(40).unwrap(), PERIOD / 60.0);
    for scheme in [Scheme::Bilinear, Scheme::Bicubic, Scheme::Map, Scheme::MapAccurate] {
        let rules = Rules { scheme, flow_cells: u32::MAX, remap: remap(15), ..RULES };
        let steps = (0..60).map(|k| Step::wind(&wind, dt * f64::from(k), dt * f64::from(k + 1)));
        let found = moved(&gpu, grid, rules, |x| tracer.value(x), steps);
        let mut twin = FlowMap::new(grid, scheme, |x| tracer.value(x)).unwrap();
        for step in 0..60 {
            twin.step(f64::from(step) * dt, dt, |x, t| wind.velocity(x, t));
            if (step + 1) % 15 == 0 || !scheme.keeps_map() {
                twin.remap();
            }
        }
        let (mean, max) = mean_and_max(found.iter().zip(twin.values()).map(|(a, b)| (a - b).abs()));
        eprintln!("measured: GPU - f64 twin, ND CB, {}: max {max:.2e}, mean {mean:.2e}", scheme.name());
        assert!(max <= 2.5e-5, "{}: {max}", scheme.name());
    }
}

/// Maps of cells several times as wide as the tracer's lead to the same places, but for the error of interpolating them, which is of the fourth
/// order. Where the number is even, lookups take two by two cells at once, which begin at odd cells or at even ones.
#[test]
fn a_coarser_map_leads_to_the_same_places() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
    let hills = Tracer::new(TracerKind::GaussianHills, wind.tracer_rotation());
    let (grid, dt) = (CubedSphere::new(96).unwrap(), PERIOD / 60.0);
    let through = |map_coarsening: u32| {
        let rules = Rules { map_coarsening, flow_cells: 96 / map_coarsening, remap: remap(8), ..RULES };
        let steps = (0..15).map(|k| Step::wind(&wind, dt * f64::from(k), dt * f64::from(k + 1)));
        moved(&gpu, grid, rules, |x| hills.value(x), steps)
    };
    let finest = through(1);
    let errors = [2, 3, 4, 6].map(|coarsening| {
        let (mean, max) = mean_and_max(through(coarsening).iter().zip(&finest).map(|(a, b)| (a - b).abs()));
        eprintln!("measured: hills through a map of cells {coarsening} wide: mean {mean:.2e}, max {max:.2e}");
        max
    });
    let [two, one_by_one, four, six] = errors;
    assert!(two <= 0.4 * one_by_one, "{errors:?}: ideal 0.2");
    assert!(four <= 4.7 * one_by_one, "{errors:?}: ideal 3.2");
    assert!(six <= 24.0 * one_by_one, "{errors:?}: ideal 16");
}

/// A film of 128 cells per edge stirred for 1 s on the GPU, in steps of `ticks_per_step` ticks.
fn stirred(gpu: &Gpu, grid: CubedSphere, flow: &PrescribedFlow, ticks_per_step: u32, flow_cells: u32) -> Vec<f64> {
    let length_s = f64::from(ticks_per_step) / 60.0;
    let steps = (0..60 / ticks_per_step).map(f64::from);
    let steps = steps.map(|k| Step::prescribed(flow, length_s * k, length_s * (k + 1.0)));
    moved(gpu, grid, Rules { remap: remap(1000), flow_cells, ..RULES }, film().profile(), steps)
}

fn film() -> InitialFilm {
    InitialFilm::Blown { thickness_nm: 600.0, stratification: 0.0, seed: 3 }
}

/// Long steps and the coarser grid on which they are traced (64 cells for 128) must cost nothing that can be seen: 0.6 nm in
/// the mean is within what is not known of any real film, and below what interpolating the map costs in the sharpest eddies. The truth is the
/// initial film at the feet of trajectories in f64, at every eleventh cell.
#[test]
fn a_stirred_film_follows_its_trajectories() {
    let Some(gpu) = gpu() else { return };
    let (grid, flow, profile) = (CubedSphere::new(128).unwrap(), PrescribedFlow::stirred(5, 1.0), film().profile());
    let foot = |x: DVec3| {
        let tick_s = 1.0 / 60.0;
        let back = |x, tick| backtrace(x, f64::from(tick + 1) * tick_s, tick_s, |x, t| flow.velocity(x, t));
        (0..60).rev().fold(x, back)
    };
    let exact: Vec<f64> =
        (0..grid.cells()).into_par_iter().step_by(11).map(|cell| profile(foot(grid.cell_direction(cell)))).collect();
    let [fine, long, coarse] = [(1, 128), (6, 128), (6, 64)].map(|(ticks, flow_cells)| {
        let found = stirred(&gpu, grid, &flow, ticks, flow_cells);
        mean_and_max(found.iter().step_by(11).zip(&exact).map(|(a, b)| (a - b).abs()))
    });
    eprintln!(
        "measured: stirred film from f64, mean and max in nm: steps of a tick {fine:.3?}, of 6 {long:.3?}, traced on a coarser grid {coarse:.3?}"
    );
    assert!(coarse.0 <= 0.6, "{coarse:?}");
    assert!(long.0 <= 1.1 * fine.0 && coarse.0 <= 1.1 * fine.0, "{fine:?}, {long:?}, {coarse:?}");
}
