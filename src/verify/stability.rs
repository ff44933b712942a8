//! What breaks solvers: extreme steps, grids, fields and winds, and values that are not numbers. In every case the field must stay finite,
//! within the range that it began with, and conserved.

use glam::DVec3;

use super::{
    Run,
    free_film::{FreeFilm, RULES, field},
    played::departures,
};
use crate::{
    gpu::{
        GpuError, control::ControlBlock, film::Planted, passes::trace_step::Step, timing::Recorder,
        transport_case::values,
    },
    physics::{
        film::{InitialFilm, PrescribedFlow},
        flow::FlowForces,
        sphere::CubedSphere,
        transport::{PERIOD, Tracer, TracerKind, Wind, WindKind},
    },
};

/// A field to be carried.
type Initial = fn(DVec3) -> f64;

fn bells(x: DVec3) -> f64 {
    Tracer::new(TracerKind::CosineBells, glam::DMat3::IDENTITY).value(x)
}

/// Eight waves an axis: cells of either sign side by side on a grid of 16.
fn checkerboard(x: DVec3) -> f64 {
    if [x.x, x.y, x.z].iter().map(|v| (v * 12.0).floor() as i64).sum::<i64>() % 2 == 0 { 1.0 } else { -1.0 }
}

fn zero_or_one(x: DVec3) -> f64 {
    f64::from(u8::from(x.dot(DVec3::new(0.3, 0.5, 0.8)) > 0.2))
}

const FIELDS: &[(&str, Initial)] = &[
    ("zero", |_| 0.0),
    ("constant", |_| 0.7),
    ("checkerboard", checkerboard),
    ("0 and 1", zero_or_one),
    ("1e30", |x| 1e30 * bells(x)),
    ("-1e30", |x| -1e30 * bells(x)),
    ("1e-30", |x| 1e-30 * bells(x)),
    ("a spike", |x| if x.distance(DVec3::ONE.normalize()) < 0.1 { 1e6 } else { 1.0 }),
];

/// One way of moving a field.
struct Stress<'a> {
    name: String,
    cells: usize,
    initial: Initial,
    steps: u32,
    step: &'a dyn Fn(u32) -> Step,
    /// What is spoilt before which step.
    planted: Option<(u32, Planted, f32)>,
}

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    steps(run)?;
    grids(run)?;
    fields(run)?;
    winds(run)?;
    gravity(run)?;
    spoilt(run)?;
    refused(run)?;
    super::interaction::run(run)?;
    super::extremes::run(run)?;
    if run.is_long() { long(run) } else { Ok(()) }
}

fn fields(run: &mut Run<'_>) -> Result<(), GpuError> {
    let steps = run.short_or_full(15, 60);
    for (name, initial) in FIELDS {
        let wind = deformation();
        let step = |k: u32| Step::wind(&wind, 0.05 * f64::from(k), 0.05 * f64::from(k + 1));
        stress(
            run,
            &Stress { name: format!("field {name}"), cells: 24, initial: *initial, steps, step: &step, planted: None },
        )?;
    }
    Ok(())
}

fn deformation() -> Wind {
    // The default axis is a direction.
    Wind::new(WindKind::NonDivergent, None).unwrap_or_else(|_| unreachable!("the default axis has a direction"))
}

/// Steps from a thousandth of a cell to 200 cells, and none at all.
fn steps(run: &mut Run<'_>) -> Result<(), GpuError> {
    const CELLS: usize = 32;
    let (wind, steps) = (deformation(), run.short_or_full(20, 100));
    let cell_s = std::f64::consts::FRAC_PI_2 / CELLS as f64 / 2.0; // The fastest wind is near 2 rad/s.
    for cfl in [1e-3, 0.1, 1.0, 20.0, 200.0, 0.0] {
        let dt = cfl * cell_s;
        let step = |k: u32| Step::wind(&wind, dt * f64::from(k), dt * f64::from(k + 1));
        let name = format!("steps of {cfl} cells");
        stress(run, &Stress { name, cells: CELLS, initial: bells, steps, step: &step, planted: None })?;
    }
    let spikes = |k: u32| Step::wind(&wind, 0.0, if k.is_multiple_of(7) { 3.0 } else { 0.01 });
    stress(
        run,
        &Stress { name: "spikes of dt".into(), cells: CELLS, initial: bells, steps, step: &spikes, planted: None },
    )
}

fn grids(run: &mut Run<'_>) -> Result<(), GpuError> {
    let wind = deformation();
    let step = |k: u32| Step::wind(&wind, 0.05 * f64::from(k), 0.05 * f64::from(k + 1));
    let [small, odd, large, huge] = run.short_or_full([20, 6, 2, 1], [100, 40, 8, 2]);
    for (cells, steps) in [(16, small), (17, small), (61, odd), (255, large), (1024, huge)] {
        stress(
            run,
            &Stress { name: format!("N = {cells}"), cells, initial: bells, steps, step: &step, planted: None },
        )?;
    }
    Ok(())
}

/// Winds that fold the map within a step, and that turn round at each.
fn winds(run: &mut Run<'_>) -> Result<(), GpuError> {
    let [folds, turns] = run.short_or_full([15, 20], [60, 100]);
    let flow = PrescribedFlow::stirred(3, 300.0);
    let folding = |k: u32| Step::prescribed(&flow, 0.1 * f64::from(k), 0.1 * f64::from(k + 1));
    stress(
        run,
        &Stress {
            name: "a wind that folds the map".into(),
            cells: 32,
            initial: bells,
            steps: folds,
            step: &folding,
            planted: None,
        },
    )?;
    let wind = deformation();
    // In the second half of its period the wind undoes the deformation of the first.
    let flips = |k: u32| {
        let from_s = if k.is_multiple_of(2) { 0.0 } else { PERIOD - 0.4 };
        Step::wind(&wind, from_s, from_s + 0.4)
    };
    stress(
        run,
        &Stress {
            name: "a wind that flips at each step".into(),
            cells: 32,
            initial: bells,
            steps: turns,
            step: &flips,
            planted: None,
        },
    )
}

