//! Lives of a bubble: it is blown, it bursts where it is pricked or when its film has been black for long enough, and a new one is blown.
//!
//! When it bursts follows from the scene alone, so that any moment of any life can be shown without those before it.

use glam::DVec3;

use super::{
    Moment,
    films::{evaporation, fold_seed, initial_film, thinning},
    keys::{BLACK_FILM_NM, HoleKey, evaporated_nm},
    thinning::{Thinning, thins_at_tick},
};
use crate::{
    physics::film::{Random, burst_s, properties::BLACK_FILM_ONSET},
    scene::{Bubble, Change, Motion, Scene},
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
    let (ends, tick_s) = (Ends::new(scene, index)?, scene.motion.tick_s);
    let (mut born, mut generation) = (0, 0);
    loop {
        let alive = |moment, hole| Life { born, generation, moment, hole };
        let Some((tick, at)) = ends.of_life(born, generation).filter(|(tick, _)| *tick <= moment.tick) else {
            return Some(alive(Moment { tick: moment.tick - born, ..moment }, None));
        };
        let Motion { burst_slowdown: slowdown, renew_s, .. } = ends.motion_at(tick);
        let lasts_s = ends.burst_s(born, generation, tick);
        let seconds = ((moment.tick - tick) as f64 + moment.fraction) * tick_s / slowdown;
        if seconds < lasts_s {
            return Some(alive(Moment::tick(tick - born), Some(HoleKey { at, seconds })));
        }
        let next = tick.saturating_add(((lasts_s * slowdown + renew_s) / tick_s).ceil().max(1.0) as u64);
        if moment.tick < next {
            return None;
        }
        (born, generation) = (next, generation + 1);
    }
}

/// What ends the lives of a bubble, from a scene's events once for all lives: with thousands of events there may be thousands of lives.
struct Ends<'s> {
    scene: &'s Scene,
    index: usize,
    bubble: &'s Bubble,
    /// Ticks at which the bubble is pricked, in order, and the directions in its film.
    pricks: Vec<(u64, DVec3)>,
    /// What moves it, from which tick on.
    motions: Vec<(u64, Motion)>,
    /// What its film thins by.
    laws: Vec<(u64, Thinning)>,
    /// What evaporates from it, nm/s.
    rates: Vec<(u64, f64)>,
}

impl<'s> Ends<'s> {
    /// Those of a bubble; nothing if there is no such bubble.
    fn new(scene: &'s Scene, index: usize) -> Option<Self> {
        let bubble = scene.bubbles.get(index)?;
        let radius_m = bubble.radius_mm * 1e-3;
        let pricks = scene.events.iter().filter_map(|event| match &event.change {
            Change::Prick(prick) if prick.bubble == index => Some((event.tick, DVec3::from(prick.at).normalize())),
            _ => None,
        });
        let (laws, rates) = (thinning(scene, radius_m), evaporation(scene, radius_m));
        let motions = scene.motions().collect();
        Some(Self { scene, index, bubble, pricks: pricks.collect(), motions, laws, rates })
    }

    /// The motion that is in force at a tick.
    fn motion_at(&self, tick: u64) -> &Motion {
        let begun = self.motions.partition_point(|(from, _)| *from <= tick);
        // The first one holds from tick 0 on.
        &self.motions[begun.saturating_sub(1)].1
    }

    /// When a life ends, and where the hole opens if something pricks the film; else it is where the film is thinnest.
    fn of_life(&self, born: u64, generation: u32) -> Option<(u64, Option<DVec3>)> {
        let next = self.pricks.partition_point(|(tick, _)| *tick < born);
        let pricked = self.pricks.get(next).map(|(tick, at)| (*tick, Some(*at)));
        let before = pricked.map_or(u64::MAX, |(tick, _)| tick);
        let worn = self.worn_at(born, generation, before).map(|tick| (tick, None));
        [worn, pricked].into_iter().flatten().min_by_key(|(tick, _)| *tick)
    }

    /// The tick at which black film gives way: it lasts for a random time, exponential with the scene's mean, once the top of the sorted
    /// film is thin enough to collapse. Laws that begin later than a tick are of no account.
    fn worn_at(&self, born: u64, generation: u32, before: u64) -> Option<u64> {
        let tick_s = self.scene.motion.tick_s;
        let laws = since(born, until(before, &self.laws));
        let top_nm = initial_film(self.bubble, generation).sorted_top_nm();
        let black_at = born as f64 + thins_at_tick(laws, tick_s, top_nm, 1e9 * BLACK_FILM_ONSET)?;
        let life_s = self.motion_at(black_at as u64).black_film_life_s;
        let lasts_s = -life_s * chance(self.bubble, self.index, generation).ln();
        let ticks = black_at + lasts_s / tick_s;
        // A bubble is seen before it bursts, and times beyond all clocks are never.
        (ticks < 1e15).then(|| (ticks.ceil() as u64).max(born + 1))
    }

