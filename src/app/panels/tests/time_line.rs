//! The clock, and events on the time line.

use super::*;

#[test]
fn a_flow_chosen_while_time_runs_is_an_event_that_can_be_taken_back() {
    let mut window = window();
    window.state_mut().model.clock.tick = 120;
    click(&mut window, "stirred");
    assert_eq!(window.state().model.motion().flow, Flow::Stirred);
    assert_eq!(window.state().model.scene.events.len(), 1);
    click(&mut window, "History (1)");
    window.get_by_label_contains("2.00 s: flow stirred");
    click(&mut window, "×");
    assert_eq!(window.state().model.scene.events, []);
}

#[test]
fn the_time_line_goes_back_and_forth_and_ahead() {
    let mut window = window();
    window.state_mut().model.clock.tick = 300;
    window.run();
    let ticks = [1.0, 4.0, 0.0, 5.0, 60.0].map(|time_s| {
        set_slider(&mut window, "Time", time_s);
        window.state().model.clock.tick
    });
    assert_eq!(ticks, [60, 240, 0, 300, 600], "as far as the time line is long");
    assert_eq!(window.state().model.scene.events, [], "looking back changes no history");
}

#[test]
fn events_are_selected_dragged_and_removed_on_the_time_line() {
    let mut window = window();
    let stir = |tick| Event {
        tick,
        change: Change::Motion(MotionChange { flow: Some(Flow::Stirred), ..MotionChange::default() }),
    };
    window.state_mut().model.edit(Edit::History(Motion::default().into(), vec![stir(120), stir(480)]));
    window.run();
    let strip = window.get_by_label("Events").rect();
    // The time line is ten seconds long, and its ends stand a little inside.
    let at = |tick: f32| egui::pos2(strip.left() + 10.0 + (strip.width() - 20.0) * tick / 600.0, strip.top() + 5.0);
    window.drag_at(at(120.0));
    window.step();
    assert_eq!(window.state().model.time_line.selected, Some(Mark::Event(0)));
    window.hover_at(at(400.0));
    window.step();
    window.hover_at(at(540.0));
    window.step();
    window.drop_at(at(540.0));
    window.run();
    let ticks = |window: &Harness<'static, State>| {
        window.state().model.scene.events.iter().map(|event| event.tick).collect::<Vec<_>>()
    };
    assert!(matches!(ticks(&window)[..], [480, moved] if (530..=550).contains(&moved)), "{:?}", ticks(&window));
    assert_eq!(window.state().model.time_line.selected, Some(Mark::Event(1)), "the event stays selected");
    window.get_by_label_contains("flow stirred");
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(ticks(&window), [480]);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(ticks(&window), [120, 480]);
}

#[test]
fn a_jump_ahead_shows_its_progress_and_can_be_stopped() {
    let mut window = window();
    set_slider(&mut window, "Time", 8.0);
    window.state_mut().model.behind_ticks = 400;
    window.run();
    window.get_by_label("400 ticks to go");
    window.state_mut().model.behind_ticks = 300;
    window.run();
    click(&mut window, "Stop");
    assert_eq!(window.state().model.clock.tick, 180, "what was reached of 480 ticks");
    window.state_mut().model.behind_ticks = 0;
    window.run();
    assert!(window.query_by_label("Stop").is_none());
}

#[test]
fn time_begins_with_the_first_picture() {
    let mut model = model();
    model.pictured = None;
    model.advance(0.4);
    assert_eq!(model.clock.tick, 0);
    model.pictured = Some(model.opened);
    model.advance(0.4);
    assert!(model.clock.tick > 20, "{}", model.clock.tick);
}

#[test]
fn the_time_that_is_shown_is_that_of_the_picture_and_never_goes_back() {
    let mut model = model();
    model.advance(0.4);
    assert!(model.clock.tick > 20 && model.shown_tick() == 0, "no picture of it yet");
    model.pictured_tick = 8;
    // The film has not kept up: the clock goes back to it.
    model.clock.hold(8, 0);
    assert_eq!(model.shown_tick(), 8);
    for pictured in [16, 24, 32] {
        model.advance(1.2);
        (model.pictured_tick, _) = (pictured, model.clock.hold(pictured, 0));
    }
    let rate = model.rate.latest().unwrap();
    assert!(rate > 0.0 && rate < 0.2, "{rate}");
    model.clock.running = false;
    model.clock.seek(300);
    assert_eq!(model.shown_tick(), 300, "where the time line was put");
}

#[test]
fn a_loop_begins_again_at_its_length() {
    let mut model = model();
    (model.time_line.loops, model.time_line.length_s) = (true, 1.0);
    (0..25).for_each(|_| model.advance(0.05));
    assert!(model.clock.tick < 20, "{}", model.clock.tick);
    model.time_line.loops = false;
    (0..25).for_each(|_| model.advance(0.05));
    assert!(model.clock.tick > 60, "{}", model.clock.tick);
}

#[test]
fn a_change_after_going_back_stands_before_what_came_later() {
    let mut window = window();
    window.state_mut().model.clock.tick = 300;
    set_slider(&mut window, "Spin", 90.0);
    set_slider(&mut window, "Time", 2.0);
    set_slider(&mut window, "Evaporation", 5.0);
    let scene: &Scene = &window.state().model.scene;
    assert_eq!(scene.events.iter().map(|event| event.tick).collect::<Vec<_>>(), [120, 300]);
    assert_eq!((scene.motion_at(299).spin_deg_s[2], scene.motion_at(300).spin_deg_s[2]), (0.0, 90.0));
    assert_eq!(scene.motion_at(120).evaporation_nm_s, 5.0);
    assert_eq!(Scene::from_toml(&scene.to_toml(), "saved").as_ref(), Ok(scene));
}

/// A slider that is held while an event passes changes its own key alone.
#[test]
fn edits_made_while_a_slider_is_dragged_stay() {
    let mut window = window();
    let stronger = MotionChange { strength: Some(3.0), ..MotionChange::default() };
    let event = Event { tick: 10, change: Change::Motion(stronger) };
    window.state_mut().model.scene.change(|scene| scene.events = vec![event]);
    let start = window.get_by_role_and_label(Role::Slider, "Evaporation").rect().center();
    window.drag_at(start);
    window.step();
    window.hover_at(start + vec2(10.0, 0.0));
    window.step();
    window.state_mut().model.clock.tick = 20;
    window.hover_at(start + vec2(20.0, 0.0));
    window.step();
    window.drop_at(start + vec2(20.0, 0.0));
    window.run();
    let motion = window.state().model.motion();
    assert!(motion.evaporation_nm_s > 0.0, "the slider was moved");
    assert_eq!((motion.strength, window.state().model.scene.events.len()), (3.0, 2));
}

#[test]
fn the_clock_obeys_buttons_and_keys() {
    let mut window = window();
    click(&mut window, "Step");
    click(&mut window, "Step");
    assert_eq!(window.state().model.clock.tick, 2);
    click(&mut window, "Reset");
    assert_eq!(window.state().model.clock.tick, 0);
    click(&mut window, "Play");
    assert!(window.state().model.clock.running);
    window.key_press(Key::Space);
    window.key_press(Key::Period);
    window.run();
    assert_eq!((window.state().model.clock.running, window.state().model.clock.tick), (false, 1));
}
