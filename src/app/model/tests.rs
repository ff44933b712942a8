use super::*;
use crate::{
    app::{edit::new_seed, group::Group},
    input::load_scene,
    plan::film_grids,
    scene::{Change, Event, FilmIndexName, Flow, Scene},
};

/// The preset without an environment to compute.
pub fn model() -> Model {
    let mut model = Model::new(load_scene("furnace").unwrap());
    // Time begins with the first picture.
    model.pictured = Some(model.opened);
    model
}

#[test]
fn a_change_while_the_clock_runs_becomes_an_event() {
    let mut model = model();
    model.clock.tick = 120;
    let change = MotionChange { flow: Some(Flow::Stirred), ..MotionChange::default() };
    model.edit(Edit::Motion(Motion { flow: Flow::Stirred, ..model.motion() }.into()));
    assert_eq!(model.motion().flow, Flow::Stirred);
    assert_eq!(model.scene.events, [Event { tick: 120, change: Change::Motion(change) }]);
}

#[test]
fn another_film_starts_again_and_another_index_does_not() {
    let mut model = Model::new(load_scene("trio").unwrap());
    model.clock.tick = 50;
    let mut bubble = model.scene.bubbles[2].clone();
    bubble.film.index = FilmIndexName::Constant(1.5);
    model.select_one(2);
    model.edit_selected(bubble.clone(), &Group::default());
    assert_eq!(model.clock.tick, 50, "the index shapes no film");
    let denser = model.scene.bubbles.iter().map(|bubble| bubble.film.index == FilmIndexName::Constant(1.5));
    assert_eq!(denser.collect::<Vec<_>>(), [false, false, true]);
    bubble.film.thickness_nm = 300.0;
    model.edit_selected(bubble, &Group::default());
    assert_eq!((model.clock.tick, model.scene.bubbles[2].film.thickness_nm), (0, 300.0));
}

#[test]
fn an_edit_that_no_scene_bears_leaves_the_scene_and_says_why() {
    let mut model = model();
    let before = Scene::clone(&model.scene);
    assert!(!model.edit(Edit::Motion(Motion { strength: 11.0, ..model.motion() }.into())));
    assert_eq!(*model.scene, before);
    assert!(model.messages.at(0.0).iter().any(|message| message.text.contains("`strength`")));
}

#[test]
fn a_film_stays_as_fine_as_it_was_while_the_camera_moves() {
    let mut far = load_scene("tent").unwrap();
    far.scene.camera.distance_m = 20.0;
    let grids = |model: &Model| film_grids(&model.scene, 0);
    let mut model = Model::new(load_scene("tent").unwrap());
    assert_eq!(grids(&model), [256, 64]);
    model.scene.change(|scene| scene.camera.distance_m = 20.0);
    assert_eq!(grids(&model), [256, 64], "gone away from");
    model.adopt(far);
    assert_eq!(grids(&model), [128, 32]);
    model.scene.change(|scene| scene.camera.distance_m = 0.24);
    assert_eq!(grids(&model), [128, 32], "come near to");
    let saved = Scene::from_toml(&model.scene.to_toml(), "saved").unwrap();
    assert_eq!(film_grids(&saved, 0), [128, 32], "and read back");
}

#[test]
fn seeds_are_new() {
    let seeds: std::collections::BTreeSet<_> = (0..20).map(|_| new_seed()).collect();
    // Twenty draws of 100000: two pairs of equal ones happen once in a million runs.
    assert!(seeds.len() >= 19, "{seeds:?}");
}
