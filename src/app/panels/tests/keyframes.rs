//! Keyframes of the camera: in the panel, and on the time line.

use super::*;
use crate::scene::{Ease, Keyframe};

/// A window so high that all sections stand in it, with the list of keyframes open.
fn keyframe_window() -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    let mut window = harness(model, vec2(1280.0, 2400.0));
    window.run();
    click(&mut window, "Keyframes");
    window
}

/// Lets the keyframes move the camera, as each redraw does.
fn go(window: &mut Harness<'static, State>, time_s: f64) {
    set_slider(window, "Time", time_s);
    window.state_mut().model.advance(0.0);
    window.run();
}

fn keyframes<'a>(window: &'a Harness<'static, State>) -> &'a [Keyframe] {
    &window.state().model.scene.camera.keyframes
}

#[test]
fn keyframes_are_made_of_views_and_undone() {
    let mut window = keyframe_window();
    click(&mut window, "Add keyframe here");
    go(&mut window, 4.0);
    click(&mut window, "top");
    click(&mut window, "Add keyframe here");
    let of = |key: &Keyframe| (key.time_s, key.elevation_deg, key.ease);
    let start_deg = keyframes(&window)[0].elevation_deg;
    let expected = [(0.0, start_deg, Ease::Smooth), (4.0, Some(90.0), Ease::Smooth)];
    assert_eq!(keyframes(&window).iter().map(of).collect::<Vec<_>>(), expected);
    go(&mut window, 2.0);
    let middle_deg = window.state().model.scene.camera.elevation_deg;
    assert!((middle_deg - 0.5 * (start_deg.unwrap() + 90.0)).abs() < 1e-9, "{middle_deg}");
    window.get_by_role_and_label(Role::Button, "0.00 s").click();
    window.run();
    assert_eq!(window.state().model.clock.tick, 0);
    window.get_by_role_and_label(Role::ComboBox, "0.00 s").click();
    window.run();
    click(&mut window, "hold");
    assert_eq!(keyframes(&window)[0].ease, Ease::Hold);
    window.get_all_by_label("×").next().unwrap().click();
    window.run();
    assert_eq!(keyframes(&window).len(), 1);
    assert!(window.state().model.undo.is_dirty());
    for left in [2, 2, 1] {
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(keyframes(&window).len(), left);
    }
    window.get_by_label("Keyframes (1)");
}

#[test]
fn a_view_off_the_keyframes_is_told() {
    let mut window = keyframe_window();
    click(&mut window, "Add turntable");
    assert_eq!(keyframes(&window).len(), 2);
    go(&mut window, 5.0);
    assert!(window.query_by_label_contains("off the keyframes").is_none());
    click(&mut window, "side");
    window.get_by_label_contains("off the keyframes");
    go(&mut window, 6.0);
    assert!(window.query_by_label_contains("off the keyframes").is_none());
}

#[test]
fn keyframes_are_selected_dragged_and_removed_on_the_time_line() {
    let mut window = keyframe_window();
    click(&mut window, "Add turntable");
    let strip = window.get_by_label("Camera keyframes").rect();
    // The time line is ten seconds long, and its ends stand a little inside.
    let at = |tick: f32| egui::pos2(strip.left() + 10.0 + (strip.width() - 20.0) * tick / 600.0, strip.top() + 5.0);
    window.drag_at(at(600.0));
    window.step();
    assert_eq!(window.state().model.time_line.selected, Some(Mark::Keyframe(1)));
    window.hover_at(at(400.0));
    window.step();
    window.hover_at(at(300.0));
    window.step();
    window.drop_at(at(300.0));
    window.run();
    let time_s = keyframes(&window)[1].time_s;
    assert!((time_s - 5.0).abs() < 0.2, "{time_s}");
    assert_eq!(window.state().model.time_line.selected, Some(Mark::Keyframe(1)), "it stays selected");
    window.get_by_label_contains("camera keyframe, linear");
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(keyframes(&window).len(), 1);
    (0..2).for_each(|_| press(&mut window, Modifiers::COMMAND, Key::Z));
    assert_eq!(keyframes(&window)[1].time_s, 10.0);
}
