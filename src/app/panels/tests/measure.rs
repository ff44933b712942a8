//! Plots of pinned points, overlays, two pictures, views and the temperature of the light.

use super::*;
use crate::{
    app::{
        compare::Side,
        overlay::{FalseColour, Map as FilmMap},
        probe::tests::reading,
    },
    scene::Quality,
};

fn pinned(size: egui::Vec2) -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    model.probe.point(Some(glam::DVec2::ZERO), true);
    model.probe.answer(Some(reading()), &[], true);
    let mut window = harness(model, size);
    window.run();
    window
}

/// A window so high that all sections stand in it.
fn tall_window() -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    let mut window = harness(model, vec2(1280.0, 2400.0));
    window.run();
    window
}

/// Clicks what bears a name over the picture, not in the panels.
fn click_over_picture(window: &mut Harness<'static, State>, name: &str, nth: usize) {
    let right = window.state().picture.unwrap().rect.right();
    let named = window.get_all_by_label(name).filter(|node| node.rect().center().x < right);
    let mut places: Vec<_> = named.map(|node| node.rect().center()).collect();
    places.sort_by(|a, b| a.y.total_cmp(&b.y));
    window.drag_at(places[nth]);
    window.drop_at(places[nth]);
    window.run();
}

#[test]
fn each_plot_of_a_pin_can_be_seen_and_saved() {
    let mut window = pinned(vec2(1280.0, 1000.0));
    for plot in Plot::ALL {
        click(&mut window, plot.name());
        assert_eq!(window.state().model.probe.plot, plot);
        click(&mut window, "CSV…");
        click(&mut window, "PNG…");
        let asked = std::mem::take(&mut window.state_mut().model.requests);
        assert_eq!(asked, [Request::Ask(Target::SaveCsv(plot)), Request::Ask(Target::SavePlot(plot))]);
    }
    click(&mut window, "CIE 1976 u', v'");
    // The numbers of the front wall: u′ and v′ follow from x and y by 4x / (3 − 2x + 12y), 9y / (3 − 2x + 12y).
    let xyz = reading().walls[0].xyz;
    let [x, y] = [xyz.x, xyz.y].map(|part| part / xyz.element_sum());
    let over = 3.0 - 2.0 * x + 12.0 * y;
    window.get_by_label(&format!("front wall: u' {:.4}, v' {:.4}", 4.0 * x / over, 9.0 * y / over));
}

/// Where a part of the window stands.
fn area(window: &Harness<'static, State>, name: &str) -> egui::Rect {
    window.ctx.memory(|memory| memory.area_rect(egui::Id::unique(name))).expect("it is shown")
}

#[test]
fn the_card_at_the_pointer_keeps_clear_of_a_pin() {
    let mut window = pinned(vec2(1280.0, 1000.0));
    press(&mut window, Modifiers::NONE, Key::Num6);
    let middle = window.state().picture.unwrap().rect.center();
    for aside in [10.0, -10.0] {
        window.hover_at(middle + vec2(aside, -200.0));
        window.run();
        window.state_mut().model.probe.answer(Some(reading()), &[], true);
        window.run();
        window.run();
        assert!(!area(&window, "probe card").intersects(area(&window, "probe")), "{aside}");
    }
    window.state_mut().model.probe.pinned = None;
    window.hover_at(middle + vec2(10.0, -200.0));
    window.run();
    window.run();
    assert!(area(&window, "probe card").right() < middle.x + 10.0, "without a pin it stands on the left");
}

#[test]
fn messages_stand_above_the_hints() {
    let mut model = model();
    model.clock.running = false;
    model.messages.problem("a file is damaged, and what there is to say of it takes the width of the window");
    let mut window = harness(model, vec2(640.0, 480.0));
    window.run();
    window.run();
    assert!(area(&window, "notices").bottom() < area(&window, "hints").top());
}

