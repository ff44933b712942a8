//! What is skipped and what is not, and that skipping never changes what is there in the end.

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
    scene::{Blow, Bubble, Change, Drag, Event, FilmStateName, Flow, MotionChange, Scene, Stir, preset},
};

fn resources() -> Resources {
    Resources {
        environment: Arc::new(CubeMap::constant(DVec3::ONE)),
        illuminant: Arc::new(Illuminant::default()),
        lamps: Vec::new(),
        liquids: BTreeMap::new(),
    }
}

fn shot(tick: u64, pace: Pace) -> Shot {
    Shot {
        size: [64, 36],
        moment: Moment::tick(tick),
        full_precision: false,
        gamut: Gamut::Srgb,
        yardstick: false,
        pace,
    }
}

fn wanted(scene: &Scene, tick: u64, pace: Pace) -> Want {
    want(scene, &resources(), &shot(tick, pace)).unwrap()
}

fn names(plan: &Plan) -> Vec<&'static str> {
    plan.steps.iter().map(|(pass, _)| pass.name()).collect()
}

/// What is there after a whole picture of a scene.
fn after(scene: &Scene, tick: u64) -> Have {
    plan(&wanted(scene, tick, Pace::Whole), &Have::default()).after
}

/// Names of the passes from one picture to another.
fn between(from: (&Scene, u64), to: (&Scene, u64)) -> Vec<&'static str> {
    names(&plan(&wanted(to.0, to.1, Pace::Whole), &after(from.0, from.1)))
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
fn each_light_has_what_it_needs_and_loses_nothing_to_another() {
    let lamp = |illuminant: &str| Lamp {
        environment: Arc::new(CubeMap::constant(DVec3::ONE)),
        illuminant: Arc::new(illuminant.parse().unwrap()),
    };
    let lit =
        |lamps: Vec<Lamp>| want(&uniform_scene(), &Resources { lamps, ..resources() }, &shot(0, Pace::Whole)).unwrap();
    let alone = plan(&lit(vec![]), &Have::default());
    let both = plan(&lit(vec![lamp("A")]), &alone.after);
    assert_eq!(both.after.lights.len(), 2);
    let mut passes = names(&both);
    passes.dedup();
    assert_eq!(passes, ["bake_table", "fit_bands", "upload_environment", "draw", "tonemap"]);
    assert!(plan(&lit(vec![lamp("A")]), &both.after).is_empty());
    assert_eq!(names(&plan(&lit(vec![]), &both.after)), ["draw", "tonemap"]);
}

#[test]
fn the_first_picture_makes_everything_once() {
    let first = names(&plan(&wanted(&stirred_scene(), 30, Pace::Whole), &Have::default()));
    let mut order = first.clone();
    order.dedup();
    let expected =
        ["bake_table", "fit_bands", "upload_environment", "seed_field", "step_field", "show_field", "draw", "tonemap"];
    assert_eq!(order, expected);
}

#[test]
fn the_same_scene_again_costs_nothing() {
    assert_eq!(between((&stirred_scene(), 5), (&stirred_scene(), 5)), [] as [&str; 0]);
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
    let passes = names(&plan(&wanted(&uniform_scene(), 100, Pace::Whole), &Have::default()));
    assert!(passes.iter().all(|name| !name.ends_with("field")), "{passes:?}");
    assert_eq!(between((&uniform_scene(), 0), (&uniform_scene(), 9999)), [] as [&str; 0]);
}

#[test]
fn a_film_at_rest_is_never_stepped() {
    let mut scene = stirred_scene();
    scene.motion.flow = Flow::Rest;
    for tick in [0, 1, 1_000_000] {
        let passes = names(&plan(&wanted(&scene, tick, Pace::Whole), &Have::default()));
        assert!(!passes.contains(&"step_field"), "tick {tick}: {passes:?}");
    }
    assert_eq!(between((&scene, 7), (&scene, 70_000)), [] as [&str; 0]);
}

