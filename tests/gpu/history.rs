//! A film's history: equal histories give equal bits however they were cut into frames, and no work is done in vain.

use soapfilm::{
    gpu::{Renderer, timing::Counts},
    input::LoadedScene,
    plan::{FieldState, FrameRequest, Moment, Pace},
    scene::{Blow, Change, Drag, Event, Flow, MotionChange, Scene, Stir},
};

use crate::support::{Random, load, radiance, renderer, short_or_long, still};

const SIZE: [u32; 2] = [64, 36];
/// Cells along a panel's edge.
fn cells() -> u32 {
    short_or_long(16, 32)
}

/// The default bubble with a film of few cells.
fn small() -> LoadedScene {
    let mut loaded = load("tent");
    loaded.scene.bubbles[0].film.cells = cells();
    loaded
}

fn event(tick: u64, change: MotionChange) -> Event {
    Event { tick, change: Change::Motion(change) }
}

/// A film that moves by itself, swings and is stirred, turns as a whole and evaporates, with remaps on the way.
fn eventful() -> LoadedScene {
    let mut loaded = small();
    loaded.scene.motion.remap_ticks = 40;
    let slosh = MotionChange { flow: Some(Flow::Sloshing), strength: Some(2.0), ..MotionChange::default() };
    let turn =
        MotionChange { spin_deg_s: Some([0.0, 20.0, 50.0]), evaporation_nm_s: Some(30.0), ..MotionChange::default() };
    let stir = MotionChange { flow: Some(Flow::Stirred), seed: Some(9), ..MotionChange::default() };
    // Within a step, across several, and while another law holds.
    let pushed = [
        (3, Change::Stir(Stir { ticks: 9, ..Stir::default() })),
        (9, Change::Drag(Drag { to_m: [0.0, 5e-3, 0.0], ..Drag::default() })),
        (10, Change::Blow(Blow { ticks: 2, ..Blow::default() })),
        (25, Change::Stir(Stir { at: [0.0, 0.0, 1.0], ticks: 90, ..Stir::default() })),
    ];
    loaded.scene.events = pushed.map(|(tick, change)| Event { tick, change }).into();
    loaded.scene.events.extend([event(31, slosh), event(47, turn), event(80, stir)]);
    loaded
}

/// Seconds of a number of ticks, whole or not.
fn seconds(ticks: f64) -> f64 {
    ticks / 60.0
}

/// What a window requests at a moment: a frame's worth.
fn frame(loaded: &LoadedScene, ticks: f64) -> FrameRequest {
    FrameRequest { pace: Pace::UNMEASURED, ..still(loaded, SIZE, seconds(ticks)) }
}

/// Between two ticks, and within a step.
const END_TICKS: f64 = 130.4;

fn arrive(renderer: &mut Renderer, loaded: &LoadedScene) -> Vec<[u64; 3]> {
    let pixels = radiance(renderer, &still(loaded, SIZE, seconds(END_TICKS)));
    pixels.into_iter().map(|pixel| pixel.to_array().map(f64::to_bits)).collect()
}

#[test]
fn equal_histories_give_equal_bits() {
    let Some(mut at_once) = renderer() else { return };
    let loaded = eventful();
    let expected = arrive(&mut at_once, &loaded);
    let moved = arrive(&mut at_once, &small());
    assert_ne!(expected, moved, "another history must be seen, or this test sees nothing");
    assert_eq!(arrive(&mut at_once, &loaded), expected, "after another history");

    let frames: [(&str, &[f64]); 3] = [
        ("a pause", &[5.0, 33.0, 33.0, 33.0, 34.0, 90.0, 90.0]),
        ("uneven frames", &[0.0, 1.0, 1.3, 2.0, 17.0, 30.9, 31.0, 46.0, 79.5, 80.0, 81.0, 130.0]),
        ("scrubbing back and forth", &[60.0, 20.0, 130.0, 79.9, 3.0, 200.0, 81.2, 0.0, 140.0]),
    ];
    for (name, ticks) in frames.into_iter().skip(short_or_long(1, 0)) {
        let mut renderer = renderer().unwrap();
        for ticks in ticks {
            // A window draws what it has got so far and goes on, whether the film has caught up or not.
            renderer.render(&frame(&loaded, *ticks)).unwrap();
        }
        assert_eq!(arrive(&mut renderer, &loaded), expected, "{name}");
    }
}

/// In a window events are added as they happen, and a saved scene is read by another process.
#[test]
fn a_history_made_while_it_runs_is_the_saved_one() {
    let Some(mut running) = renderer() else { return };
    let loaded = eventful();
    let mut live = LoadedScene { scene: Scene { events: Vec::new(), ..loaded.scene.clone() }, ..small() };
    for tick in (0..130).step_by(short_or_long(7, 3)) {
        let happened = loaded.scene.events.iter().filter(|event| event.tick <= tick);
        live.scene.events = happened.cloned().collect();
        running.render(&frame(&live, tick as f64)).unwrap();
    }
    let saved = Scene::from_toml(&live.scene.to_toml(), "saved").unwrap();
    let read = LoadedScene { scene: saved, ..small() };
    let mut other = renderer().unwrap();
    assert_eq!(arrive(&mut running, &live), arrive(&mut other, &read));
}