#[test]
fn a_pin_fits_a_small_window() {
    let mut window = pinned(vec2(640.0, 480.0));
    let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(640.0, 480.0)).expand(1.0);
    for name in ["Copy", "CSV…", "PNG…"] {
        let rect = window.get_by_label(name).rect();
        assert!(screen.contains_rect(rect), "{name}: {rect}");
    }
    for plot in Plot::ALL {
        window.state_mut().model.probe.plot = plot;
        window.run();
        assert!(screen.contains_rect(window.get_by_label("Copy").rect()), "{plot:?}");
    }
}

#[test]
fn false_colour_has_a_scale_with_units() {
    let mut window = tall_window();
    click(&mut window, "flow speed");
    assert_eq!(window.state().model.overlay.of, FalseColour::Speed);
    let pixels = Pixels { size: [1, 1], rgba: vec![0; 4].into() };
    window.state_mut().model.overlay.map = Some(FilmMap { pixels, scale: [0.0, 25.0], of: FalseColour::Speed });
    window.run();
    window.get_by_label("flow speed of the front wall, mm/s");
    window.get_by_label("25");
}

#[test]
fn a_line_is_drawn_for_a_profile_and_turns_no_camera() {
    let mut window = window();
    press(&mut window, Modifiers::NONE, Key::Num7);
    let azimuth_deg = window.state().model.scene.camera.azimuth_deg;
    let middle = window.state().picture.unwrap().rect.center();
    window.drag_at(middle);
    window.step();
    window.hover_at(middle + vec2(0.0, 60.0));
    window.step();
    window.hover_at(middle + vec2(0.0, 200.0));
    window.step();
    window.drop_at(middle + vec2(0.0, 200.0));
    window.step();
    let model = &window.state().model;
    let [from, to] = model.overlay.profile.as_ref().unwrap().ends;
    assert!(from.length() < 1e-6 && to.y < -0.1, "{from} {to}");
    assert_eq!(model.scene.camera.azimuth_deg, azimuth_deg);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().model.overlay.profile, None);
}

#[test]
fn both_sides_can_have_any_quality_and_the_reference() {
    let mut window = window();
    let pixels = || Pixels { size: [2, 2], rgba: vec![90; 16].into() };
    window.state_mut().model.compare.keep(pixels(), "A".to_owned());
    window.run();
    click_over_picture(&mut window, "Quality", 1);
    click_over_picture(&mut window, "reference", 0);
    assert_eq!(window.state_mut().model.compare.wants.take(), Some(Want::Reference(Side::B)));
    let stop = window.state_mut().model.compare.begin_reference();
    window.run();
    click(&mut window, "Stop");
    assert!(stop.load(std::sync::atomic::Ordering::Relaxed) && window.state().model.compare.done.is_none());
    click_over_picture(&mut window, "Quality", 0);
    click_over_picture(&mut window, "spectral", 0);
    assert_eq!(window.state_mut().model.compare.wants.take(), Some(Want::Draw(Side::A, Quality::Spectral)));
}

#[test]
fn views_and_the_turntable_move_the_camera() {
    let mut window = tall_window();
    click(&mut window, "top");
    assert_eq!(window.state().model.scene.camera.elevation_deg, 90.0);
    click(&mut window, "front");
    set_slider(&mut window, "Turntable", 30.0);
    let (undo, model) = (window.state().model.undo.steps(), &mut window.state_mut().model);
    (0..10).for_each(|_| model.advance(0.1));
    assert!((model.scene.camera.azimuth_deg - 30.0).abs() < 1e-9, "{}", model.scene.camera.azimuth_deg);
    assert_eq!(model.undo.steps(), undo, "looking around is no step");
}

#[test]
fn a_black_body_has_a_temperature() {
    let mut model = model();
    model.clock.running = false;
    model.scene.change(|scene| scene.light.illuminant = "3200 K".to_owned());
    let mut window = harness(model, vec2(1280.0, 1200.0));
    window.run();
    window.get_by_role_and_label(Role::Slider, "Temperature").set_value_accesskit(5000.0);
    window.step();
    window.step();
    let [Request::LoadLight(light)] = &window.state().model.requests[..1] else { panic!("a light is loaded") };
    assert_eq!(light.illuminant, "5000 K");
}
