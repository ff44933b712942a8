//! What is skipped and what is not, and that skipping never changes what is there in the end.

mod camera;
mod checkpoints;
mod crowd;
mod events;
mod films;
mod light;
mod lives;
mod parts;
mod story;

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::{
    physics::{
        colour::{Gamut, Illuminant},
        environment::CubeMap,
        film::Cap,
    },
    scene::{
        Backdrop, Blow, Boundary, Bubble, Change, Detail, Drag, Event, Film, FilmIndexName, FilmStateName, Flow,
        MotionChange, Quality, Scene, Stir, View, preset,
    },
};

fn resources() -> Resources {
    Resources {
        environment: Arc::new(CubeMap::constant(DVec3::ONE)),
        illuminant: Arc::new(Illuminant::default()),
        spectral_lights: Vec::new(),
        liquids: BTreeMap::new(),
        plate: None,
    }
}

fn shot(tick: u64, pace: Pace) -> Shot {
    Shot { size: [64, 36], moment: Moment::tick(tick), full_precision: false, gamut: Gamut::Srgb, pace }
}

fn frame_request(scene: &Scene, tick: u64, pace: Pace) -> FrameRequest {
    request(scene, &resources(), &shot(tick, pace)).unwrap()
}

fn names(plan: &Plan) -> Vec<&'static str> {
    plan.steps.iter().map(|(pass, _)| pass.name()).collect()
}

/// What is there after a whole picture of a scene.
fn after(scene: &Scene, tick: u64) -> GpuState {
    plan(&frame_request(scene, tick, Pace::Whole), &GpuState::default()).after
}

/// Names of the passes from one picture to another.
fn between(from: (&Scene, u64), to: (&Scene, u64)) -> Vec<&'static str> {
    names(&plan(&frame_request(to.0, to.1, Pace::Whole), &after(from.0, from.1)))
}

fn stirred_scene() -> Scene {
    preset("stirred").unwrap()
}

fn uniform_scene() -> Scene {
    let mut scene = stirred_scene();
    scene.bubbles[0].film.state = FilmStateName::Uniform;
    scene
}

fn event(tick: u64, flow: Flow) -> Event {
    Event { tick, change: Change::Motion(MotionChange { flow: Some(flow), ..MotionChange::default() }) }
}

#[test]
fn the_first_picture_makes_everything_once() {
    let first = names(&plan(&frame_request(&stirred_scene(), 30, Pace::Whole), &GpuState::default()));
    let mut order = first.clone();
    order.dedup();
    let expected = [
        "bake_table",
        "fit_quadrature",
        "upload_environment",
        "seed_field",
        "step_field",
        "show_field",
        "draw",
        "tonemap",
    ];
    assert_eq!(order, expected);
}

#[test]
fn the_same_scene_again_costs_nothing() {
    assert_eq!(between((&stirred_scene(), 5), (&stirred_scene(), 5)), [] as [&str; 0]);
}

/// The fast quality needs no wavelengths where light is white, or nearly so, and films reflect little.
#[test]
fn colours_are_multiplied_only_where_that_is_good_enough() {
    let multiplies = |change: &dyn Fn(&mut Scene)| {
        let mut scene = Scene { view: View { quality: Quality::Fast, ..View::default() }, ..Scene::default() };
        change(&mut scene);
        let quadrature = &frame_request(&scene, 0, Pace::Whole).picture.draw.lighting.films[0].quadrature;
        assert_eq!(quadrature.from_table, quadrature.count() == 0);
        quadrature.from_table
    };
    assert!(multiplies(&|_| ()), "a backdrop that is almost black counts as grey");
    assert!(!multiplies(&|scene| scene.view.quality = Quality::Standard));
    assert!(!multiplies(&|scene| scene.view.polariser_deg = Some(0.0)));
    assert!(!multiplies(&|scene| scene.view.backdrop = Backdrop::Radiance([0.2, 0.1, 0.1])));
    assert!(!multiplies(&|scene| scene.light.constant = Some([1.0, 0.5, 0.2])));
    assert!(!multiplies(&|scene| scene.bubbles[0].film.index = FilmIndexName::Constant(1.6)));
    assert!(!multiplies(&|scene| scene.bubbles[0].film.thickness_nm = 2500.0));
}

