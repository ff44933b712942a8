//! Transport on the GPU against exact answers and against its f64 twin.

use glam::DVec3;
use soapfilm::{
    gpu::{Gpu, advance_map::Step, film::Field, readback::Readback, timing::Recorder},
    physics::{
        film::{InitialFilm, PrescribedFlow},
        sphere::{CubedSphere, HaloTable, PaddedField},
        transport::{FlowMap, Measured, PERIOD, Tracer, TracerKind, Wind, WindKind, measure},
    },
};

use crate::support::{gpu, mean_and_max};

/// Moves a field through steps, remapped after every `interval`, and brings the cells' values back.
fn moved(
    gpu: &Gpu,
    grid: CubedSphere,
    initial: &[f32],
    steps: u32,
    interval: u32,
    step: impl Fn(u32) -> Step,
) -> Vec<f64> {
    let mut field = Field::new(gpu, grid);
    let mut recorder = Recorder::new(gpu);
    field.seed(&mut recorder, initial).unwrap();
    recorder.submit(&Default::default());
    for number in 0..steps {
        let mut recorder = Recorder::new(gpu);
        field.advance(&mut recorder, &step(number), (number + 1) % interval == 0).unwrap();
        recorder.submit(&Default::default());
    }
    let mut recorder = Recorder::new(gpu);
    let buffer = field.thickness(&mut recorder, None).unwrap().clone();
    recorder.submit(&Default::default());
    let padded: Vec<f32> =
        bytemuck::pod_collect_to_vec(&Readback::of_buffer(gpu, &buffer, buffer.size()).wait(gpu).unwrap());
    field.inner(&padded).into_iter().map(f64::from).collect()
}

fn sampled(grid: CubedSphere, tracer: &Tracer) -> Vec<f64> {
    (0..grid.cells()).map(|cell| tracer.value(grid.cell_direction(cell))).collect()
}

fn single(values: &[f64]) -> Vec<f32> {
    values.iter().map(|value| *value as f32).collect()
}

/// One period of a test wind in 120 steps on 60 cells an edge: the field comes back to where it was.
fn period(gpu: &Gpu, wind: &Wind, tracer: &Tracer, interval: u32) -> (CubedSphere, Vec<f64>, Vec<f64>) {
    const STEPS: u32 = 120;
    let grid = CubedSphere::new(60).unwrap();
    let initial = sampled(grid, tracer);
    let time = |step: u32| PERIOD * f64::from(step) / f64::from(STEPS);
    let step = |step: u32| Step::wind(wind, time(step), time(step + 1));
    let values = moved(gpu, grid, &single(&initial), STEPS, interval, step);
    (grid, values, initial)
}

fn norms((grid, values, initial): &(CubedSphere, Vec<f64>, Vec<f64>)) -> Measured {
    measure(*grid, values, initial, initial)
}

/// The same scheme in f64 gives 0.081; f32 adds nothing that could be seen here.
#[test]
fn cosine_bells_in_the_deformation_wind_bicubic() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
    let l2 = norms(&period(&gpu, &wind, &Tracer::new(TracerKind::CosineBells, wind.tracer_rotation()), 1)).l2;
    eprintln!("measured: ND CB N=60 120 steps bicubic: l2 {l2:.5}");
    assert!(l2 <= 0.085, "{l2}");
}

/// Remapped five times a period, as the flow map is by default: an order of magnitude better, and better than the published bar of 0.033.
#[test]
fn cosine_bells_in_the_deformation_wind_by_flow_map() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
    let l2 = norms(&period(&gpu, &wind, &Tracer::new(TracerKind::CosineBells, wind.tracer_rotation()), 24)).l2;
    eprintln!("measured: ND CB N=60 120 steps flow map: l2 {l2:.5}");
    assert!(l2 <= 0.0125, "{l2}");
}

/// Over both poles, which are nothing special on this grid: where the prototype reached 0.0008.
#[test]
fn the_bell_of_test_case_1_over_the_poles() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::SolidBody, Some(DVec3::X)).unwrap();
    let l2 = norms(&period(&gpu, &wind, &Tracer::new(TracerKind::Bell, wind.tracer_rotation()), 24)).l2;
    eprintln!("measured: SB TC1 over the poles: l2 {l2:.6}");
    assert!(l2 <= 0.001, "{l2}");
}

/// The same bicubic steps in f64. Per step and cell f32 rounds the position to 6e-8 (which the steepest slope of bells of radius 1/2,
/// 0.9 π a radian, turns into 2e-7) and the 16-term sum to as much; 120 steps that add in the worst case are 5e-5.
#[test]
fn the_gpu_does_what_its_f64_twin_does() {
    let Some(gpu) = gpu() else { return };
    let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
    let tracer = Tracer::new(TracerKind::CosineBells, wind.tracer_rotation());
    for interval in [1, 24] {
        let (grid, values, _) = period(&gpu, &wind, &tracer, interval);
        let mut twin = FlowMap::new(grid, |x| tracer.value(x));
        for step in 0..120 {
            let dt = PERIOD / 120.0;
            twin.step(f64::from(step) * dt, dt, |x, t| wind.velocity(x.normalize(), t));
            if (step + 1) % interval == 0 {
                twin.remap();
            }
        }
        let (mean, max) = mean_and_max(values.iter().zip(twin.values()).map(|(a, b)| (a - b).abs()));
        eprintln!("measured: GPU - f64 twin, ND CB, remap every {interval}: max {max:.2e}, mean {mean:.2e}");
        assert!(max <= 5e-5, "remap every {interval}: {max}");
    }
}

