//! What people do to a bubble: stirs, jets of air, drags. A film that is pushed moves as it should, and comes back to rest from anything.

use glam::DVec3;

use super::{
    Extent, Run,
    played::{Played, departures, key, largest},
    random::Random,
};
use crate::{
    gpu::GpuError,
    physics::{
        film::{Push, gained},
        flow::fit_oscillation,
    },
    plan::Story,
    scene::{Blow, Change, Drag, Event, FilmStateName, MotionChange, Scene, Stir},
};

/// What pushes do, and what films do after them.
pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    pushed(run)?;
    undriven(run)?;
    sloshing(run)?;
    creeping(run)?;
    anything(run, "", run.short_or_full(30, 3000), 0.5)?;
    // Accelerated as no bubble could bear.
    anything(run, ", dragged by kilometres", run.short_or_full(8, 200), 1000.0)
}

/// A film without weight in air at rest.
#[must_use]
pub fn weightless(cells: u32) -> Scene {
    let mut scene = Scene::default();
    scene.bubbles[0].film.cells = cells;
    scene.motion.gravity_m_s2 = [0.0; 3];
    (scene.motion.strength, scene.motion.drag_1_s, scene.motion.viscosity_mm2_s) = (0.0, 0.0, 0.0);
    scene
}

/// After its first step, the middle of a stir moves as the closed form says.
fn pushed(run: &mut Run<'_>) -> Result<(), GpuError> {
    for radius_deg in run.short_or_full([15.0].as_slice(), &[8.0, 15.0, 40.0]).iter().copied() {
        let stir = Stir { at: [0.5, 0.4, 0.3], velocity_m_s: [-0.04, 0.05, 0.0], radius_deg, ..Stir::default() };
        let event = Event { tick: 0, change: Change::Stir(stir.clone()) };
        let scene = Scene { events: vec![event], ..weightless(64) };
        let mut played = Played::new(run.gpu, &scene)?;
        played.play_to(2)?;
        let (grid, center) = (played.flow()?.sphere(), DVec3::from(stir.at).normalize());
        let nearest = (0..grid.cells())
            .min_by(|a, b| {
                let angle = |cell: usize| grid.cell_direction(cell).distance_squared(center);
                angle(*a).total_cmp(&angle(*b))
            })
            .unwrap_or(0);
        let pushes = key(&Story::new(scene.clone()), 2)?.pushes_during(0.0, 2.0);
        let push = pushes.first().copied().unwrap_or_else(|| unreachable!("a push acts"));
        let dt_s = 2.0 * scene.motion.tick_s;
        let expected = gained(Push::sharpness_of(radius_deg.to_radians())) * push.rate * dt_s * push.velocity;
        let error = played.velocity()?[nearest].distance(expected) / expected.length();
        // The nearest cell is up to half a cell away from the middle.
        run.at_most(format!("a stir of {radius_deg}°: error of the speed in its middle"), error, 0.03);
    }
    Ok(())
}

/// However hard a film is stirred, once nothing drives it it has no more energy than it was left with: a film without weight, and a heavy
/// one of the same thickness everywhere. Hardly anything slows them down.
fn undriven(run: &mut Run<'_>) -> Result<(), GpuError> {
    const LOOK_TICKS: u64 = 10;
    let looks = run.short_or_full(3, 12);
    let film = |cells, gravity_m_s2: [f64; 3]| {
        let mut scene = weightless(cells);
        // So nearly even that gravity does nothing to it, but not so even that it would not flow.
        (scene.bubbles[0].film.state, scene.bubbles[0].film.stratification) = (FilmStateName::Rest, 1e-6);
        (scene.motion.gravity_m_s2, scene.motion.drag_1_s) = (gravity_m_s2, 0.01);
        scene
    };
    for (name, gravity_m_s2, cells, radius_deg, speeds_m_s) in [
        ("a film without weight", [0.0; 3], 16, 15.0, [0.1, 0.3, 1.0, 3.0, 10.0].as_slice()),
        ("a film without weight", [0.0; 3], 32, 6.0, &[0.3, 1.0]),
        ("a heavy even film", [0.0, 0.0, -9.81], 16, 15.0, &[0.3, 3.0]),
    ] {
        // The fastest is the hardest.
        let first = run.short_or_full(speeds_m_s.len() - 1, 0);
        for speed in &speeds_m_s[first..] {
            let velocity_m_s = [-0.6 * speed, 0.75 * speed, 0.0];
            let stir = Stir { at: [0.5, 0.4, 0.3], velocity_m_s, radius_deg, ..Stir::default() };
            let left_alone = stir.ticks;
            let scene =
                Scene { events: vec![Event { tick: 0, change: Change::Stir(stir) }], ..film(cells, gravity_m_s2) };
            let mut played = Played::new(run.gpu, &scene)?;
            played.play_to(left_alone)?;
            let (start, mut later) = (played.energy()?, Vec::new());
            for look in 1..=looks {
                played.play_to(left_alone + LOOK_TICKS * look)?;
                later.push(played.energy()? / start);
            }
            let seconds = (looks * LOOK_TICKS) as f64 * scene.motion.tick_s;
            let what = format!(
                "{name}, stirred at {speed} m/s over {radius_deg}°: most energy in {seconds} s over that at the start"
            );
            run.at_most(what, largest(later.into_iter()), 1.001);
        }
    }
    Ok(())
}

