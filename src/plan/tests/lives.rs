//! Life cycles of bubbles, as scenes have them.

use super::*;
use crate::{
    physics::{
        bubble::Age,
        film::properties::{DENSITY, GRAVITY, VISCOSITY},
    },
    scene::{Film, Motion, Prick},
};

/// A bubble of a scene at a moment.
fn age(scene: &Scene, index: usize, moment: Moment) -> Option<Age> {
    Story::new(scene.clone()).age(index, moment)
}

/// When and where the first bubble of a scene ends, had it been blown at tick 0 as number `generation`.
fn end_of(scene: &Scene, generation: u32) -> Option<(u64, Option<DVec3>)> {
    Story::new(scene.clone()).life_cycle(0).unwrap().end_of(0, generation)
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
    let forever = age(&Scene::default(), 0, Moment::tick(1 << 40)).unwrap();
    assert_eq!((forever.life.born, forever.life.generation, forever.hole), (0, 0, None));
    assert!(age(&Scene::default(), 7, Moment::default()).is_none(), "no such bubble");
}

#[test]
fn a_prick_opens_a_hole_there_and_a_new_bubble_follows() {
    let scene = pricked(&[100]);
    assert_eq!(age(&scene, 0, Moment { tick: 99, fraction: 0.5 }).unwrap().hole, None);
    let burst = age(&scene, 0, Moment { tick: 100, fraction: 0.5 }).unwrap();
    let hole = Opening { at: Some(DVec3::X), seconds: 0.5 * scene.motion.tick_s };
    assert_eq!((burst.moment, burst.hole), (Moment::tick(100), Some(hole)));
    assert!(age(&scene, 0, Moment::tick(110)).is_none(), "gone within 30 ms");
    let renewed = age(&scene, 0, Moment::tick(300)).unwrap();
    assert_eq!(renewed.life.generation, 1);
    // A 5 cm bubble of up to 1190 nm is gone in 24 ms, and 2 s later there is another.
    assert_eq!(renewed.life.born, 100 + ((0.02424_f64 + 2.0) * 60.0).ceil() as u64);
    assert_eq!(renewed.moment, Moment::tick(300 - renewed.life.born));
}

#[test]
fn pricks_between_two_bubbles_miss() {
    let scene = pricked(&[100, 120]);
    assert_eq!(age(&scene, 0, Moment::tick(300)).unwrap().life.generation, 1);
    assert_eq!(age(&pricked(&[100, 280]), 0, Moment::tick(600)).unwrap().life.generation, 2);
}

#[test]
fn in_slow_motion_it_takes_longer() {
    let mut scene = pricked(&[100]);
    scene.motion.burst_slowdown = 100.0;
    let hole = age(&scene, 0, Moment::tick(160)).unwrap().hole.unwrap();
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
        let film = Film { state: FilmStateName::Rest, thickness_nm: 1000.0, stratification: 0.05, ..Film::default() };
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

/// Lives are found once, and in whatever order moments are asked for.
#[test]
fn a_story_has_the_same_lives_in_any_order() {
    let scene = dry(3.0);
    let story = Story::new(scene.clone());
    let seen = |age: Option<Age>| age.map(|age| (age.life.born, age.life.generation, age.moment, age.hole));
    for tick in [40_000, 100, 7, 39_999, 20_000, 40_001] {
        assert_eq!(seen(story.age(0, Moment::tick(tick))), seen(age(&scene, 0, Moment::tick(tick))), "{tick}");
    }
    assert!(seen(story.age(0, Moment::tick(40_000))) != seen(story.age(0, Moment::tick(0))));
}