/// What the device did to get from the picture of one time to the picture of another.
fn cost(loaded: &LoadedScene, from_ticks: f64, to_ticks: f64) -> Option<[Counts; 2]> {
    let mut renderer = renderer()?;
    let mut at = |ticks: f64| {
        assert!(renderer.render(&still(loaded, SIZE, seconds(ticks))).unwrap().complete);
        renderer.counts
    };
    let first = at(from_ticks);
    let both = at(to_ticks);
    let second = Counts {
        dispatches: both.dispatches - first.dispatches,
        draws: both.draws - first.draws,
        pixels_shaded: both.pixels_shaded - first.pixels_shaded,
        cells_stepped: both.cells_stepped - first.cells_stepped,
        state_bytes: both.state_bytes - first.state_bytes,
        submissions: both.submissions - first.submissions,
    };
    Some([first, second])
}

#[test]
fn a_film_at_rest_does_nothing() {
    let mut loaded = small();
    loaded.scene.motion.flow = Flow::Rest;
    let Some([first, second]) = cost(&loaded, 7.0, 700.5) else { return };
    assert_eq!(first.cells_stepped, 0);
    assert_eq!(second.submissions, 0, "{second:?}");
}

/// A weightless film in still air, that is stirred while it rests.
fn calm() -> LoadedScene {
    let mut loaded = small();
    (loaded.scene.motion.gravity_m_s2, loaded.scene.motion.strength) = ([0.0; 3], 0.0);
    loaded.scene.events = vec![Event { tick: 300, change: Change::Stir(Stir::default()) }];
    loaded
}

#[test]
fn a_free_film_that_has_come_to_rest_does_nothing_until_it_is_disturbed() {
    let loaded = calm();
    let steps = |counts: Counts| counts.cells_stepped / (6 * u64::from(cells() * cells()));
    let Some([first, second]) = cost(&loaded, 250.0, 299.5) else { return };
    assert_eq!(steps(first), 120, "two ticks a step until the answer at tick 240: {first:?}");
    assert_eq!(
        (steps(second), second.draws <= first.draws),
        (0, true),
        "its picture is made once more at most: {second:?}"
    );
    let Some([_, stirred]) = cost(&loaded, 299.5, 360.0) else { return };
    assert_eq!(steps(stirred), 30, "from the stir on: {stirred:?}");
}

#[test]
fn equal_histories_of_a_film_that_rests_for_a_while_give_equal_bits() {
    let loaded = calm();
    let read = |ticks: &[f64]| {
        let mut renderer = renderer()?;
        for ticks in ticks {
            while !renderer.render(&frame(&loaded, *ticks)).unwrap().complete {}
        }
        let pixels = radiance(&mut renderer, &still(&loaded, SIZE, seconds(*ticks.last()?)));
        let pixels: Vec<_> = pixels.into_iter().map(|pixel| pixel.to_array().map(f64::to_bits)).collect();
        let (_, film) = renderer.read_film(0).unwrap().unwrap();
        Some((film.wait(&renderer.gpu).unwrap(), pixels))
    };
    let end = 340.5;
    let Some(expected) = read(&[end]) else { return };
    let every_frame: Vec<_> = (0..341).step_by(3).map(f64::from).chain([end]).collect();
    let frame_by_frame = short_or_long(None, Some(every_frame));
    assert!(frame_by_frame.is_none_or(|frames| read(&frames).as_ref() == Some(&expected)), "frame by frame");
    assert!(read(&[290.0, 130.0, 280.0, 330.0, 200.0, end]) == Some(expected), "back and forth");
}

#[test]
fn turning_and_evaporating_as_a_whole_draws_and_steps_no_cell() {
    let mut loaded = small();
    loaded.scene.motion.flow = Flow::Rest;
    (loaded.scene.motion.spin_deg_s, loaded.scene.motion.evaporation_nm_s) = ([10.0, 0.0, 90.0], 20.0);
    let Some([first, second]) = cost(&loaded, 7.0, 70.5) else { return };
    assert_eq!((first.cells_stepped, second.cells_stepped, second.dispatches), (0, 0, 0), "{second:?}");
    assert!(second.draws > 0, "the turn is seen");
}

#[test]
fn a_bubble_that_is_not_seen_is_not_moved() {
    let place = |center_m: [f64; 3]| {
        let mut loaded = small();
        loaded.scene.bubbles[0].center_m = center_m;
        loaded
    };
    let mut far = small();
    far.scene.camera.distance_m = 500.0;
    let unseen = [("beside the picture", place([0.0, 5.0, 0.0])), ("behind", place([5.0, 0.0, 0.0])), ("a speck", far)];
    for (name, mut loaded) in unseen {
        loaded.scene.motion.flow = Flow::Stirred;
        let Some([first, second]) = cost(&loaded, 7.0, 700.0) else { return };
        assert_eq!((first.cells_stepped, second.submissions), (0, 0), "{name}: {second:?}");
    }
}