#[test]
fn half_floats_are_exposed_in_wide_steps() {
    let exposed = |exposure_ev: f64| {
        let mut scene = uniform_scene();
        scene.view.exposure_ev = exposure_ev;
        let draw = frame_request(&scene, 0, Pace::Whole).picture.draw;
        assert!((f64::from(draw.exposed_ev) - exposure_ev).abs() <= 4.0);
        draw
    };
    assert_eq!(exposed(1.5).exposed_ev, 0);
    assert_eq!(exposed(3.9), exposed(-3.9), "small changes draw nothing anew");
    assert_ne!(exposed(-20.0), exposed(0.0));
}

#[test]
fn exposure_costs_a_tonemap() {
    let mut brighter = stirred_scene();
    brighter.view.exposure_ev = 1.0;
    assert_eq!(between((&stirred_scene(), 5), (&brighter, 5)), ["tonemap"]);
}

#[test]
fn a_camera_move_draws_and_neither_bakes_nor_steps() {
    let mut moved = stirred_scene();
    moved.camera.azimuth_deg += 10.0;
    assert_eq!(between((&stirred_scene(), 5), (&moved, 5)), ["draw", "tonemap"]);
}

#[test]
fn a_uniform_film_has_no_field() {
    let passes = names(&plan(&frame_request(&uniform_scene(), 100, Pace::Whole), &GpuState::default()));
    assert!(passes.iter().all(|name| !name.ends_with("field")), "{passes:?}");
    assert_eq!(between((&uniform_scene(), 0), (&uniform_scene(), 9999)), [] as [&str; 0]);
}

#[test]
fn a_film_at_rest_is_never_stepped() {
    let mut scene = stirred_scene();
    scene.motion.flow = Flow::Rest;
    for tick in [0, 1, 1_000_000] {
        let passes = names(&plan(&frame_request(&scene, tick, Pace::Whole), &GpuState::default()));
        assert!(!passes.contains(&"step_field"), "tick {tick}: {passes:?}");
    }
    assert_eq!(between((&scene, 7), (&scene, 70_000)), [] as [&str; 0]);
}

#[test]
fn films_that_end_nowhere_know_of_no_end() {
    let field = |scene: &Scene| match frame_request(scene, 4, Pace::Whole).picture.draw.bubbles[0].film.clone() {
        FilmKey::Field(field) => field,
        FilmKey::Uniform(_) => panic!("a film that flows"),
    };
    let free = preset("tent").unwrap();
    assert_eq!(field(&free).boundary, None);
    assert!(!frame_request(&free, 4, Pace::Whole).picture.draw.on_bath);
    let bath = preset("bath").unwrap();
    let draw = frame_request(&bath, 4, Pace::Whole).picture.draw;
    assert!(draw.on_bath && draw.bubbles[0].cap == Some(Cap::HEMISPHERE) && field(&bath).regeneration().is_some());
    let mut drained = bath.clone();
    drained.bubbles[0].regeneration = 0.0;
    assert_eq!(field(&drained).regeneration(), None);
    let drop = field(&preset("drop").unwrap());
    assert!(drop.cap().is_none() && drop.boundary.unwrap().drop_rad.unwrap() < 0.3);
}

#[test]
fn nothing_is_seen_from_below_a_bath() {
    let mut scene = preset("bath").unwrap();
    scene.camera.elevation_deg = -30.0;
    let error = request(&scene, &resources(), &shot(0, Pace::Whole)).unwrap_err();
    assert!(error.to_string().starts_with("`elevation_deg` in [camera] looks from below the bath"), "{error}");
}