#[test]
fn films_that_end_nowhere_know_of_no_end() {
    let field = |scene: &Scene| match wanted(scene, 4, Pace::Whole).picture.draw.bubbles[0].film.clone() {
        FilmKey::Field(field) => field,
        FilmKey::Uniform(_) => panic!("a film that flows"),
    };
    let free = preset("default").unwrap();
    assert_eq!(field(&free).end, None);
    assert!(!wanted(&free, 4, Pace::Whole).picture.draw.on_bath);
    let bath = preset("bath").unwrap();
    let draw = wanted(&bath, 4, Pace::Whole).picture.draw;
    assert!(draw.on_bath && draw.bubbles[0].cap == Some(Cap::HEMISPHERE) && field(&bath).regeneration().is_some());
    let mut drained = bath.clone();
    drained.bubbles[0].regeneration = 0.0;
    assert_eq!(field(&drained).regeneration(), None);
    let drop = field(&preset("drop").unwrap());
    assert!(drop.cap().is_none() && drop.end.unwrap().drop_rad.unwrap() < 0.3);
}

#[test]
fn nothing_is_seen_from_below_a_bath() {
    let mut scene = preset("bath").unwrap();
    scene.camera.elevation_deg = -30.0;
    let error = want(&scene, &resources(), &shot(0, Pace::Whole)).unwrap_err();
    assert_eq!(error, WantError::BelowBath);
    assert!(error.to_string().contains("raise `elevation_deg`"));
}

#[test]
fn a_bubble_out_of_sight_costs_nothing() {
    let mut scene = stirred_scene();
    scene.bubbles.push(Bubble { center_m: [0.0, 5.0, 0.0], ..Bubble::default() });
    let behind = Bubble { center_m: [5.0, 0.0, 0.0], ..Bubble::default() };
    scene.bubbles.push(behind);
    let want = wanted(&scene, 4, Pace::Whole);
    assert_eq!(want.picture.draw.bubbles.iter().map(|bubble| bubble.index).collect::<Vec<_>>(), [0]);
    assert_eq!(
        names(&plan(&want, &Have::default())),
        names(&plan(&wanted(&stirred_scene(), 4, Pace::Whole), &Have::default()))
    );
}

#[test]
fn a_bubble_below_a_pixel_is_not_simulated() {
    let mut scene = stirred_scene();
    scene.camera.distance_m = 500.0;
    let passes = names(&plan(&wanted(&scene, 4, Pace::Whole), &Have::default()));
    assert!(!passes.contains(&"seed_field"), "{passes:?}");
}

#[test]
fn a_window_gets_a_coarse_table_first_and_the_full_one_soon() {
    let want = wanted(&uniform_scene(), 0, Pace::Frame);
    let full = want.picture.draw.lighting.table.clone().unwrap();
    let mut have = Have::default();
    let first = plan(&want, &have);
    let coarse = first.after.lights[0].table.clone().unwrap();
    assert!(coarse.rows < full.rows && coarse.max_thickness_nm == full.max_thickness_nm && !first.complete);
    assert!(names(&first).ends_with(&["draw", "tonemap"]), "something is shown at once");
    for frame in 0..100 {
        let plan = plan(&want, &have);
        have = plan.after;
        if plan.complete {
            assert_eq!(have.lights[0].table.as_ref(), Some(&full));
            assert!(frame > 1, "the full table is baked in portions");
            return;
        }
    }
    panic!("the full table never came");
}

#[test]
fn a_window_catches_up_with_a_film_in_portions() {
    let want = wanted(&stirred_scene(), 160, Pace::Frame);
    let (mut have, mut frames) = (Have::default(), 0);
    loop {
        let next = plan(&want, &have);
        frames += 1;
        have = next.after;
        if next.complete {
            break;
        }
        assert!(frames < 1000, "it never catches up");
    }
    assert!(frames > 3 && have.fields[0].as_ref().unwrap().state.moment == Moment::tick(156));
}

#[test]
fn another_past_seeds_anew_and_another_future_does_not() {
    let mut sloshing_at_3 = stirred_scene();
    sloshing_at_3.events.push(event(3, Flow::Sloshing));
    let mut sloshing_at_30 = stirred_scene();
    sloshing_at_30.events.push(event(30, Flow::Sloshing));
    assert!(between((&stirred_scene(), 20), (&sloshing_at_3, 20)).contains(&"seed_field"));
    assert_eq!(between((&stirred_scene(), 20), (&sloshing_at_30, 20)), [] as [&str; 0]);
    assert_eq!(between((&stirred_scene(), 20), (&sloshing_at_30, 40)), ["step_field", "show_field", "draw", "tonemap"]);
}

