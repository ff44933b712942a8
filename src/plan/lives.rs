//! Lives of a bubble: it is blown, it bursts where it is pricked or when its film has been black for long enough, and a new one is blown.
//!
//! When it bursts follows from the scene alone, so that any moment of any life can be shown without those before it.

use glam::DVec3;

use super::{
    Moment,
    keys::{HoleKey, evaporated_nm, thins_at_tick},
    want::{evaporation, fold_seed, initial_film},
};
use crate::{
    physics::film::{Random, burst_s, properties::BLACK_FILM_ONSET},
    scene::{Bubble, Scene},
};

/// A bubble at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Life {
    /// The tick at which it was blown.
    pub born: u64,
    /// How many there were before it.
    pub generation: u32,
    /// The moment of its film since it was blown; while it bursts, that of the burst.
    pub moment: Moment,
    /// The hole in it, while it bursts.
    pub hole: Option<HoleKey>,
}

/// The life of a bubble that a moment falls into; nothing between two lives.
pub fn life(scene: &Scene, index: usize, moment: Moment) -> Option<Life> {
    let bubble = scene.bubbles.get(index)?;
    let (motion, radius_m) = (&scene.motion, bubble.radius_mm * 1e-3);
    let (mut born, mut generation) = (0, 0);
    loop {
        let alive = |moment, hole| Life { born, generation, moment, hole };
        let Some((tick, at)) = end(scene, index, born, generation).filter(|(tick, _)| *tick <= moment.tick) else {
            return Some(alive(Moment { tick: moment.tick - born, ..moment }, None));
        };
        let slowdown = motion.burst_slowdown;
        let lasts_s = burst_s(initial_film(bubble, generation).range_nm().1, radius_m);
        let seconds = ((moment.tick - tick) as f64 + moment.fraction) * motion.tick_s / slowdown;
        if seconds < lasts_s {
            return Some(alive(Moment::tick(tick - born), Some(HoleKey { at, seconds })));
        }
        let next = tick.saturating_add(((lasts_s * slowdown + motion.renew_s) / motion.tick_s).ceil().max(1.0) as u64);
        if moment.tick < next {
            return None;
        }
        (born, generation) = (next, generation + 1);
    }
}

/// When a life ends, and where the hole opens if something pricks the film; else it is where the film is thinnest.
fn end(scene: &Scene, index: usize, born: u64, generation: u32) -> Option<(u64, Option<DVec3>)> {
    let worn = worn_at(scene, index, born, generation).map(|tick| (tick, None));
    let pricked = pricks(scene, index).find(|(tick, _)| *tick >= born).map(|(tick, at)| (tick, Some(at)));
    [worn, pricked].into_iter().flatten().min_by_key(|(tick, _)| *tick)
}

/// Ticks at which a bubble is pricked, in order, and the directions in its film.
fn pricks(scene: &Scene, index: usize) -> impl Iterator<Item = (u64, DVec3)> {
    let _ = (scene, index);
    std::iter::empty()
}

/// The tick at which black film gives way: it lasts for a random time, exponential with the scene's mean, once the film's thinnest part is
/// thin enough to collapse.
fn worn_at(scene: &Scene, index: usize, born: u64, generation: u32) -> Option<u64> {
    let bubble = &scene.bubbles[index];
    let rates = evaporation(scene, bubble.radius_mm * 1e-3);
    let tick_s = scene.motion.tick_s;
    let spare_nm = initial_film(bubble, generation).range_nm().0 - 1e9 * BLACK_FILM_ONSET;
    let gone_nm = evaporated_nm(&rates, tick_s, born as f64) + spare_nm.max(0.0);
    let never_thins = rates.iter().all(|(_, rate)| *rate == 0.0);
    let black_at = if never_thins { return None } else { thins_at_tick(&rates, tick_s, gone_nm)? };
    let lasts_s = -scene.motion.black_film_life_s * chance(bubble, index, generation).ln();
    let ticks = black_at.max(born as f64) + lasts_s / tick_s;
    // A bubble is seen before it bursts, and times beyond all clocks are never.
    (ticks < 1e15).then(|| (ticks.ceil() as u64).max(born + 1))
}

/// A random number in (0, 1] that belongs to a life.
fn chance(bubble: &Bubble, index: usize, generation: u32) -> f64 {
    let stream = (index as u32).wrapping_shl(16) ^ generation;
    1.0 - Random::new(fold_seed(bubble.film.seed), stream).between(0.0, 1.0)
}

/// What holds from ticks on, in order, counted from a later tick.
pub fn since<T: Copy>(born: u64, entries: &[(u64, T)]) -> Vec<(u64, T)> {
    let first = entries.partition_point(|(tick, _)| *tick <= born).saturating_sub(1);
    entries[first..].iter().map(|(tick, entry)| (tick.saturating_sub(born), *entry)).collect()
}
