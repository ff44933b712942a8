//! Films that move by themselves, at the ends of what scenes allow: gravity, radius, viscosity, the length of a step, gravity that flips,
//! black film, and an hour. They must stay finite, keep their liquid and their range of thickness, and calm down no slower than their
//! slowest wave.

use glam::DVec3;

use super::{
    Extent, Run,
    played::{Played, departures, largest},
};
use crate::{
    gpu::GpuError,
    plan::{BLACK_FILM_NM, remaining_nm},
    scene::{Change, Event, Motion, MotionChange, Scene},
};

/// Gravity of the Earth, m/s².
const EARTH_M_S2: f64 = 9.81;
/// Density of the liquid, kg/m³.
const DENSITY_KG_M3: f64 = 1000.0;
/// Cells along a panel's edge: few, for a step costs what its dispatches cost.
const CELLS: u32 = 16;
/// Parts of a film's liquid and of its range of thickness that rounding may change.
const ROUNDING: f64 = 1e-6;

/// A freshly blown film of few cells in air at rest.
fn blown() -> Scene {
    let mut scene = Scene::default();
    scene.bubbles[0].film.cells = CELLS;
    scene.motion.strength = 0.0;
    scene
}

fn blown_with(change: impl FnOnce(&mut Motion)) -> Scene {
    let mut scene = blown();
    change(&mut scene.motion);
    scene
}

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    let gravities = [(0.0, 2.0), (100.0, 0.6), (0.01, 10.0), (1.0, 6.0)];
    for (gravities, seconds) in gravities.into_iter().take(run.short_or_full(2, 4)) {
        let scene = blown_with(|motion| motion.gravity_m_s2 = down(gravities));
        film(run, &format!("gravity of {gravities} g"), &scene, seconds)?;
    }
    let radii_mm = [(0.1, 100.0, 0.3), (1000.0, 1.0, 14.0), (0.1, 1.0, 0.3), (10.0, 1.0, 2.0)];
    for (radius_mm, gravities, seconds) in radii_mm.into_iter().take(run.short_or_full(1, 4)) {
        let mut scene = blown_with(|motion| motion.gravity_m_s2 = down(gravities));
        scene.bubbles[0].radius_mm = radius_mm;
        film(run, &format!("a radius of {radius_mm} mm in {gravities} g"), &scene, seconds)?;
    }
    for pa_s in [1e-4, 10.0].into_iter().take(run.short_or_full(1, 2)) {
        let scene = blown_with(|motion| motion.viscosity_mm2_s = 1e6 * pa_s / DENSITY_KG_M3);
        film(run, &format!("a viscosity of {pa_s} Pa s"), &scene, run.short_or_full(3.0, 6.0))?;
    }
    film(run, "ticks of 0.1 s", &blown_with(|motion| motion.tick_s = 0.1), run.short_or_full(3.0, 6.0))?;
    film(run, "steps of 1 to 17 ms in turn", &spikes(), run.short_or_full(2.0, 4.0))?;
    film(run, "gravity that flips", &flips(), run.short_or_full(5.0, 8.0))?;
    black(run)?;
    an_hour(run)
}

fn down(gravities: f64) -> [f64; 3] {
    [0.0, 0.0, -EARTH_M_S2 * gravities]
}

/// Plays a film for a time in seconds, and holds it to what must always be, and to its way to rest.
fn film(run: &mut Run<'_>, name: &str, scene: &Scene, seconds: f64) -> Result<(), GpuError> {
    const LOOKS: usize = 8;
    let mut played = Played::new(run.gpu, scene)?;
    let before = played.thickness()?;
    let ticks = (seconds / scene.motion.tick_s).round() as u64;
    let (mut unfinished, mut beyond, mut drift, mut fastest) = (0, Vec::new(), Vec::new(), Vec::new());
    for look in 1..=LOOKS as u64 {
        played.play_to(ticks * look / LOOKS as u64)?;
        let after = played.thickness()?;
        unfinished += after.iter().filter(|value| !value.is_finite()).count();
        let (excess, change) = departures(played.sphere(), &before, &after);
        beyond.push(excess);
        drift.push(change);
        fastest.push(played.fastest()?);
    }
    run.at_most(format!("{name}: values not finite"), unfinished as f64, 0.0);
    run.at_most(format!("{name}: beyond the range, part of it"), largest(beyond.into_iter()), ROUNDING);
    run.at_most(format!("{name}: drift of mass"), largest(drift.into_iter()), 1e-7);
    let [first, second] = [&fastest[..LOOKS / 2], &fastest[LOOKS / 2..]].map(|half| largest(half.iter().copied()));
    let all = largest([first, second].into_iter());
    let free_fall = free_fall(scene);
    if free_fall == 0.0 {
        run.at_most(format!("{name}: fastest flow, rad/s"), all, 0.0);
        return Ok(());
    }
    run.at_most(format!("{name}: fastest flow over free fall"), all / free_fall, 1.0);
    let max = (-slowest_decay(scene) * 0.5 * seconds).exp();
    run.at_most(format!("{name}: fastest flow of the second half of {seconds} s over the first"), second / first, max);
    Ok(())
}

/// The fastest that anything falls, freely and by a diameter: rad/s.
fn free_fall(scene: &Scene) -> f64 {
    2.0 * (DVec3::from(scene.motion.gravity_m_s2).length() / (1e-3 * scene.bubbles[0].radius_mm)).sqrt()
}

