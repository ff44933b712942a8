//! The steps of films, what pushes them and lets them rest, and what they share.

use std::ops::Range;

use super::*;

#[test]
fn a_changed_past_seeds_again_and_a_changed_future_does_not() {
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
    let bubble = |scene: &Scene, tick| frame_request(scene, tick, Pace::Whole).picture.draw.bubbles[0].clone();
    let (scene, start) = (drag([0.0, 0.01, 0.0]), DVec3::ZERO);
    assert_eq!(bubble(&scene, 20).center_m, start);
    assert!((1e-4..0.01).contains(&bubble(&scene, 24).center_m.y));
    assert!(bubble(&scene, 200).center_m.distance(DVec3::new(0.0, 0.01, 0.0)) < 1e-9);
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
    match &frame_request(scene, tick, Pace::Whole).picture.draw.bubbles[0].film {
        FilmKey::Field(film) => film.steps_from(0).collect(),
        FilmKey::Uniform(_) => panic!("the film has a field"),
    }
}

#[test]
fn a_stir_strains_a_film_until_drag_and_viscosity_calm_it() {
    let mut scene = preset("tent").unwrap();
    let strain = |scene: &Scene, tick| match &frame_request(scene, tick, Pace::Whole).picture.draw.bubbles[0].film {
        FilmKey::Field(film) => film.strain_until(tick as f64),
        FilmKey::Uniform(_) => panic!("the film has a field"),
    };
    assert_eq!(strain(&scene, 60), 0.0, "nothing pushes it");
    let stir =
        |tick, speed| Event { tick, change: Change::Stir(Stir { velocity_m_s: [0.0, speed, 0.0], ..Stir::default() }) };
    scene.events = vec![stir(20, 0.2), stir(30, 1.0), stir(50, 0.1)];
    let [before, gentle, hard, later] = [20, 32, 42, 102].map(|tick| strain(&scene, tick));
    assert_eq!(before, 0.0, "what comes later does nothing yet");
    // 20 rad/s over 0.22 rad, less what six e-foldings leave.
    assert!(gentle < hard && (hard / 90.0 - 1.0).abs() < 0.02, "{gentle} {hard}");
    // A second of drag of 2/s alone leaves 0.14.
    assert!(later < 0.14 * hard && later > 0.03 * hard, "{later}");
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
    let mut scene = preset("tent").unwrap();
    assert_eq!(steps(&scene, 3), [0..1, 1..2, 2..3], "waves of 5 cm turn by a quarter of a radian in 18 ms");
    scene.motion.gravity_m_s2 = [0.0; 3];
    assert_eq!(steps(&scene, 5), [0..2, 2..4], "without gravity steps of a thirtieth of a second do");
    let film = |scene: &Scene| match &frame_request(scene, 90, Pace::Whole).picture.draw.bubbles[0].film {
        FilmKey::Field(film) => film.clone(),
        FilmKey::Uniform(_) => panic!("the film has a field"),
    };
    scene.motion.evaporation_nm_s = 30.0;
    let faster = MotionChange { evaporation_nm_s: Some(60.0), ..MotionChange::default() };
    scene.events.push(Event { tick: 60, change: Change::Motion(faster) });
    let thinned = film(&scene).evaporated_nm(90.0);
    assert!((thinned - 60.0).abs() < 1e-9, "30 nm in the first second and 30 in the next half: {thinned}");
    scene.motion.flow = Flow::Stirred;
    assert_eq!(film(&scene).evaporated_nm(90.0), 0.0, "how thick it is changes nothing in how others move");
}