/// Dragged to the side and back, or stirred upwards at its side, a sorted film swings with the period of its (1,1) mode, and settles.
fn sloshing(run: &mut Run<'_>) -> Result<(), GpuError> {
    let drag = |tick, x| Event { tick, change: Change::Drag(Drag { to_m: [x, 0.0, 0.0], ..Drag::default() }) };
    swing(run, "a drag there and back", vec![drag(2, 3e-3), drag(14, 0.0)])?;
    // In the short form one of the two must do.
    if run.extent == Extent::Short {
        return Ok(());
    }
    let stir = Stir { at: [1.0, 0.0, 0.0], velocity_m_s: [0.0, 0.0, 0.01], radius_deg: 40.0, ..Stir::default() };
    swing(run, "a stir", vec![Event { tick: 2, change: Change::Stir(stir) }])
}

fn swing(run: &mut Run<'_>, name: &str, events: Vec<Event>) -> Result<(), GpuError> {
    let (drag_1_s, a) = (1.0, 0.6);
    let mut scene = Scene { events, ..Scene::default() };
    scene.bubbles[0].film.cells = run.short_or_full(32, 64);
    (scene.bubbles[0].film.state, scene.bubbles[0].film.stratification) = (FilmStateName::Rest, a);
    (scene.motion.strength, scene.motion.drag_1_s) = (0.0, drag_1_s);
    scene.motion.diffusion_mm2_s = 0.0;
    let mut played = Played::new(run.gpu, &scene)?;
    // By then a bubble that was dragged is back to within e⁻¹⁴, in the short form e⁻⁸.
    let calm = run.short_or_full(60, 100);
    let mut swings = Vec::new();
    for tick in (calm..calm + run.short_or_full(80, 120)).step_by(2) {
        played.play_to(tick)?;
        let (grid, zeta) = (played.flow()?.sphere(), played.zeta()?);
        let swing = |(cell, area): (usize, f64)| area * zeta[cell] * grid.cell_direction(cell).y;
        swings.push(grid.areas().into_iter().enumerate().map(swing).sum::<f64>());
    }
    let found = fit_oscillation(&swings, 2.0 * scene.motion.tick_s);
    let (frequency, growth) = found.map_or((f64::NAN, f64::NAN), |found| (found.frequency, found.growth));
    let undamped = (9.81 * a / 0.05f64 / 2.0).sqrt();
    let expected = (undamped.powi(2) - 0.25 * drag_1_s.powi(2)).sqrt();
    // The steps of a thirtieth of a second make it fast by (σ dt)²/24 = 3e-3.
    run.at_most(format!("{name}: error of the film's swing"), (frequency / expected - 1.0).abs(), 0.01);
    run.at_most(format!("{name}: error of its decay"), (growth / (-0.5 * drag_1_s) - 1.0).abs(), 0.05);
    Ok(())
}

/// Interactions as wild as scenes allow, then peace.
fn anything(run: &mut Run<'_>, name: &str, events: u64, reach_m: f64) -> Result<(), GpuError> {
    let (drag_1_s, peace_s) = (2.0, run.short_or_full(0.5, 30.0));
    let mut random = Random::new(7);
    let mut scene = Scene::default();
    scene.bubbles[0].film.cells = 16;
    (scene.motion.strength, scene.motion.drag_1_s) = (0.0, drag_1_s);
    scene.events = (0..events).map(|tick| Event { tick, change: anything_at_all(&mut random, reach_m) }).collect();
    let calm = MotionChange { gravity_m_s2: Some([0.0, 0.0, -9.81]), ..MotionChange::default() };
    scene.events.push(Event { tick: events, change: Change::Motion(calm) });
    let mut played = Played::new(run.gpu, &scene)?;
    let before = played.thickness()?;
    let mut fastest: f64 = 0.0;
    let ticks_apart = run.short_or_full(8, 100);
    for tick in (ticks_apart..=events).step_by(ticks_apart as usize) {
        played.play_to(tick)?;
        fastest = largest([fastest, played.fastest()?].into_iter());
    }
    played.play_to(events + (peace_s / scene.motion.tick_s) as u64)?;
    let (last, after) = (played.fastest()?, played.thickness()?);
    let (excess, drift) = departures(played.sphere(), &before, &after);
    let name = format!("{events} random interactions{name}");
    let unfinished = after.iter().filter(|value| !value.is_finite()).count();
    run.at_most(format!("{name}: values not finite"), unfinished as f64, 0.0);
    run.at_most(format!("{name}: beyond the range, part of it"), excess, 1e-6);
    run.at_most(format!("{name}: drift of mass"), drift, 1e-7);
    // The fastest air has 30 m/s, on a radius of 5 cm.
    run.at_most(format!("{name}: fastest flow, rad/s"), fastest, 30.0 / 0.05);
    // The short form has no time for a film to come to rest.
    if run.extent > Extent::Short {
        run.at_most(format!("{name}: flow that is left after {peace_s} s, rad/s"), last, at_rest(&scene, &after));
    }
    Ok(())
}

