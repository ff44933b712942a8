//! Bubbles that generators make.

use super::*;
use crate::scene::{Camera, Generator, Layout};

/// A hundred bubbles of all sizes before the eye.
fn cloud() -> Scene {
    let film = Film { cells: 32, ..Film::default() };
    let generator = Generator { count: 100, films: 3, size_m: [1.0, 0.6, 0.4], film, ..Generator::default() };
    Scene {
        bubbles: Vec::new(),
        generators: vec![generator],
        camera: Camera { distance_m: 1.0, azimuth_deg: 0.0, elevation_deg: 0.0, ..Camera::default() },
        ..Scene::default()
    }
}

fn draw_key(scene: &Scene, tick: u64) -> DrawKey {
    let shot = Shot { size: [1280, 720], ..shot(tick, Pace::Whole) };
    request(scene, &resources(), &shot).unwrap().picture.draw
}

#[test]
fn small_ones_are_apart_from_large_ones_and_both_lie_farthest_first() {
    let key = draw_key(&cloud(), 0);
    assert!(!key.bubbles.is_empty() && key.small.len() > 20, "{} {}", key.bubbles.len(), key.small.len());
    let eye_m = key.camera.eye_m;
    let power = |center_m: DVec3, radius_m: f64| center_m.distance_squared(eye_m) - radius_m.powi(2);
    assert!(key.small.iter().map(|small| power(small.center_m, small.radius_m)).is_sorted_by(|a, b| a >= b));
    assert!(key.bubbles.iter().map(|bubble| power(bubble.center_m, bubble.radius_m)).is_sorted_by(|a, b| a >= b));
    assert!(key.small.iter().all(|small| small.radius_pixels(&key.camera) < 40.0));
    assert!(key.bubbles.iter().all(|bubble| bubble.radius_m / bubble.center_m.distance(eye_m) > 0.02));
    let films: BTreeSet<usize> = key.lent.iter().map(|lent| lent.index).collect();
    assert_eq!(films, BTreeSet::from([0, 1, 2]));
    assert!(key.bubbles.iter().all(|bubble| films.contains(&bubble.index)));
}

#[test]
fn films_are_shared_and_move_once_for_all() {
    let plan = plan(&frame_request(&cloud(), 2, Pace::Whole), &GpuState::default());
    let count = |name: &str| names(&plan).into_iter().filter(|step| *step == name).count();
    assert_eq!((count("seed_field"), count("step_field"), count("show_field"), count("draw")), (3, 3, 3, 1));
    let again = super::plan(&frame_request(&cloud(), 2, Pace::Whole), &plan.after);
    assert!(again.is_empty(), "{again}");
}

#[test]
fn what_is_out_of_sight_costs_nothing() {
    let mut scene = cloud();
    // From beside the cloud, the other way.
    (scene.camera.target_m, scene.camera.azimuth_deg) = ([5.0, 0.0, 0.0], 180.0);
    let key = draw_key(&scene, 0);
    assert!(key.bubbles.is_empty() && key.small.is_empty() && key.lent.is_empty());
    assert!(!names(&plan(&frame_request(&scene, 2, Pace::Whole), &GpuState::default())).contains(&"step_field"));
    // Bubbles that go on in still film: nothing but pictures.
    let mut still = cloud();
    (still.generators[0].film.state, still.generators[0].wind_m_s) = (FilmStateName::Uniform, [0.0, 0.1, 0.0]);
    assert_eq!(between((&still, 0), (&still, 5)), ["draw", "tonemap"]);
    still.generators[0].wind_m_s = [0.0; 3];
    assert_eq!(between((&still, 0), (&still, 5)), [""; 0]);
}

#[test]
fn a_table_does_not_change_with_the_bubbles_in_sight() {
    let mut scene = cloud();
    scene.generators[0].wind_m_s = [0.0, 0.5, 0.0];
    let tables: Vec<_> = [0, 20, 40].map(|tick| draw_key(&scene, tick).lighting.films[0].table.clone()).into();
    assert!(tables[0].is_some() && tables.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn films_of_a_stream_are_blown_anew_in_turn() {
    let mut scene = cloud();
    let generator = &mut scene.generators[0];
    (generator.layout, generator.life_s, generator.count) = (Layout::Wand, 1.0, 20);
    let story = Story::new(scene);
    // 1.4 s for the longest life, over two films that others are lent meanwhile.
    let interval = 42;
    let born = |film: usize, tick: u64| story.age(film, Moment::tick(tick)).unwrap().life.born;
    assert_eq!([0, 1, 2].map(|film| born(film, 0)), [0, 0, 0]);
    assert_eq!([0, 1, 2].map(|film| born(film, 3 * interval - 1)), [0, interval, 2 * interval]);
    assert_eq!([0, 1, 2].map(|film| born(film, 3 * interval)), [3 * interval, interval, 2 * interval]);
    let seeds: BTreeSet<String> = [0, 1, 3 * interval]
        .map(|tick| {
            format!(
                "{:?}",
                story.film_key(0, Moment::tick(tick)).map(|key| match key {
                    FilmKey::Field(field) => field.initial,
                    FilmKey::Uniform(_) => panic!("it moves"),
                })
            )
        })
        .into();
    assert_eq!(seeds.len(), 2, "another film each time: {seeds:?}");
}

#[test]
fn events_befall_bubbles_of_the_scene_alone() {
    let mut scene = cloud();
    let quiet = draw_key(&scene, 5).lent;
    scene.bubbles.push(Bubble { center_m: [0.0, 0.0, 5.0], ..Bubble::default() });
    scene.events.push(Event { tick: 1, change: Change::Stir(Stir::default()) });
    let stirred = draw_key(&scene, 5).lent;
    assert_eq!(stirred.iter().map(|lent| lent.index).collect::<BTreeSet<_>>(), BTreeSet::from([1, 2, 3]));
    assert!(quiet.iter().zip(&stirred).all(|(a, b)| a.film == b.film));
}
