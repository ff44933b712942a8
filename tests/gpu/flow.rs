//! The flow solver on the GPU against exact flows and against its f64 twin. `soapfilm verify flow` holds it to the full limits; here the
//! runs are short.

use glam::DVec3;
use soapfilm::{
    gpu::{
        Gpu,
        flow::{Cycles, FlowSolver},
        flow_case::{FlowOutcome, FlowRun, read_measures},
        readback::Readback,
        timing::Recorder,
    },
    physics::{
        film::Cap,
        flow::{self, FlowCase, FlowCaseKind, FlowForces, Mode, relative_l2},
        sphere::PaddedField,
    },
    verify::sorting::Sorting,
};

use crate::support::{gpu, mean_and_max, short_or_long};

fn case(kind: FlowCaseKind, mode: (u32, u32), k: f64) -> FlowCase {
    FlowCase::new(kind, DVec3::ONE.normalize(), Mode::new(mode.0, mode.1, 0).unwrap(), 1.0, k).unwrap()
}

fn run(gpu: &Gpu, case: FlowCase, cells: u32, steps_per_span: u32, spans: u32) -> FlowOutcome {
    FlowRun { case, cells, steps_per_span, spans, cycles: Cycles::default() }.measure(gpu).unwrap()
}

/// The cells of a buffer in padded storage.
fn read(gpu: &Gpu, solver: &FlowSolver, buffer: &wgpu::Buffer) -> Vec<f64> {
    let bytes = Readback::of_buffer(gpu, buffer, buffer.size()).wait(gpu).unwrap();
    solver.inner(&bytemuck::pod_collect_to_vec(&bytes)).into_iter().map(f64::from).collect()
}