#[test]
fn a_bubble_out_of_sight_costs_nothing() {
    let mut scene = stirred_scene();
    scene.bubbles.push(Bubble { center_m: [0.0, 5.0, 0.0], ..Bubble::default() });
    let behind = Bubble { center_m: [5.0, 0.0, 0.0], ..Bubble::default() };
    scene.bubbles.push(behind);
    let request = frame_request(&scene, 4, Pace::Whole);
    assert_eq!(request.picture.draw.bubbles.iter().map(|bubble| bubble.index).collect::<Vec<_>>(), [0]);
    assert_eq!(
        names(&plan(&request, &GpuState::default())),
        names(&plan(&frame_request(&stirred_scene(), 4, Pace::Whole), &GpuState::default()))
    );
}

#[test]
fn a_bubble_below_a_pixel_is_not_simulated() {
    let mut scene = stirred_scene();
    scene.camera.distance_m = 500.0;
    let passes = names(&plan(&frame_request(&scene, 4, Pace::Whole), &GpuState::default()));
    assert!(!passes.contains(&"seed_field"), "{passes:?}");
}

#[test]
fn a_window_gets_a_coarse_table_first_and_the_full_one_soon() {
    let request = frame_request(&uniform_scene(), 0, Pace::UNMEASURED);
    let full = request.picture.draw.lighting.films[0].table.clone().unwrap();
    let mut state = GpuState::default();
    let first = plan(&request, &state);
    let coarse = first.after.lights[0].films[0].table.clone().unwrap();
    assert!(coarse.rows < full.rows && coarse.max_thickness_nm == full.max_thickness_nm && !first.complete);
    assert!(names(&first).ends_with(&["draw", "tonemap"]), "something is shown at once");
    for frame in 0..100 {
        let plan = plan(&request, &state);
        state = plan.after;
        if plan.complete {
            assert_eq!(state.lights[0].films[0].table.as_ref(), Some(&full));
            assert!(frame > 1, "the full table is baked in portions");
            return;
        }
    }
    panic!("the full table never came");
}

#[test]
fn a_window_catches_up_with_a_film_in_portions() {
    let request = frame_request(&stirred_scene(), 160, Pace::UNMEASURED);
    let (mut state, mut frames) = (GpuState::default(), 0);
    loop {
        let next = plan(&request, &state);
        frames += 1;
        state = next.after;
        if next.complete {
            break;
        }
        assert!(frames < 1000, "it never catches up");
    }
    assert!(frames > 3 && state.fields[0].as_ref().unwrap().key.moment == Moment::tick(156));
}