/// What moves by less than a thousandth of a cell waits until it is more, and a long jump takes a few long steps.
#[test]
fn a_film_that_hardly_moves_is_hardly_stepped() {
    let mut loaded = small();
    (loaded.scene.motion.flow, loaded.scene.motion.strength) = (Flow::Stirred, 1e-7);
    let Some([first, second]) = cost(&loaded, 20.0, 36_000.0) else { return };
    assert_eq!(first.cells_stepped, 0, "a third of a second moves nothing by a thousandth of a cell");
    let steps = second.cells_stepped / (6 * u64::from(cells() * cells()));
    assert!((1..200).contains(&steps), "{steps} steps for 10 minutes");
    let Some([_, second]) = cost(&loaded, 20.0, 30.5) else { return };
    assert_eq!(second.submissions, 0, "nor is it shown or drawn anew: {second:?}");
}

/// Pictures of random moments, back and forth, as a finger on the time line asks for them.
#[test]
fn scrubbing_to_random_moments_gives_the_bits_of_a_run_from_scratch() {
    let Some(mut scrubbed) = renderer() else { return };
    let (mut random, mut loaded) = (Random(11), eventful());
    // It drains where it moves by itself, and black film spreads within the first seconds.
    loaded.scene.motion.drainage = 1000.0;
    loaded.scene.bubbles[0].film.thickness_nm = 250.0;
    (loaded.scene.motion.evaporation_nm_s, loaded.scene.motion.black_film_life_s) = (25.0, 1e6);
    let read = |renderer: &mut Renderer, ticks: f64| {
        while !renderer.render(&frame(&loaded, ticks)).unwrap().complete {}
        let (_, film) = renderer.read_film(0).unwrap().unwrap();
        (film.wait(&renderer.gpu).unwrap(), renderer.counts.cells_stepped)
    };
    let end = short_or_long(240.0, 400.0);
    read(&mut scrubbed, end);
    let mut stepped = [0; 2];
    for _ in 0..short_or_long(4, 8) {
        let ticks = (10.0 * end * random.next()).round() / 10.0;
        let before = scrubbed.counts.cells_stepped;
        let (found, cells) = read(&mut scrubbed, ticks);
        let (expected, from_scratch) = read(&mut renderer().unwrap(), ticks);
        assert!(found == expected, "tick {ticks}");
        stepped = [stepped[0] + cells - before, stepped[1] + from_scratch];
    }
    eprintln!("measured: cells stepped with checkpoints and from scratch {stepped:?}");
    assert!(4 * stepped[0] < stepped[1], "{stepped:?}");
}

/// What spreads the thickness of a free film must not outlive its history.
#[test]
fn a_film_forgets_the_laws_of_another_history() {
    let Some(mut renderer) = renderer() else { return };
    let mut stirred = small();
    stirred.scene.motion.flow = Flow::Stirred;
    let expected = arrive(&mut renderer, &stirred);
    let mut again = crate::support::renderer().unwrap();
    arrive(&mut again, &small());
    assert!(arrive(&mut again, &stirred) == expected);
}

/// What drains it while it moves by itself neither goes on afterwards nor was there before.
#[test]
fn a_film_drains_by_the_law_in_force_alone() {
    let Some(mut scrubbed) = renderer() else { return };
    let mut loaded = small();
    (loaded.scene.motion.flow, loaded.scene.motion.strength, loaded.scene.motion.drainage) =
        (Flow::Sloshing, 2.0, 10_000.0);
    loaded.scene.motion.remap_ticks = 12;
    let flow = |flow| MotionChange { flow: Some(flow), ..MotionChange::default() };
    loaded.scene.events = vec![event(61, flow(Flow::Free)), event(130, flow(Flow::Sloshing))];
    let read = |renderer: &mut Renderer, ticks: f64| {
        while !renderer.render(&frame(&loaded, ticks)).unwrap().complete {}
        let (_, film) = renderer.read_film(0).unwrap().unwrap();
        film.wait(&renderer.gpu).unwrap()
    };
    for ticks in [200.0, 50.0, 190.0, 100.0, 40.0].into_iter().take(short_or_long(2, 5)) {
        let found = read(&mut scrubbed, ticks);
        assert!(found == read(&mut renderer().unwrap(), ticks), "tick {ticks}");
    }
}

/// The state's tick is the last end of a step, the same in one go and frame by frame.
#[test]
fn states_end_where_steps_do() {
    let Some(mut renderer) = renderer() else { return };
    let loaded = eventful();
    let mut state = |request: &FrameRequest| {
        while !renderer.render(request).unwrap().complete {}
        renderer.state().fields[0].clone().map(|FieldState { key, shown, .. }| (key.moment, shown)).unwrap()
    };
    let jumped = state(&still(&loaded, SIZE, seconds(END_TICKS)));
    for ticks in [0.0, 77.7, 12.0] {
        state(&frame(&loaded, ticks));
    }
    assert_eq!(state(&frame(&loaded, END_TICKS)), jumped);
    assert_eq!(jumped.1.map(|shown| shown.tick), Some(130));
    assert!((80..130).contains(&jumped.0.tick) && jumped.0 == Moment::tick(jumped.0.tick), "{}", jumped.0);
}