    /// How long the burst that ends a life at a tick lasts, s of film time without slow motion.
    fn burst_s(&self, born: u64, generation: u32, tick: u64) -> f64 {
        let rates: Vec<_> = since(born, until(tick, &self.rates)).collect();
        let evaporated_nm = evaporated_nm(&rates, self.scene.motion.tick_s, (tick - born) as f64);
        let thickest_nm = initial_film(self.bubble, generation).range_nm().1 - evaporated_nm;
        burst_s(thickest_nm.max(BLACK_FILM_NM), self.bubble.radius_mm * 1e-3)
    }
}

/// A random number in (0, 1] that belongs to a life.
fn chance(bubble: &Bubble, index: usize, generation: u32) -> f64 {
    let stream = (index as u32).wrapping_shl(16) ^ generation;
    1.0 - Random::new(fold_seed(bubble.film.seed), stream).between(0.0, 1.0)
}

/// What holds from ticks on, in order, counted from a later tick.
pub fn since<T: Copy>(born: u64, entries: &[(u64, T)]) -> impl Iterator<Item = (u64, T)> {
    let first = entries.partition_point(|(tick, _)| *tick <= born).saturating_sub(1);
    entries[first..].iter().map(move |(tick, entry)| (tick.saturating_sub(born), *entry))
}