/// A free film of 600 nm whose gravity, fifty times the Earth's on a bubble of 5 cm, turns over at every fourth step of a hundredth of a second.
fn gravity(run: &mut Run<'_>) -> Result<(), GpuError> {
    const STEP_S: f64 = 0.01;
    let film = InitialFilm::Blown { thickness_nm: 600.0, stratification: 0.0, seed: 5 };
    let field = field(run.gpu, 32, RULES, film.profile())?;
    let mut film = FreeFilm::new(run.gpu, field, FlowForces::default(), PrescribedFlow::default())?;
    let before = film.thickness()?;
    for turn in 0..run.short_or_full(6, 50) {
        film.forces.gravity = DVec3::NEG_Z * if turn % 2 == 0 { 50.0 * 9.81 / 0.05 } else { -50.0 * 9.81 / 0.05 };
        film.run(4, STEP_S)?;
    }
    let after = film.thickness()?;
    kept(run, "gravity that flips", film.sphere(), [&before, &after]);
    Ok(())
}

/// One NaN, in the tracer and in the map.
fn spoilt(run: &mut Run<'_>) -> Result<(), GpuError> {
    let wind = deformation();
    let step = |k: u32| Step::wind(&wind, 0.05 * f64::from(k), 0.05 * f64::from(k + 1));
    let steps = run.short_or_full(15, 40);
    for planted in [Planted::Tracer, Planted::Map] {
        for (name, value) in [("NaN", f32::NAN), ("infinity", f32::INFINITY), ("-infinity", f32::NEG_INFINITY)] {
            let name = format!("{name} in the {planted:?}").to_lowercase();
            let planted = Some((10, planted, value));
            stress(run, &Stress { name, cells: 24, initial: bells, steps, step: &step, planted })?;
        }
    }
    Ok(())
}

/// Times that are not numbers, and steps back, are refused: 0 of them pass.
fn refused(run: &mut Run<'_>) -> Result<(), GpuError> {
    let mut field = field(run.gpu, 16, RULES, bells)?;
    let mut passed = 0;
    for to_s in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -0.1] {
        let mut recorder = Recorder::new(run.gpu);
        passed += u32::from(field.advance(&mut recorder, &Step::wind(&deformation(), 0.0, to_s), 1).is_ok());
    }
    run.at_most("steps back, or to no time at all: not refused", f64::from(passed), 0.0);
    Ok(())
}

/// A million steps, which `--long` asks for. Last run on llvmpipe of Mesa 22.3.6: no value not finite or beyond the range, mass drifted by
/// 4.1e-9.
fn long(run: &mut Run<'_>) -> Result<(), GpuError> {
    let wind = deformation();
    let step = |k: u32| Step::wind(&wind, 0.05 * f64::from(k % 100), 0.05 * f64::from(k % 100 + 1));
    stress(
        run,
        &Stress { name: "1e6 steps".into(), cells: 16, initial: bells, steps: 1_000_000, step: &step, planted: None },
    )
}

/// Moves a field and reports how far it left its range, as a part of it, and how far its mass drifted, relative to its size.
fn stress(run: &mut Run<'_>, stress: &Stress<'_>) -> Result<(), GpuError> {
    let mut field = field(run.gpu, stress.cells, RULES, stress.initial)?;
    let before = values(run.gpu, &mut field)?;
    let mut recorder = Recorder::new(run.gpu);
    for k in 0..stress.steps {
        if let Some((_, planted, value)) = stress.planted.filter(|(at, ..)| *at == k) {
            std::mem::replace(&mut recorder, Recorder::new(run.gpu)).submit(&Default::default());
            field.plant(run.gpu, planted, 1234, value);
        }
        field.advance(&mut recorder, &(stress.step)(k), 1)?;
        if k % 16 == 15 {
            std::mem::replace(&mut recorder, Recorder::new(run.gpu)).submit(&Default::default());
            run.gpu.wait()?;
        }
    }
    recorder.submit(&Default::default());
    let after = values(run.gpu, &mut field)?;
    let name = &stress.name;
    kept(run, name, field.sphere(), [&before, &after]);
    if stress.planted.is_some() {
        let control: Vec<ControlBlock> = bytemuck::pod_collect_to_vec(&field.read_control(run.gpu).wait(run.gpu)?);
        let sanitised = control.iter().map(|block| block.sanitised).sum::<u32>();
        // A value reaches 36 stencils a lookup until it is sanitised: far below this, and more than none.
        run.at_most(
            format!("{name}: values sanitised"),
            if sanitised == 0 { f64::NAN } else { f64::from(sanitised) },
            2000.0,
        );
    }
    Ok(())
}

/// Reports whether a field stayed finite, within its range, and conserved.
fn kept(run: &mut Run<'_>, name: &str, sphere: CubedSphere, [before, after]: [&[f64]; 2]) {
    let lost = after.iter().filter(|value| !value.is_finite()).count();
    run.at_most(format!("{name}: values not finite"), lost as f64, 0.0);
    let (excess, drift) = departures(sphere, before, after);
    run.at_most(format!("{name}: beyond the range, part of it"), excess, 1e-6);
    run.at_most(format!("{name}: drift of mass"), drift, 1e-7);
}
