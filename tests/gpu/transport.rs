//! Transport on the GPU against its f64 twin, and all that `soapfilm verify` holds to limits.

use glam::DVec3;
use soapfilm::{
    gpu::{
        Gpu,
        decide_remap::RemapRule,
        film::{Field, Rules},
        sample_tracer::Gathered,
        timing::Recorder,
        trace_step::Step,
        transport_case::values,
    },
    physics::{
        film::{InitialFilm, PrescribedFlow},
        sphere::CubedSphere,
        transport::{FlowMap, PERIOD, Scheme, Tracer, TracerKind, Wind, WindKind},
    },
    verify::{Check, Part, Run},
};

use crate::support::{gpu, mean_and_max};

const RULES: Rules = Rules {
    scheme: Scheme::Map,
    limiter: false,
    gathered: Gathered::Nothing,
    conserved: true,
    // As if the map were never too distorted, so that remaps come when the twin has them.
    remap: remap(20),
    coarse_flow: true,
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
    let mut recorder = Recorder::new(gpu);
    field.seed(&mut recorder, initial).unwrap();
    recorder.submit(&Default::default());
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
fn the_gpu_does_what_its_f64_twin_does() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
    let tracer = Tracer::new(TracerKind::CosineBells, wind.tracer_rotation());
    let (grid, dt) = (CubedSphere::new(40).unwrap(), PERIOD / 60.0);
    for scheme in [Scheme::Bilinear, Scheme::Bicubic, Scheme::Map, Scheme::MapAccurate] {
        let rules = Rules { scheme, coarse_flow: false, remap: remap(15), ..RULES };
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

/// A stirred film after 2 s on the GPU, in steps of so many ticks and traced on the coarser grid, against f64 in single ticks on the film's own:
/// mean and maximum of the difference in nm.
fn stirred_film_parts_from_its_twin(gpu: &Gpu, cells: usize, ticks_a_step: u32) -> (f64, f64) {
    const TICKS: u32 = 120;
    let (grid, tick_s) = (CubedSphere::new(cells).unwrap(), 1.0 / 60.0);
    let initial = InitialFilm::Blown { thickness_nm: 600.0, stratification: 0.0, seed: 3 };
    let flow = PrescribedFlow::stirred(5, 1.0);
    let length_s = tick_s * f64::from(ticks_a_step);
    let count = TICKS / ticks_a_step;
    let steps = (0..count).map(|k| Step::prescribed(&flow, length_s * f64::from(k), length_s * f64::from(k + 1)));
    // One remap at the end, which comes when the first step is as old as the map may be.
    let found = moved(gpu, grid, Rules { remap: remap(count), ..RULES }, initial.profile(), steps);
    let mut twin = FlowMap::new(grid, Scheme::Map, initial.profile()).unwrap();
    for tick in 0..TICKS {
        twin.step(f64::from(tick) * tick_s, tick_s, |x, t| flow.velocity(x, t));
    }
    twin.remap();
    mean_and_max(found.iter().zip(twin.values()).map(|(a, b)| (a - b).abs()))
}

/// What long steps, the coarse trace and f32 cost together must not be seen: 0.1 nm in the mean is a colour difference of 0.06. At
/// strength 1 a step is six ticks; a film of 96 cells is traced on a grid of 64.
#[test]
fn a_stirred_film_follows_its_f64_twin() {
    let Some(gpu) = gpu() else { return };
    let (mean, max) = stirred_film_parts_from_its_twin(&gpu, 96, 6);
    eprintln!("measured: stirred film of 96 cells in steps of 0.1 s, GPU - f64 twin: max {max:.3} nm, mean {mean:.4} nm");
    assert!(mean <= 0.1 && max <= 3.0, "max {max} nm, mean {mean} nm");
}

fn verified(part: Part) {
    let Some(gpu) = gpu() else { return };
    let mut checks: Vec<Check> = Vec::new();
    let mut report = |check: Check| {
        eprintln!("measured: {}: {:.3e} (limit {:.3e})", check.name, check.measured, check.limit);
        checks.push(check);
    };
    Run { gpu: &gpu, long: false, report: &mut report }.part(part).unwrap();
    let failed: Vec<_> = checks.iter().filter(|check| !check.passed()).collect();
    assert!(checks.len() > 10 && failed.is_empty(), "{} checks; failed: {failed:#?}", checks.len());
}

#[test]
fn published_tests_keep_to_their_limits() {
    verified(Part::Transport);
}

#[test]
fn what_breaks_solvers_does_not_break_this_one() {
    verified(Part::Stability);
}