/// A free film, cheap to plan, and an event that pushes it.
fn pushed_at(tick: u64, change: Change) -> Scene {
    let mut scene = stirred_scene();
    scene.motion.flow = Flow::Free;
    Scene { events: vec![Event { tick, change }], ..scene }
}

#[test]
fn a_push_is_felt_from_its_first_tick_by_its_film_alone() {
    let free = Scene { events: Vec::new(), ..pushed_at(0, Change::Stir(Stir::default())) };
    for change in [Change::Stir(Stir::default()), Change::Blow(Blow::default())] {
        let pushed = pushed_at(20, change.clone());
        assert_eq!(between((&free, 20), (&pushed, 20)), [] as [&str; 0], "what comes later leaves a key alone");
        assert_eq!(between((&free, 20), (&pushed, 24)), ["step_field", "show_field", "draw", "tonemap"]);
        assert!(between((&free, 24), (&pushed, 24)).contains(&"seed_field"), "another past is another film");
        let rest = |scene: &Scene| {
            let mut scene = scene.clone();
            scene.motion.flow = Flow::Rest;
            scene
        };
        let felt = between((&rest(&free), 24), (&rest(&pushed), 24));
        let is_jet = matches!(change, Change::Blow(_));
        assert_eq!(felt, if is_jet { &["draw", "tonemap"][..] } else { &[] }, "a jet dents the bubble, its film rests");
    }
}

#[test]
fn a_dragged_bubble_is_seen_where_it_is_and_its_film_feels_it() {
    let drag = |to_m| pushed_at(20, Change::Drag(Drag { bubble: 0, to_m }));
    let bubble = |scene: &Scene, tick| wanted(scene, tick, Pace::Whole).picture.draw.bubbles[0].clone();
    let (scene, start) = (drag([0.0, 0.01, 0.0]), DVec3::ZERO);
    assert_eq!(bubble(&scene, 20).centre_m, start);
    assert!((1e-4..0.01).contains(&bubble(&scene, 24).centre_m.y));
    assert!(bubble(&scene, 200).centre_m.distance(DVec3::new(0.0, 0.01, 0.0)) < 1e-9);
    let FilmKey::Field(film) = bubble(&scene, 24).film else { panic!("the film has a field") };
    // At first the whole way over the square of the time constant, 0.1 s, in radii.
    let radius_m = scene.bubbles[0].radius_mm * 1e-3;
    let first = film.acceleration_during(20.0, 20.0 + 1e-6);
    assert!((first.y * radius_m - 1.0).abs() < 1e-3 && first.x == 0.0, "{first}");
    assert_eq!(film.acceleration_during(10.0, 20.0), DVec3::ZERO);
    assert!(between((&drag([0.0; 3]), 30), (&scene, 30)).contains(&"seed_field"));
}

/// The ticks of the steps that lead to a film's state.
fn steps(scene: &Scene, tick: u64) -> Vec<Range<u64>> {
    match &wanted(scene, tick, Pace::Whole).picture.draw.bubbles[0].film {
        FilmKey::Field(film) => film.steps_from(0).collect(),
        FilmKey::Uniform(_) => panic!("the film has a field"),
    }
}

#[test]
fn a_step_lasts_as_long_as_it_stays_accurate_and_ends_where_a_law_does() {
    let mut scene = stirred_scene();
    assert_eq!(steps(&scene, 30), [0..12, 12..24], "0.2 s at half strength, and the rest is shown ahead of the state");
    scene.events.push(event(15, Flow::Sloshing));
    assert_eq!(steps(&scene, 30), [0..12, 12..15, 15..27]);
    scene.motion.strength = 2.0;
    assert_eq!(steps(&scene, 7), [0..3, 3..6]);
}