fn submit(gpu: &Gpu, record: impl FnOnce(&mut Recorder<'_>)) {
    let mut recorder = Recorder::new(gpu);
    record(&mut recorder);
    recorder.submit(&Default::default());
    gpu.wait().unwrap();
}

/// The twin at N = 32 with 40 steps gives 0.014; the limit for N = 64 with 80 steps is 0.023.
#[test]
fn a_rossby_haurwitz_wave_turns() {
    let Some(gpu) = gpu() else { return };
    let found = run(&gpu, case(FlowCaseKind::RossbyHaurwitz, (1, 1), 1.0), 32, 40, 1);
    eprintln!("measured: Rossby-Haurwitz N=32 40 steps: {found:?}");
    assert!(found.l2 <= 0.016 && found.energy_drift.abs() <= 0.01, "{found:?}");
}

/// A turn adds 1.5e-4 in f64.
#[test]
fn a_jet_stands_still() {
    let Some(gpu) = gpu() else { return };
    let found = run(&gpu, case(FlowCaseKind::Stationary, (1, 1), 0.1), 32, 80, 1);
    eprintln!("measured: jet N=32, one turn: {found:?}");
    assert!(found.l2 <= 5e-4 && found.angular_momentum_drift <= 1e-3, "{found:?}");
}

/// Fourth-order differences and a halo of third: better than a quarter for half the cell.
#[test]
fn the_stream_function_converges() {
    let Some(gpu) = gpu() else { return };
    let [coarse, fine] = [32, 64].map(|cells| run(&gpu, case(FlowCaseKind::Poisson, (5, 4), 1.0), cells, 4, 1).l2);
    eprintln!("measured: Poisson l2: N=32 {coarse:.2e}, N=64 {fine:.2e}");
    assert!(fine <= 5e-5 && coarse / fine >= 4.0, "{coarse} {fine}");
}

#[test]
fn viscosity_wears_a_harmonic_down() {
    let Some(gpu) = gpu() else { return };
    let found = run(&gpu, case(FlowCaseKind::Decay, (5, 3), 0.0), 32, 20, 1);
    eprintln!("measured: decay of (5, 3) in 20 steps: {found:?}");
    assert!(found.l2 <= 3e-3, "{found:?}");
}

/// 60 steps per period: the leapfrog is fast by (2π/60)²/24 = 4.6e-4.
#[test]
fn a_film_sloshes_with_and_without_drag_and_overturns() {
    let Some(gpu) = gpu() else { return };
    for drag in [0.0, 0.4] {
        let case = case(FlowCaseKind::Sloshing, (3, 2), 0.0).with_film(1.0, drag);
        let found = run(&gpu, case, 32, 60, 1).oscillation.unwrap();
        eprintln!("measured: slosh (3, 2), drag {drag}: {found:?}, exact {}", case.frequency());
        assert!((found.frequency / case.frequency() - 1.0).abs() <= 1e-3, "{found:?}");
        assert!((found.growth + 0.5 * drag).abs() <= 2e-3, "{found:?}");
    }
    let case = case(FlowCaseKind::Sloshing, (3, 2), 0.0).with_film(-1.0, 0.0);
    let found = run(&gpu, case, 32, 40, 2).oscillation.unwrap();
    eprintln!("measured: Rayleigh-Taylor: {found:?}, exact {}", case.growth());
    assert!((found.growth / case.growth() - 1.0).abs() <= 5e-3, "{found:?}");
}

/// Everything at once, step by step. f32 rounds each step's ζ and ψ to 6e-8 and each trace's origin to as much; ten steps and the sums
/// inside them add up to some 1e-6. Both take the mean away at the start of each step, by the metric.
#[test]
fn the_gpu_matches_its_f64_twin() {
    let Some(gpu) = gpu() else { return };
    let forces = FlowForces { gravity: DVec3::new(0.3, -0.2, -2.0), drag: 0.5, air_drag: 1.5, viscosity: 0.01 };
    let start = case(FlowCaseKind::RossbyHaurwitz, (1, 1), 0.3);
    let thickness = |x: DVec3| 0.2 * (3.0 * x.x).sin() - 0.5 * x.z;
    let mut solver = FlowSolver::new(&gpu, 32);
    let grid = solver.sphere();
    let cells = |value: &dyn Fn(DVec3) -> f64| -> Vec<f32> {
        (0..grid.cells()).map(|cell| value(grid.cell_direction(cell)) as f32).collect()
    };
    let mut twin = flow::FlowSolver::new(grid, |x| start.zeta(x, 0.0));
    let film = PaddedField::sample_cells(grid, twin.halo(), thickness);
    let stirred = |x: DVec3| 2.0 * x.x * x.y;
    twin.stir(PaddedField::sample_cells(grid, twin.halo(), stirred));
    gpu.upload(solver.forcing(), &solver.padded(&cells(&stirred)));
    gpu.upload(solver.log_thickness(), &solver.padded(&cells(&thickness)));
    submit(&gpu, |recorder| {
        solver.seed(recorder, &cells(&|x| start.zeta(x, 0.0))).unwrap();
        (0..7).for_each(|_| solver.step(recorder, 0.04, &forces).unwrap());
        (0..3).for_each(|_| solver.step_corrected(recorder, 0.04, &forces).unwrap());
    });
    (0..7).for_each(|_| twin.step(0.04, &forces, &film));
    (0..3).for_each(|_| twin.step_corrected(0.04, &forces, &film));
    for (name, found, expected) in
        [("vorticity", solver.zeta(), twin.zeta().cells()), ("stream function", solver.psi(), twin.psi().cells())]
    {
        let error = relative_l2(grid, &read(&gpu, &solver, found), &expected);
        eprintln!("measured: GPU - f64 twin, {name}: l2 {error:.1e}");
        assert!(error <= 2e-5, "{name}: {error}");
    }
}

/// A film in a solver: where it starts, and what acts on it.
struct Together {
    mode: (u32, u32),
    ripple: f64,
    forces: FlowForces,
}

impl Together {
    /// Three films that differ in all that films which step together may differ in.
    fn films() -> [Self; 3] {
        let film = |mode, ripple, gravity_z, drag, air_drag, viscosity| Self {
            mode,
            ripple,
            forces: FlowForces { gravity: DVec3::new(0.3, -0.2, gravity_z), drag, air_drag, viscosity },
        };
        [
            film((1, 1), 3.0, -2.0, 0.5, 1.5, 0.01),
            film((5, 3), 5.0, 1.0, 0.0, 0.7, 2.0),
            film((3, 2), 2.0, -4.0, 0.1, 0.0, 0.0003),
        ]
    }

    /// Moves some films in one solver; gives the bits of all that there is of each, and the dispatches of the last step.
    fn run(gpu: &Gpu, films: &[Self], cap: Option<Cap>, drop_rad: Option<f64>) -> (Vec<Vec<u32>>, u64) {
        let mut solver = FlowSolver::of_films(gpu, 24, films.len());
        solver.end_at(gpu, cap);
        solver.pin(gpu, drop_rad);
        let grid = solver.sphere();
        let cells = |value: &dyn Fn(&Self, DVec3) -> f64| -> Vec<f32> {
            let of_film = |film| (0..grid.cells()).map(move |cell| value(film, grid.cell_direction(cell)) as f32);
            films.iter().flat_map(of_film).collect()
        };
        let zeta = cells(&|film, x| case(FlowCaseKind::RossbyHaurwitz, film.mode, 0.3).zeta(x, 0.0));
        let thickness = cells(&|film, x| 0.2 * (film.ripple * x.x).sin() - 0.5 * x.z);
        gpu.upload(solver.log_thickness(), &solver.padded(&thickness));
        gpu.upload(solver.forcing(), &solver.padded(&cells(&|film, x| film.ripple * x.x * x.y)));
        let forces: Vec<FlowForces> = films.iter().map(|film| film.forces).collect();
        let mut dispatches = 0;
        submit(gpu, |recorder| {
            solver.seed(recorder, &zeta).unwrap();
            for step in 0..4 {
                let before = recorder.counts.dispatches;
                solver.step_films(recorder, 0.04, &forces, step == 2).unwrap();
                dispatches = recorder.counts.dispatches - before;
            }
        });
        let mut bits = vec![Vec::new(); films.len()];
        for buffer in [solver.zeta(), solver.psi(), solver.velocity(), solver.measures()] {
            let bytes = Readback::of_buffer(gpu, buffer, buffer.size()).wait(gpu).unwrap();
            let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
            for (film, words) in bits.iter_mut().zip(words.chunks(words.len() / films.len())) {
                film.extend(words);
            }
        }
        (bits, dispatches)
    }
}

/// Whether a film has company shows neither in its bits nor in the number of dispatches.
#[test]
fn films_that_step_together_get_the_bits_that_each_gets_alone() {
    let Some(gpu) = gpu() else { return };
    let films = Together::films();
    let cap = Cap::above(2.0);
    for (cap, drop_rad) in [(None, None), (Some(cap), None), (None, Some(0.3))] {
        let (together, dispatches) = Together::run(&gpu, &films, cap, drop_rad);
        for (film, bits) in films.iter().zip(&together) {
            let (alone, dispatches_alone) = Together::run(&gpu, std::slice::from_ref(film), cap, drop_rad);
            assert!(alone[0] == *bits, "{:?}, cap {cap:?}, drop {drop_rad:?}", film.mode);
            assert_eq!(dispatches, dispatches_alone);
        }
    }
}

/// A value that is not finite is counted, is read as zero, and reaches nothing else.
#[test]
fn nonsense_is_contained() {
    let Some(gpu) = gpu() else { return };
    let mut solver = FlowSolver::new(&gpu, 16);
    let start = case(FlowCaseKind::RossbyHaurwitz, (1, 1), 0.3);
    let grid = solver.sphere();
    let mut zeta: Vec<f32> = (0..grid.cells()).map(|cell| start.zeta(grid.cell_direction(cell), 0.0) as f32).collect();
    let mut thickness = vec![0.0; grid.cells()];
    submit(&gpu, |recorder| solver.seed(recorder, &zeta).unwrap());
    zeta[100] = f32::NAN;
    zeta[700] = f32::INFINITY;
    zeta[701] = 1e30;
    thickness[5] = f32::NEG_INFINITY;
    gpu.upload(solver.zeta(), &solver.padded(&zeta));
    gpu.upload(solver.log_thickness(), &solver.padded(&thickness));
    let forces = FlowForces { gravity: DVec3::NEG_Z, drag: 0.1, air_drag: 100.0, viscosity: 0.01 };
    submit(&gpu, |recorder| solver.step(recorder, 0.01, &forces).unwrap());
    // The trial of the first step and the step itself both meet the four.
    assert_eq!(read_measures(&gpu, &solver).unwrap().invalid, 8);
    for buffer in [solver.zeta(), solver.psi()] {
        let (_, max) = mean_and_max(read(&gpu, &solver, buffer).into_iter().map(f64::abs));
        assert!(max < 50.0, "{max}");
    }
}

/// Gravity sorts a blown film into bands within two seconds, and leaves it its contrast.
#[test]
fn a_blown_film_sorts_itself() {
    let Some(gpu) = gpu() else { return };
    let film = Sorting { cells: short_or_long(48, 64), map_coarsening: 1, ..Sorting::LABORATORY };
    let found = film.measure(&gpu, &[2.0]).unwrap()[0];
    eprintln!("measured: a blown film after 2 s: {found:?}");
    assert!(found.explained >= 0.9 && found.fringes >= 2.5 && found.kept >= 0.6 && found.drift <= 1e-7, "{found:?}");
}

/// Steps that last no time, or nonsense, change nothing.
#[test]
fn time_that_does_not_pass_changes_nothing() {
    let Some(gpu) = gpu() else { return };
    let mut solver = FlowSolver::new(&gpu, 16);
    let zeta: Vec<f32> = (0..solver.sphere().cells()).map(|cell| (cell % 7) as f32 - 3.0).collect();
    submit(&gpu, |recorder| solver.seed(recorder, &zeta).unwrap());
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        submit(&gpu, |recorder| solver.step(recorder, dt, &FlowForces::default()).unwrap());
    }
    assert_eq!(read(&gpu, &solver, solver.zeta()), zeta.iter().map(|&value| f64::from(value)).collect::<Vec<_>>());
}