#[test]
fn a_film_that_was_found_at_rest_plans_nothing_until_something_acts_on_it() {
    let mut scene = preset("tent").unwrap();
    scene.motion.strength = 0.0;
    let FilmKey::Field(film) = &frame_request(&scene, 240, Pace::Whole).picture.draw.bubbles[0].film else {
        unreachable!()
    };
    let FlowLaw::Free(law) = film.law(0) else { unreachable!("a free film") };
    let resting = |tick| {
        let mut state = after(&scene, tick);
        state.fields[0].as_mut().unwrap().rest = Some(RestingFilm { since_tick: 240, law });
        state
    };
    let then = |scene: &Scene, state: &GpuState, tick| plan(&frame_request(scene, tick, Pace::UNMEASURED), state);
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
    let mut state = GpuState::default();
    for tick in 0..=end {
        let frame = plan(&frame_request(&scene, tick, Pace::Whole), &state);
        for (pass, _) in &frame.steps {
            if let Pass::StepField { key, ticks, .. } = pass {
                in_frames.extend(key.steps_from(ticks.start));
            }
        }
        state = frame.after;
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
    let bubble = |tick| frame_request(&scene, tick, Pace::Whole).picture.draw.bubbles[0].clone();
    let later = bubble(60);
    assert!((later.to_film * DVec3::Y).distance(DVec3::X) < 1e-12, "a quarter turn in a second");
    assert!((later.evaporated_nm - 60.0).abs() < 1e-9);
    assert!(between((&uniform_scene(), 0), (&uniform_scene(), 9999)).is_empty());
}

/// Some bubbles side by side.
fn side_by_side(count: usize) -> Scene {
    let mut scene = stirred_scene();
    let bubble = |k: usize| {
        let mut bubble = scene.bubbles[0].clone();
        bubble.center_m[1] = 0.03 * k as f64;
        bubble
    };
    scene.bubbles = (0..count).map(bubble).collect();
    scene
}

#[test]
fn films_share_the_cells_of_a_frame_and_all_get_on() {
    let mut scene = side_by_side(4);
    scene.bubbles.iter_mut().for_each(|bubble| bubble.film.cells = 256);
    let (request, mut state) = (frame_request(&scene, 40, Pace::UNMEASURED), GpuState::default());
    let cells = |pass: &Pass| match pass {
        Pass::StepField { key, ticks, .. } => {
            key.cell_count() * key.at(Moment::tick(ticks.end)).steps_from(ticks.start).count() as u64
        }
        _ => 0,
    };
    for frame in 0.. {
        assert!(frame < 400, "some film waits for ever");
        let plan = plan(&request, &state);
        let stepped: u64 = plan.steps.iter().map(|(pass, _)| cells(pass)).sum();
        assert!(stepped <= 800_000, "{stepped} cells in one frame");
        let ticks: Vec<_> = plan.after.fields.iter().flatten().map(|field| field.key.moment.tick).collect();
        let behind = ticks.iter().max().unwrap() - ticks.iter().min().unwrap();
        // No more than the two steps that the cells of a frame are.
        assert!(behind <= 24, "films drift apart: {ticks:?}");
        state = plan.after;
        if plan.complete {
            assert_eq!(behind, 0);
            return;
        }
    }
}

#[test]
fn a_frame_takes_the_steps_that_its_pace_allows_and_one_at_least() {
    let ticks_in = |cells| {
        let request = frame_request(&stirred_scene(), 1600, Pace::Frame { cells });
        plan(&request, &GpuState::default()).after.fields[0].as_ref().unwrap().key.moment.tick
    };
    let FilmKey::Field(film) = frame_request(&stirred_scene(), 1600, Pace::Whole).picture.draw.bubbles[0].film.clone()
    else {
        unreachable!("a stirred film moves")
    };
    let (cells, step) = (film.cell_count(), film.steps_from(0).next().unwrap().end);
    let in_steps = [0, 1, cells - 1, cells, 5 * cells, 6 * cells - 1].map(|cells| ticks_in(cells) / step);
    assert_eq!(in_steps, [1, 1, 1, 1, 5, 5]);
}

#[test]
fn films_that_take_the_same_steps_take_them_side_by_side() {
    let mut scene = Scene { bubbles: side_by_side(3).bubbles, ..checkpoints::free_scene() };
    scene.bubbles.iter_mut().for_each(|bubble| bubble.film.cells = 16);
    let stepped = |state: &GpuState, tick, pace| -> Vec<Vec<Range<u64>>> {
        let plan = plan(&frame_request(&scene, tick, pace), state);
        let rounds = plan.steps.chunk_by(|(pass, _), (next, _)| pass.steps_like(next));
        let ticks = |(pass, _): &(Pass, Reason)| match pass {
            Pass::StepField { ticks, .. } => Some(ticks.clone()),
            _ => None,
        };
        rounds
            .map(|round| round.iter().filter_map(ticks).collect::<Vec<_>>())
            .filter(|ticks| !ticks.is_empty())
            .collect()
    };
    assert_eq!(stepped(&GpuState::default(), 9, Pace::Whole), [vec![0..9; 3]]);
    // With a checkpoint on the way.
    let rounds = stepped(&GpuState::default(), 61, Pace::UNMEASURED);
    assert!(rounds.len() > 1 && rounds.iter().all(|round| *round == vec![round[0].clone(); 3]), "{rounds:?}");
    // The second was out of sight meanwhile.
    let mut state = after(&scene, 9);
    state.fields[1] = after(&scene, 4).fields[1].clone();
    assert_eq!(stepped(&state, 12, Pace::Whole), [vec![4..12; 1], vec![9..12; 2]]);
}

#[test]
fn products_that_the_scene_cannot_need_are_dropped() {
    let (three, mut one) = (side_by_side(3), side_by_side(1));
    let state = after(&three, 4);
    assert_eq!(state.fields.iter().flatten().count(), 3);
    let mut away = three.clone();
    away.camera.azimuth_deg = 180.0;
    away.camera.target_m = [10.0, 0.0, 0.0];
    let plan_of = |scene: &Scene| plan(&frame_request(scene, 4, Pace::Whole), &state);
    assert_eq!(plan_of(&away).after.fields.iter().flatten().count(), 3, "films out of sight stay");
    assert_eq!(plan_of(&one).after.fields.len(), 1);
    one.bubbles[0].film.state = crate::scene::FilmStateName::Uniform;
    assert_eq!(plan_of(&one).after.fields.iter().flatten().count(), 0, "a film of one thickness needs no field");
}

#[test]
fn a_picture_for_a_file_leaves_no_checkpoints() {
    let passes = names(&plan(&frame_request(&checkpoints::free_scene(), 600, Pace::Whole), &GpuState::default()));
    assert!(passes.contains(&"step_field") && !passes.contains(&"save_field"), "{passes:?}");
}

/// A picture of a size, at tick 9.
fn frame_request_at(scene: &Scene, size: [u32; 2]) -> FrameRequest {
    request(scene, &resources(), &Shot { size, ..shot(9, Pace::Whole) }).unwrap()
}

#[test]
fn a_bubble_that_is_never_large_in_the_picture_takes_half_of_its_cells() {
    let scene_at = |distance_m: f64| {
        let mut scene = preset("tent").unwrap();
        scene.camera.distance_m = distance_m;
        scene
    };
    // Across 40 of 1080 rows: 0.1 m over 40/1080 of what 30° see.
    let limit_m = 0.1 * 1080.0 / 40.0 / (2.0 * 15_f64.to_radians().tan());
    assert_eq!(film_grids(&scene_at(0.24), 0), [256, 64]);
    assert_eq!(film_grids(&scene_at(0.99 * limit_m), 0), [256, 64]);
    let far = scene_at(1.01 * limit_m);
    assert_eq!(film_grids(&far, 0), [128, 32]);
    assert_eq!(film_grids(&scene_at(0.0), 0), [256, 64], "from inside");

    let field = |scene: &Scene, size| match &frame_request_at(scene, size).picture.draw.bubbles[0].film {
        FilmKey::Field(field) => [field.cells, field.flow_cells],
        FilmKey::Uniform(_) => panic!("a blown film has a field"),
    };
    assert_eq!(field(&far, [160, 90]), field(&far, [3840, 2160]), "a film is the same in pictures of all sizes");

    let mut brought_near = far.clone();
    let eye_m = far.camera.eye();
    brought_near.events.push(Event { tick: 500, change: Change::Drag(Drag { bubble: 0, to_m: (0.9 * eye_m).into() }) });
    assert_eq!(film_grids(&brought_near, 0), [256, 64]);
    let mut on_ring = far.clone();
    on_ring.bubbles[0].boundary = Boundary::Ring;
    assert_eq!(film_grids(&on_ring, 0), [256, 64], "patches from a rim are small");
    for (detail, cells, grids) in [
        (Detail::Full, 256, [256, 64]),
        (Detail::Full, 1024, [1024, 256]),
        (Detail::Half, 1024, [512, 128]),
        (Detail::Half, 32, [16, 32]),
        (Detail::Half, 16, [16, 32]),
    ] {
        let mut told = far.clone();
        (told.bubbles[0].film.detail, told.bubbles[0].film.cells) = (detail, cells);
        assert_eq!(film_grids(&told, 0), grids, "whatever the camera");
    }
}

#[test]
fn settled_films_do_not_heed_the_camera() {
    let mut scene = preset("tent").unwrap();
    settle_detail(&mut scene);
    let near = frame_request_at(&scene, [160, 90]);
    scene.camera.distance_m = 6.0;
    let passes = names(&plan(&frame_request_at(&scene, [160, 90]), &plan(&near, &GpuState::default()).after));
    assert_eq!(passes, ["draw", "tonemap"]);
}

/// As many as a step takes, of the millions that the smallest patches on the largest bubble come to.
#[test]
fn the_smallest_patches_are_no_more_than_a_step_takes() {
    let mut scene = preset("ring").unwrap();
    let bubble = &mut scene.bubbles[0];
    (bubble.radius_mm, bubble.patch_mm, bubble.regeneration) = (5000.0, 0.1, 10.0);
    scene.motion.gravity_m_s2 = [0.0, 0.0, -1000.0];
    let Some(FilmKey::Field(film)) = Story::new(scene).film_key(0, Moment::tick(1000)) else {
        panic!("a ring's film has a field")
    };
    assert_eq!(film.patches_during(0.0, 1000.0).len(), MAX_RIM_PATCHES);
}