#[test]
fn a_free_film_is_stepped_as_its_waves_need() {
    let mut scene = preset("default").unwrap();
    assert_eq!(steps(&scene, 3), [0..1, 1..2, 2..3], "waves of 5 cm turn by a quarter of a radian in 18 ms");
    scene.motion.gravity_m_s2 = [0.0; 3];
    assert_eq!(steps(&scene, 5), [0..2, 2..4], "without gravity steps of a thirtieth of a second do");
    let film = |scene: &Scene| match &wanted(scene, 90, Pace::Whole).picture.draw.bubbles[0].film {
        FilmKey::Field(film) => film.clone(),
        FilmKey::Uniform(_) => panic!("the film has a field"),
    };
    scene.motion.evaporation_nm_s = 30.0;
    let faster = MotionChange { evaporation_nm_s: Some(60.0), ..MotionChange::default() };
    scene.events.push(Event { tick: 60, change: Change::Motion(faster) });
    let thinned = film(&scene).thinned_nm(90.0);
    assert!((thinned - 60.0).abs() < 1e-9, "30 nm in the first second and 30 in the next half: {thinned}");
    scene.motion.flow = Flow::Stirred;
    assert_eq!(film(&scene).thinned_nm(90.0), 0.0, "how thick it is changes nothing in how others move");
}

#[test]
fn a_film_that_was_found_at_rest_plans_nothing_until_something_acts_on_it() {
    let mut scene = preset("default").unwrap();
    scene.motion.strength = 0.0;
    let FilmKey::Field(film) = &wanted(&scene, 240, Pace::Whole).picture.draw.bubbles[0].film else { unreachable!() };
    let FlowLaw::Free(law) = film.law(0) else { unreachable!("a free film") };
    let resting = |tick| {
        let mut have = after(&scene, tick);
        have.fields[0].as_mut().unwrap().rest = Some(RestingFilm { since_tick: 240, law });
        have
    };
    let then = |scene: &Scene, have: &Have, tick| plan(&wanted(scene, tick, Pace::Frame), have);
    let shown = then(&scene, &resting(240), 7000);
    assert!(shown.is_empty(), "{shown}");
    let event = |change| Scene { events: vec![Event { tick: 400, change }], ..scene.clone() };
    let tilt = MotionChange { gravity_m_s2: Some([1.0, 0.0, -9.0]), ..MotionChange::default() };
    let draught = MotionChange { strength: Some(1.0), ..MotionChange::default() };
    for change in [Change::Stir(Stir::default()), Change::Motion(tilt), Change::Motion(draught)] {
        let disturbed = event(change);
        assert!(then(&disturbed, &resting(240), 399).is_empty(), "not yet");
        let passes = then(&disturbed, &resting(240), 404);
        let stepped = passes.steps.iter().find_map(|(pass, _)| match pass {
            Pass::StepField { ticks, .. } => Some(ticks.start),
            _ => None,
        });
        assert_eq!(stepped, Some(400), "{passes}");
        assert_eq!(passes.after.fields[0].as_ref().unwrap().rest, None);
    }
}

#[test]
fn a_film_that_hardly_moves_takes_few_steps() {
    let mut scene = stirred_scene();
    scene.motion.strength = 1e-7;
    // 1e-3 of a cell of 6 milliradians at less than 1e-5 rad/s: more than half a second.
    let steps = steps(&scene, 3600);
    assert!((1..100).contains(&steps.len()), "{steps:?}");
    assert!(between((&scene, 7), (&scene, 8)).is_empty(), "nor is it shown anew");
    scene.motion.strength = 1e-3;
    assert_eq!(between((&scene, 12), (&scene, 13)), ["show_field", "draw", "tonemap"]);
}

#[test]
fn a_long_jump_takes_the_steps_of_the_frames_that_it_skips() {
    let (mut scene, end) = (stirred_scene(), 600);
    scene.events.push(event(100, Flow::Sloshing));
    let in_one_go = steps(&scene, end);
    let mut in_frames: Vec<Range<u64>> = Vec::new();
    let mut have = Have::default();
    for tick in 0..=end {
        let frame = plan(&wanted(&scene, tick, Pace::Whole), &have);
        for (pass, _) in &frame.steps {
            if let Pass::StepField { key, ticks, .. } = pass {
                in_frames.extend(key.steps_from(ticks.start));
            }
        }
        have = frame.after;
    }
    assert_eq!(in_frames, in_one_go);
    assert!(in_one_go.len() <= 51, "12 ticks each, and one that the new law cut short: {}", in_one_go.len());
}