/// The rate in 1/s at which the slowest wave of a sorted film decays: ζ of degree l and order m obeys `ζ_tt + α ζ_t + σ² ζ = 0`, with drag and
/// viscosity in α and σ² = (g a / R) m² / (l (l + 1)).
fn slowest_decay(scene: &Scene) -> f64 {
    // A blown film of 340 to 1130 nm is e^1.2 times as thick at the bottom as at the top once it is sorted; less if some of it has mixed.
    const STRATIFICATION: f64 = 0.3;
    let radius_m = 1e-3 * scene.bubbles[0].radius_mm;
    let per_area = 1e-6 / radius_m.powi(2);
    let motion = &scene.motion;
    let gravity = DVec3::from(motion.gravity_m_s2).length() / radius_m;
    // Shorter waves than of two cells do not exist.
    let decays = (1..=2 * CELLS).map(|degree| {
        let eigenvalue = f64::from(degree * (degree + 1));
        let drag = motion.drag_1_s + per_area * motion.viscosity_mm2_s * (eigenvalue - 2.0);
        let discriminant = 0.25 * drag * drag - gravity * STRATIFICATION / eigenvalue;
        0.5 * drag - discriminant.max(0.0).sqrt()
    });
    decays.fold(f64::INFINITY, f64::min)
}

/// Steps of all lengths in turn: laws that change at once cut them.
fn spikes() -> Scene {
    let mut scene = blown_with(|motion| motion.tick_s = 1e-3);
    // Changes too small to matter but for where steps are cut.
    let nudge = |tick: u64| {
        let gravity_m_s2 = Some([0.0, 0.0, -EARTH_M_S2 - 1e-9 * tick as f64]);
        Event { tick, change: Change::Motion(MotionChange { gravity_m_s2, ..MotionChange::default() }) }
    };
    scene.events = (0..120).map(|k| nudge(17 * k + (k * k * 7) % 16)).collect();
    scene
}

/// Gravity that turns over again and again, ever slower, and then stays.
fn flips() -> Scene {
    let mut scene = blown();
    let flip = |k: u64| {
        let gravity_m_s2 = Some(down(if k.is_multiple_of(2) { -1.0 } else { 1.0 }));
        Event { tick: k * k, change: Change::Motion(MotionChange { gravity_m_s2, ..MotionChange::default() }) }
    };
    scene.events = (2..14).map(flip).collect();
    scene
}

/// Films that collapse to black film in half of their places, and one that evaporates until it is black everywhere. The first
/// tremble long, the more so the wider their cells: the border is as wide as a cell, and what collapses there is heavier here and lighter there.
fn black(run: &mut Run<'_>) -> Result<(), GpuError> {
    // Their cells, what evaporates, how long they are played, and how fast they may be then, as a part of free fall.
    let films = [
        ("a half black film", CELLS, 0.0, 240, 1.0),
        ("a half black film of 64 cells", 64, 0.0, 600, 0.05),
        ("a film that turns black", CELLS, 40.0, 420, 1.0),
    ];
    // The shorter run of few cells comes to what the longer one of many does, but for how it ends.
    for (name, cells, evaporation_nm_s, ticks, max) in films {
        if cells > CELLS && run.extent == Extent::Short {
            continue;
        }
        let mut scene = blown_with(|motion| motion.evaporation_nm_s = evaporation_nm_s);
        scene.bubbles[0].film.cells = cells;
        // Black film by itself would burst.
        scene.motion.black_film_life_s = 1e6;
        scene.bubbles[0].film.thickness_nm = 50.0;
        let mut played = Played::new(run.gpu, &scene)?;
        let before = played.thickness()?;
        played.play_to(ticks)?;
        let evaporated_nm = evaporation_nm_s * ticks as f64 * scene.motion.tick_s;
        let after: Vec<f64> = played.thickness()?.into_iter().map(|nm| remaining_nm(nm, evaporated_nm)).collect();
        let (fastest, unfinished) = (played.fastest()?, after.iter().filter(|value| !value.is_finite()).count());
        run.at_most(format!("{name}: values not finite"), unfinished as f64, 0.0);
        run.at_most(format!("{name}: fastest flow over free fall"), fastest / free_fall(&scene), max);
        if evaporation_nm_s == 0.0 {
            run.at_most(format!("{name}: drift of mass"), departures(played.sphere(), &before, &after).1, 1e-7);
        } else {
            let off = largest(after.iter().map(|nm| (nm / BLACK_FILM_NM - 1.0).abs()));
            run.at_most(format!("{name}: departure from black film, part of it"), off, 1e-3);
            run.at_most(format!("{name}: flow that is left, rad/s"), fastest, 1e-3);
        }
    }
    Ok(())
}

/// An hour of a blown film, most of which it rests. In the short form more drag and a smaller bubble bring it to rest sooner.
fn an_hour(run: &mut Run<'_>) -> Result<(), GpuError> {
    const HOUR_S: f64 = 3600.0;
    let (slower, radius_mm) = run.short_or_full((16.0, 5.0), (1.0, 50.0));
    let mut scene = blown_with(|motion| motion.drag_1_s *= slower);
    scene.bubbles[0].radius_mm = radius_mm;
    let mut played = Played::new(run.gpu, &scene)?;
    let before = played.thickness()?;
    played.play_to((HOUR_S / scene.motion.tick_s).round() as u64)?;
    let after = played.thickness()?;
    let unfinished = after.iter().filter(|value| !value.is_finite()).count();
    let (excess, drift) = departures(played.sphere(), &before, &after);
    run.at_most("an hour: values not finite", unfinished as f64, 0.0);
    run.at_most("an hour: beyond the range, part of it", excess, ROUNDING);
    run.at_most("an hour: drift of mass", drift, 1e-7);
    run.at_most("an hour: time until the film rests, s", played.rests_since_s().unwrap_or(f64::INFINITY), 120.0);
    Ok(())
}