/// What holds from ticks on, in order, without what begins at a tick or later; the first entry at least.
fn until<T>(end: u64, entries: &[(u64, T)]) -> &[(u64, T)] {
    let kept = entries.partition_point(|(tick, _)| *tick < end).max(1);
    &entries[..kept.min(entries.len())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        physics::film::properties::{DENSITY, GRAVITY, VISCOSITY},
        scene::{Event, Film, FilmStateName, Flow, Prick},
    };

    /// When the first bubble of a scene ends, and where, had it been blown at tick 0 after so many others.
    fn end_of(scene: &Scene, generation: u32) -> Option<(u64, Option<DVec3>)> {
        Ends::new(scene, 0).unwrap().of_life(0, generation)
    }

    fn pricked(ticks: &[u64]) -> Scene {
        let prick = |tick: &u64| Event { tick: *tick, change: Change::Prick(Prick::default()) };
        Scene { events: ticks.iter().map(prick).collect(), ..Scene::default() }
    }

    fn dry(black_film_life_s: f64) -> Scene {
        Scene { motion: Motion { evaporation_nm_s: 50.0, black_film_life_s, ..Motion::default() }, ..Scene::default() }
    }

    #[test]
    fn a_bubble_that_nothing_wears_or_pricks_lives_for_ever() {
        let forever = life(&Scene::default(), 0, Moment::tick(1 << 40)).unwrap();
        assert_eq!((forever.born, forever.generation, forever.hole), (0, 0, None));
        assert_eq!(life(&Scene::default(), 7, Moment::default()), None, "no such bubble");
    }

    #[test]
    fn a_prick_opens_a_hole_there_and_a_new_bubble_follows() {
        let scene = pricked(&[100]);
        assert_eq!(life(&scene, 0, Moment { tick: 99, fraction: 0.5 }).unwrap().hole, None);
        let burst = life(&scene, 0, Moment { tick: 100, fraction: 0.5 }).unwrap();
        let hole = HoleKey { at: Some(DVec3::X), seconds: 0.5 * scene.motion.tick_s };
        assert_eq!((burst.moment, burst.hole), (Moment::tick(100), Some(hole)));
        assert_eq!(life(&scene, 0, Moment::tick(110)), None, "gone within 30 ms");
        let renewed = life(&scene, 0, Moment::tick(300)).unwrap();
        assert_eq!(renewed.generation, 1);
        // A 5 cm bubble of up to 1190 nm is gone in 24 ms, and 2 s later there is another.
        assert_eq!(renewed.born, 100 + ((0.02424_f64 + 2.0) * 60.0).ceil() as u64);
        assert_eq!(renewed.moment, Moment::tick(300 - renewed.born));
    }

    #[test]
    fn pricks_between_two_bubbles_miss() {
        let scene = pricked(&[100, 120]);
        assert_eq!(life(&scene, 0, Moment::tick(300)).unwrap().generation, 1);
        assert_eq!(life(&pricked(&[100, 280]), 0, Moment::tick(600)).unwrap().generation, 2);
    }

    #[test]
    fn in_slow_motion_it_takes_longer() {
        let mut scene = pricked(&[100]);
        scene.motion.burst_slowdown = 100.0;
        let hole = life(&scene, 0, Moment::tick(160)).unwrap().hole.unwrap();
        assert!((hole.seconds - 0.01).abs() < 1e-12);
    }

    #[test]
    fn a_film_that_evaporates_wears_out_at_the_pace_of_evaporation() {
        // 399 nm at the top once it is sorted, black at 50 nm: 7 s at 50 nm/s.
        let at = |scene: &Scene| end_of(scene, 0).unwrap();
        let (tick, middle) = at(&dry(0.0));
        assert_eq!(middle, None, "where the film is thinnest");
        assert!((tick as f64 / 60.0 - 6.98).abs() < 0.02, "{tick}");
        let mean: f64 = (0..400).map(|k| end_of(&dry(10.0), k).unwrap().0 as f64 / 60.0).sum::<f64>() / 400.0;
        // An exponential law of mean 10 s: 400 lives tell it to 5 %, three times that is certain.
        assert!((mean - 16.98).abs() < 1.5, "{mean}");
    }

    #[test]
    fn a_film_that_drains_wears_out_too() {
        // Ten thousand times as fast as in life, from 399 to 50 nm.
        let inverse_squares = (50e-9f64).powi(-2) - (399e-9f64).powi(-2);
        let expected_s = 1e-4 * 3.0 * VISCOSITY * 0.05 / (DENSITY * GRAVITY) * inverse_squares;
        let lifetime_s = |evaporation_nm_s| {
            let motion = Motion { drainage: 1e4, evaporation_nm_s, black_film_life_s: 0.0, ..Motion::default() };
            let end = end_of(&Scene { motion, ..Scene::default() }, 0).unwrap();
            end.0 as f64 / 60.0
        };
        let (alone, dry) = (lifetime_s(0.0), lifetime_s(1.0));
        assert!((alone / expected_s - 1.0).abs() < 0.01, "{alone} {expected_s}");
        assert!(dry < alone && dry > 50.0, "{dry}");
        let motion = Motion { drainage: 1e4, flow: Flow::Rest, ..Motion::default() };
        assert_eq!(end_of(&Scene { motion, ..Scene::default() }, 0), None, "nothing drains where nothing moves");
    }

    #[test]
    fn lifetimes_follow_humidity() {
        let lifetime_s = |humidity| {
            let motion = Motion { humidity, black_film_life_s: 0.0, ..Motion::default() };
            let end = end_of(&Scene { motion, ..Scene::default() }, 0);
            end.map(|(tick, _)| tick as f64 / 60.0)
        };
        assert_eq!(lifetime_s(1.0), None);
        let (dry, half) = (lifetime_s(0.0).unwrap(), lifetime_s(0.5).unwrap());
        assert!((half / dry - 2.0).abs() < 0.01, "as the vapour that is missing: {dry} {half}");
    }

    /// Evaporation sets the life to the leading order, from dry air that moves to moist air that stands (Miguet et al. 2020, Soft Matter 16,
    /// arXiv 1907.09734; Aurégan & Deike 2025, arXiv 2411.03908: from a few seconds to tens of minutes). Film of 1 µm on 5 cm lasts 17 s where
    /// 60 nm evaporate a second, 20 to 33 s in a draught of 0.1 to 0.3 m/s at 50 % of humidity, and 4 minutes where nothing but diffusion
    /// takes the vapour away. All within a factor of two.
    #[test]
    fn lifetimes_are_the_published_ones_within_a_factor_of_two() {
        let lifetime_s = |motion: Motion| {
            let film =
                Film { state: FilmStateName::Rest, thickness_nm: 1000.0, stratification: 0.05, ..Film::default() };
            let motion = Motion { black_film_life_s: 0.0, ..motion };
            let scene = Scene { motion, bubbles: vec![Bubble { film, ..Bubble::default() }], ..Scene::default() };
            end_of(&scene, 0).map_or(f64::INFINITY, |(tick, _)| tick as f64 * scene.motion.tick_s)
        };
        let air = |humidity, air_speed_m_s| lifetime_s(Motion { humidity, air_speed_m_s, ..Motion::default() });
        let evaporating = lifetime_s(Motion { evaporation_nm_s: 60.0, ..Motion::default() });
        let cases = [(evaporating, 17.0), (air(0.5, 0.1), 33.0), (air(0.5, 0.3), 20.0), (air(0.5, 0.0), 250.0)];
        for (found, published) in cases {
            assert!((0.5..2.0).contains(&(found / published)), "{found} {published}");
        }
        let (dry, moist) = (air(0.1, 0.5), air(0.95, 0.0));
        assert!(
            (3.0..20.0).contains(&dry) && (600.0..3600.0).contains(&moist),
            "seconds, and tens of minutes: {dry} {moist}"
        );
        assert_eq!(air(1.0, 0.5), f64::INFINITY, "nothing evaporates into saturated air");
    }

    #[test]
    fn what_came_before_a_life_is_its_beginning() {
        let since = |born, entries: &[(u64, char)]| since(born, entries).collect::<Vec<_>>();
        assert_eq!(since(0, &[(0, 'a'), (5, 'b')]), [(0, 'a'), (5, 'b')]);
        assert_eq!(since(7, &[(0, 'a'), (5, 'b'), (9, 'c')]), [(0, 'b'), (2, 'c')]);
        assert_eq!(since(5, &[(0, 'a'), (5, 'b')]), [(0, 'b')]);
        assert_eq!(until(5, &[(0, 'a'), (5, 'b')]), [(0, 'a')]);
        assert_eq!(until(0, &[(0, 'a'), (5, 'b')]), [(0, 'a')]);
    }
}