#[test]
fn turning_and_evaporating_as_a_whole_only_draws() {
    let mut scene = stirred_scene();
    scene.motion.flow = Flow::Rest;
    scene.motion.spin_deg_s = [0.0, 0.0, 90.0];
    scene.motion.evaporation_nm_s = 60.0;
    assert_eq!(between((&scene, 5), (&scene, 65)), ["draw", "tonemap"]);
    let bubble = |tick| wanted(&scene, tick, Pace::Whole).picture.draw.bubbles[0].clone();
    let later = bubble(60);
    assert!((later.to_film * DVec3::Y).distance(DVec3::X) < 1e-12, "a quarter turn in a second");
    assert!((later.thinned_nm - 60.0).abs() < 1e-9);
    assert!(between((&uniform_scene(), 0), (&uniform_scene(), 9999)).is_empty());
}

/// Where nobody left checkpoints.
#[test]
fn going_back_in_time_seeds_anew() {
    let back = ["seed_field", "step_field", "show_field", "draw", "tonemap"];
    assert_eq!(between((&stirred_scene(), 30), (&stirred_scene(), 20)), back);
}

/// Goes to a tick frame by frame, as a window does, and counts the steps and the checkpoints on the way.
fn go(scene: &Scene, tick: u64, have: &mut Have) -> (u64, Vec<&'static str>) {
    let (mut steps, mut passes) = (0, Vec::new());
    for _ in 0..100_000 {
        let next = plan(&wanted(scene, tick, Pace::Frame), have);
        for (pass, _) in &next.steps {
            if let Pass::StepField { key, ticks, .. } = pass {
                steps += key.steps_from(ticks.start).count() as u64;
            }
            passes.push(pass.name());
        }
        *have = next.after;
        if next.complete {
            return (steps, passes);
        }
    }
    panic!("it never arrives at tick {tick}");
}

/// A film of few cells that takes a step a tick.
fn free_scene() -> Scene {
    let mut scene = preset("default").unwrap();
    scene.bubbles[0].film.cells = 16;
    scene
}

#[test]
fn going_back_in_time_starts_from_a_checkpoint() {
    let (scene, mut have) = (free_scene(), Have::default());
    assert_eq!(go(&scene, 610, &mut have).0, 610);
    let (steps, passes) = go(&scene, 605, &mut have);
    assert!(steps == 5 && passes[0] == "restore_field", "{steps}: {passes:?}");
    let (steps, passes) = go(&scene, 30, &mut have);
    assert!(steps == 30 && passes[0] == "seed_field", "{steps}: {passes:?}");
    let (steps, passes) = go(&scene, 610, &mut have);
    assert!(steps == 10 && passes[0] == "restore_field", "forward again: {steps}: {passes:?}");
}

#[test]
fn going_back_costs_about_as_many_steps_as_going_as_far_forward() {
    let scene = free_scene();
    let mut worst: f64 = 0.0;
    for end in [59_u64, 600, 3599, 20_000, 100_001] {
        let mut arrived = Have::default();
        go(&scene, end, &mut arrived);
        for back in [1, 10, 60, 100, 300, 600, 1000, 3000, 10_000, 50_000].into_iter().filter(|back| *back <= end) {
            let (steps, _) = go(&scene, end - back, &mut arrived.clone());
            worst = worst.max(steps as f64 / (back as f64 + 60.0));
        }
    }
    eprintln!("measured: steps of going back over those of going forward {worst:.2}");
    assert!(worst <= 3.0, "{worst}");
}

/// A finger on the time line: the whole history backwards, in tenths of a second.
#[test]
fn scrubbing_backwards_moves_the_film_a_few_times_through_its_history() {
    let (scene, end, mut have) = (free_scene(), 6000, Have::default());
    go(&scene, end, &mut have);
    let steps: u64 = (0..end).rev().step_by(6).map(|tick| go(&scene, tick, &mut have).0).sum();
    eprintln!("measured: {} times the history in {} pictures", steps as f64 / end as f64, end / 6);
    assert!(steps < 16 * end, "{steps}");
}