/// Speed at which a film counts as calm, rad/s. One that was mixed to one thickness has hardly any weight to sort it: what differences are
/// left creep to their level for minutes, as fast as drag lets them; see [`creeping`].
fn at_rest(scene: &Scene, thickness: &[f64]) -> f64 {
    const CALM: f64 = 1e-3;
    const MIXED: f64 = 1e-3;
    let (thinnest, thickest) =
        thickness.iter().fold((f64::MAX, f64::MIN), |(low, high), h| (low.min(*h), high.max(*h)));
    let spread = (thickest / thinnest).ln();
    let creep = 9.81 / (1e-3 * scene.bubbles[0].radius_mm) * spread / scene.motion.drag_1_s;
    if spread < MIXED { creep.max(CALM) } else { CALM }
}

/// A film of nearly one thickness, tilted against gravity, turns back to its level as slowly as drag lets it, and does not stop before: by
/// the (1,1) mode's slow root, `α/2 − √(α²/4 − σ²)` with `σ² = a g / 2R`.
fn creeping(run: &mut Run<'_>) -> Result<(), GpuError> {
    let (a, tilt, drag_1_s): (f64, f64, f64) = (1e-4, 0.1, 0.5);
    let mut scene = Scene::default();
    scene.bubbles[0].film.cells = 16;
    (scene.bubbles[0].film.state, scene.bubbles[0].film.stratification) = (FilmStateName::Rest, a);
    (scene.motion.strength, scene.motion.drag_1_s, scene.motion.diffusion_mm2_s) = (0.0, drag_1_s, 0.0);
    scene.motion.gravity_m_s2 = [9.81 * tilt.sin(), 0.0, -9.81 * tilt.cos()];
    let mut played = Played::new(run.gpu, &scene)?;
    let mut angle = |seconds: f64| {
        played.play_to((seconds / scene.motion.tick_s).round() as u64)?;
        let (grid, thickness) = (played.sphere(), played.thickness()?);
        // The level part does not count, but would leave its rounding.
        let weighted = grid.areas().into_iter().zip(&thickness).enumerate();
        let level = thickness.iter().sum::<f64>() / thickness.len() as f64;
        let slope: DVec3 = weighted.map(|(cell, (area, h))| area * (h - level) * grid.cell_direction(cell)).sum();
        Ok::<f64, GpuError>(tilt - (slope.x / -slope.z).atan())
    };
    let [from_s, to_s] = run.short_or_full([7.0, 9.0], [8.0, 30.0]);
    let (first, last): (f64, f64) = (angle(from_s)?, angle(to_s)?);
    let swing = 0.5 * a * 9.81 / (1e-3 * scene.bubbles[0].radius_mm);
    let expected = 0.5 * drag_1_s - (0.25 * drag_1_s * drag_1_s - swing).sqrt();
    let found = (first / last).ln() / (to_s - from_s);
    run.at_most("a nearly even film creeps to its level: error of the rate", (found / expected - 1.0).abs(), 0.03);
    Ok(())
}

/// An event of any kind, with any values in range, that lasts up to a quarter of a second.
fn anything_at_all(random: &mut Random, reach_m: f64) -> Change {
    let mut vector = |size: f64| [0; 3].map(|_| size * (2.0 * random.next() - 1.0));
    let (at, toward, velocity_m_s, to_m, gravity) =
        (vector(1.0), vector(1.0), vector(10.0), vector(reach_m), vector(20.0));
    let radius_deg = 3.0 + 87.0 * random.next();
    let ticks = 1 + (15.0 * random.next()) as u64;
    match (4.0 * random.next()) as u32 {
        0 => Change::Stir(Stir { bubble: 0, at, velocity_m_s, radius_deg, ticks }),
        1 => Change::Blow(Blow { bubble: 0, at, toward, speed_m_s: 30.0 * random.next(), radius_deg, ticks }),
        2 => Change::Drag(Drag { bubble: 0, to_m }),
        _ => Change::Motion(MotionChange { gravity_m_s2: Some(gravity), ..MotionChange::default() }),
    }
}