/// A stirred film after some ticks, with a remap every 20, on the GPU and by the twin, with ticks cut into so many steps: mean and maximum
/// of the difference in nm.
fn stirred_film_parts_from_its_twin(gpu: &Gpu, cells: usize, ticks: u32, cuts: u32) -> (f64, f64) {
    let (grid, dt_s) = (CubedSphere::new(cells).unwrap(), 1.0 / 60.0 / f64::from(cuts));
    let initial = InitialFilm::Blown { thickness_nm: 600.0, stratification: 0.0, seed: 3 }.sample(grid);
    let flow = PrescribedFlow::stirred(5, 1.0);
    let step = |number: u32| Step::prescribed(&flow.frozen_at((f64::from(number) + 0.5) * dt_s), dt_s);
    let values = moved(gpu, grid, &initial, ticks * cuts, 20 * cuts, step);
    let start = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| f64::from(initial[cell]));
    let mut twin = FlowMap::from_field(start);
    for number in 0..ticks * cuts {
        twin.step(f64::from(number) * dt_s, dt_s, |x, t| flow.velocity(x, t));
        if (number + 1) % (20 * cuts) == 0 {
            twin.remap();
        }
    }
    mean_and_max(values.iter().zip(twin.values()).map(|(a, b)| (a - b).abs()))
}

/// The GPU freezes the flow at the middle of a step and takes the midpoint rule, the twin follows it by RK4: they part by the midpoint
/// rule's error, which must fall to a quarter with half the step (3 leaves room for what f32 adds), and must not be seen: 0.1 nm in the
/// mean is a colour difference of 0.06. The sharpest vortices alone reach half a nanometre.
#[test]
fn a_stirred_film_follows_its_f64_twin() {
    let Some(gpu) = gpu() else { return };
    let (mean, max) = stirred_film_parts_from_its_twin(&gpu, 48, 50, 1);
    let (half_mean, half_max) = stirred_film_parts_from_its_twin(&gpu, 48, 50, 2);
    eprintln!(
        "measured: stirred film, GPU - f64 twin: max {max:.3} nm, mean {mean:.4} nm; half the step: {half_max:.3}, {half_mean:.4}"
    );
    assert!(mean <= 0.03 && max <= 1.0, "max {max} nm, mean {mean} nm");
    assert!(half_max <= max / 3.0 && half_mean <= mean / 3.0, "not of second order: {half_max} nm, {half_mean} nm");
}

/// Films of more than 64 cells an edge have their steps traced on a coarser grid: what interpolation adds must stay as far from being seen
/// as the midpoint rule's error, with the same bounds.
#[test]
fn a_fine_film_follows_its_f64_twin() {
    let Some(gpu) = gpu() else { return };
    let (mean, max) = stirred_film_parts_from_its_twin(&gpu, 128, 21, 1);
    eprintln!("measured: stirred film of 128 cells, GPU - f64 twin: max {max:.3} nm, mean {mean:.4} nm");
    assert!(mean <= 0.03 && max <= 1.0, "max {max} nm, mean {mean} nm");
}

/// A bell that passes through four of the cube's corners, and comes to rest on one. Statistic: root mean square error over the bell's
/// cells within two cells of an edge of the cube, against that over its other cells; a seam that did harm would show in the first.
#[test]
fn seams_and_corners_are_as_good_as_the_rest() {
    let Some(gpu) = gpu() else { return };
    let corner = DVec3::ONE.normalize();
    // Perpendicular to two diagonals of the cube: the path leads through four corners.
    let wind = Wind::new(WindKind::SolidBody, Some(DVec3::new(1.0, -1.0, 0.0))).unwrap();
    let run = period(&gpu, &wind, &Tracer::at(TracerKind::Bell, corner).unwrap(), 1);
    let (grid, values, exact) = &run;
    let near_edge = |k: usize| k < 2 || k >= grid.n() - 2;
    let (mut seam, mut rest) = (Vec::new(), Vec::new());
    for cell in (0..grid.cells()).filter(|cell| grid.cell_direction(*cell).angle_between(corner) < 0.4) {
        let (_, i, j) = grid.cell(cell);
        let error = (values[cell] - exact[cell]).powi(2);
        if near_edge(i) || near_edge(j) { seam.push(error) } else { rest.push(error) }
    }
    let [seam, rest] = [seam, rest].map(|squares| mean_and_max(squares).0.sqrt());
    eprintln!(
        "measured: bell through corners: rms {seam:.2e} near seams, {rest:.2e} elsewhere, l2 {:.5}",
        norms(&run).l2
    );
    assert!(seam <= 1.25 * rest, "near seams {seam}, elsewhere {rest}");
}

/// Constants stay constant in any flow: the halo's weights sum to 1 in f32, and what is left is rounding of 16 products.
#[test]
fn an_even_film_stays_even() {
    let Some(gpu) = gpu() else { return };
    let (grid, tick_s) = (CubedSphere::new(32).unwrap(), 1.0 / 60.0);
    let flow = PrescribedFlow::stirred(5, 2.0);
    let step = |tick: u32| Step::prescribed(&flow.frozen_at((f64::from(tick) + 0.5) * tick_s), tick_s);
    let values = moved(&gpu, grid, &vec![500.0; grid.cells()], 60, 5, step);
    let (_, max) = mean_and_max(values.iter().map(|value| (value / 500.0 - 1.0).abs()));
    eprintln!("measured: an even film after 12 remaps: relative error {max:.1e}");
    assert!(max <= 2e-6, "{max}");
}