#[test]
fn checkpoints_of_another_past_or_film_are_not_gone_back_to() {
    let mut have = Have::default();
    let scene = free_scene();
    go(&scene, 600, &mut have);
    let mut other = scene.clone();
    other.events.push(event(130, Flow::Sloshing));
    let (steps, passes) = go(&other, 600, &mut have.clone());
    assert_eq!((steps, passes[0]), (10 + 78, "restore_field"), "from tick 120, and in longer steps from 130 on");
    other.bubbles[0].film.seed += 1;
    let (steps, passes) = go(&other, 600, &mut have);
    assert_eq!((steps, passes[0]), (130 + 78, "seed_field"));
}

#[test]
fn films_have_as_many_checkpoints_as_there_is_room_for() {
    for (cells, slots) in [(16, 8), (256, 8), (300, 5), (512, 2), (1024, 2)] {
        let mut scene = free_scene();
        scene.bubbles[0].film.cells = cells;
        let mut have = Have::default();
        go(&scene, 600, &mut have);
        let film = have.fields[0].as_ref().unwrap();
        let at = |tick| film.checkpoints.latest(&film.state.at(Moment::tick(tick)));
        let used: BTreeSet<usize> = (0..=600).filter_map(at).map(|(slot, _)| slot).collect();
        assert_eq!(used.len(), slots, "{cells} cells");
    }
}

#[test]
fn a_picture_for_a_file_leaves_no_checkpoints() {
    let passes = names(&plan(&wanted(&free_scene(), 600, Pace::Whole), &Have::default()));
    assert!(passes.contains(&"step_field") && !passes.contains(&"save_field"), "{passes:?}");
}

#[test]
fn the_plan_says_what_and_why() {
    let text = plan(&wanted(&stirred_scene(), 30, Pace::Whole), &Have::default()).to_string();
    for part in ["bake_table", "film 0, ticks 0..24", "nothing there yet"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert_eq!(
        plan(&wanted(&stirred_scene(), 2, Pace::Whole), &after(&stirred_scene(), 2)).to_string(),
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
fn decided(have: &Have, want: &Want) -> (Option<TonemapKey>, Vec<Option<TableKey>>, Vec<Option<FieldHave>>) {
    let needed = |index: usize| {
        want.picture.draw.bubbles.iter().any(|bubble| bubble.index == index && matches!(bubble.film, FilmKey::Field(_)))
    };
    let field = |(index, field): (usize, &Option<FieldHave>)| {
        let field = field.clone().filter(|_| needed(index))?;
        Some(FieldHave { checkpoints: Checkpoints::default(), ..field })
    };
    let mut fields: Vec<_> = have.fields.iter().enumerate().map(field).collect();
    while fields.last().is_some_and(Option::is_none) {
        fields.pop();
    }
    let tables = have.lights.iter().map(|light| light.table.clone()).collect();
    (have.picture.clone(), tables, fields)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_way_there_does_not_matter(way in proptest::collection::vec((scenes(), 0..80_u64, any::<bool>()), 1..6), end in scenes(), tick in 0..80_u64) {
        let mut have = Have::default();
        for (scene, tick, whole) in way {
            have = plan(&wanted(&scene, tick, if whole { Pace::Whole } else { Pace::Frame }), &have).after;
        }
        let want = wanted(&end, tick, Pace::Whole);
        let arrived = plan(&want, &have);
        let fresh = plan(&want, &Have::default());
        prop_assert!(arrived.complete && fresh.complete);
        prop_assert_eq!(decided(&arrived.after, &want), decided(&fresh.after, &want));
        prop_assert_eq!(arrived.after.picture.as_ref(), Some(&want.picture));
        prop_assert!(plan(&want, &arrived.after).is_empty());
        let in_a_frame = Want { pace: Pace::Frame, ..want };
        prop_assert!(plan(&in_a_frame, &arrived.after).is_empty());
    }

    #[test]
    fn frames_end_where_one_go_does(scene in scenes(), tick in 0..80_u64) {
        let (want, mut have) = (wanted(&scene, tick, Pace::Frame), Have::default());
        for _ in 0..200 {
            let next = plan(&want, &have);
            have = next.after;
            if next.complete {
                break;
            }
        }
        let whole = plan(&Want { pace: Pace::Whole, ..want.clone() }, &Have::default());
        prop_assert_eq!(decided(&have, &want), decided(&whole.after, &want));
    }
}