#[test]
fn the_plan_says_what_and_why() {
    let text = plan(&frame_request(&stirred_scene(), 30, Pace::Whole), &GpuState::default()).to_string();
    for part in ["bake_table", "film 0, ticks 0..24", "nothing there yet"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert_eq!(
        plan(&frame_request(&stirred_scene(), 2, Pace::Whole), &after(&stirred_scene(), 2)).to_string(),
        "nothing to do\n"
    );
}

/// Scenes that differ in everything that a plan looks at.
fn scenes() -> impl Strategy<Value = Scene> {
    let state = prop_oneof![Just(FilmStateName::Uniform), Just(FilmStateName::Rest), Just(FilmStateName::Blown)];
    let flow = || prop_oneof![Just(Flow::Rest), Just(Flow::Draught), Just(Flow::Stirred), Just(Flow::Free)];
    let change = prop_oneof![
        flow().prop_map(|flow| event(0, flow).change),
        (1..9_u64).prop_map(|ticks| Change::Stir(Stir { ticks, ..Stir::default() })),
        (-0.01..0.01).prop_map(|x| Change::Drag(Drag { to_m: [x, 0.0, 0.0], ..Drag::default() })),
    ];
    let events = proptest::collection::vec((0..60_u64, change).prop_map(|(tick, change)| Event { tick, change }), 0..3);
    let thickness_nm = prop_oneof![Just(300.0), Just(900.0), Just(2500.0)];
    let azimuth_deg = prop_oneof![Just(0.0), Just(90.0)];
    let exposure_ev = prop_oneof![Just(0.0), Just(1.0)];
    (state, flow(), events, thickness_nm, azimuth_deg, exposure_ev, 1..3_usize).prop_map(
        |(state, flow, mut events, thickness_nm, azimuth_deg, exposure_ev, bubbles)| {
            let mut scene = stirred_scene();
            let film = &mut scene.bubbles[0].film;
            (film.state, film.thickness_nm, film.cells) = (state, thickness_nm, 16);
            let other = Bubble { center_m: [0.0, 0.08, 0.0], radius_mm: 10.0, ..scene.bubbles[0].clone() };
            scene.bubbles.resize(bubbles, other);
            scene.motion.flow = flow;
            events.sort_by_key(|event| event.tick);
            (scene.events, scene.camera.azimuth_deg, scene.view.exposure_ev) = (events, azimuth_deg, exposure_ev);
            scene
        },
    )
}

/// What of a state a whole picture decides. Products that this picture does not need may linger from others, and a table in the making
/// may be left where it was; checkpoints are where the way led.
fn decided(
    state: &GpuState,
    request: &FrameRequest,
) -> (Option<TonemapKey>, Vec<Option<TableKey>>, Vec<Option<FieldState>>) {
    let needed = |index: usize| {
        request
            .picture
            .draw
            .bubbles
            .iter()
            .any(|bubble| bubble.index == index && matches!(bubble.film, FilmKey::Field(_)))
    };
    let field = |(index, field): (usize, &Option<FieldState>)| {
        let field = field.clone().filter(|_| needed(index))?;
        Some(FieldState { checkpoints: Checkpoints::default(), ..field })
    };
    let mut fields: Vec<_> = state.fields.iter().enumerate().map(field).collect();
    while fields.last().is_some_and(Option::is_none) {
        fields.pop();
    }
    let films = state.lights.iter().flat_map(|light| &light.films);
    let tables = films.map(|film| film.table.clone()).collect();
    (state.picture.clone(), tables, fields)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_way_there_does_not_matter(way in proptest::collection::vec((scenes(), 0..80_u64, any::<bool>()), 1..6), end in scenes(), tick in 0..80_u64) {
        let mut state = GpuState::default();
        for (scene, tick, whole) in way {
            state = plan(&frame_request(&scene, tick, if whole { Pace::Whole } else { Pace::UNMEASURED }), &state).after;
        }
        let request = frame_request(&end, tick, Pace::Whole);
        let arrived = plan(&request, &state);
        let fresh = plan(&request, &GpuState::default());
        prop_assert!(arrived.complete && fresh.complete);
        prop_assert_eq!(decided(&arrived.after, &request), decided(&fresh.after, &request));
        prop_assert_eq!(arrived.after.picture.as_ref(), Some(&request.picture));
        prop_assert!(plan(&request, &arrived.after).is_empty());
        let frame_paced = FrameRequest { pace: Pace::UNMEASURED, ..request };
        prop_assert!(plan(&frame_paced, &arrived.after).is_empty());
    }

    #[test]
    fn frames_end_where_one_go_does(scene in scenes(), tick in 0..80_u64) {
        let (request, mut state) = (frame_request(&scene, tick, Pace::UNMEASURED), GpuState::default());
        for _ in 0..200 {
            let next = plan(&request, &state);
            state = next.after;
            if next.complete {
                break;
            }
        }
        let whole = plan(&FrameRequest { pace: Pace::Whole, ..request.clone() }, &GpuState::default());
        prop_assert_eq!(decided(&state, &request), decided(&whole.after, &request));
    }
}
