//! The editor of the light's spectrum.

use super::*;
use crate::scene::{Light, LightSpectrum};

fn opened() -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    let mut window = harness(model, vec2(1280.0, 1800.0));
    window.run();
    click(&mut window, "Spectrum");
    window
}

/// The light that was asked for, as if it were loaded.
#[track_caller]
fn loaded(window: &mut Harness<'static, State>) -> LightSpectrum {
    let model = &mut window.state_mut().model;
    let requests = std::mem::take(&mut model.requests);
    let [Request::LoadLight(light)] = &requests[..] else { panic!("one light: {requests:?}") };
    let illuminant = light.spectrum.as_ref().map(|spectrum| spectrum.illuminant().unwrap());
    let resources =
        crate::plan::Resources { illuminant: illuminant.unwrap_or_default().into(), ..model.resources.clone() };
    model.adopt_light(light.clone(), resources);
    window.run();
    window.state().model.scene.light.spectrum.clone().unwrap_or_default()
}

#[test]
fn a_named_light_becomes_points_and_is_one_again() {
    let mut window = opened();
    window.get_by_label("x 0.3127, y 0.3290, 6503 K");
    click(&mut window, "Edit");
    let points = loaded(&mut window);
    assert!((13..=30).contains(&points.power.len()), "{points:?}");
    click(&mut window, "Add point");
    assert_eq!(loaded(&mut window).power.len(), points.power.len() + 1);
    click(&mut window, "Back to D65");
    loaded(&mut window);
    assert_eq!(window.state().model.scene.light, model().scene.light);
    (0..3).for_each(|_| press(&mut window, Modifiers::COMMAND, Key::Z));
    assert_eq!(window.state().model.undo.steps(), 0);
    assert_eq!(window.state().model.scene.light, model().scene.light);
}

#[test]
fn a_band_is_set_and_another_name_takes_its_place() {
    let mut window = opened();
    click(&mut window, "Set");
    let band = loaded(&mut window);
    assert_eq!((band.wavelengths_nm, band.power), (vec![520.0, 550.0, 580.0], vec![0.0, 1.0, 0.0]));
    window.get_by_role_and_label(Role::ComboBox, "Illuminant").click();
    window.run();
    click(&mut window, "D65");
    let requests = std::mem::take(&mut window.state_mut().model.requests);
    assert!(matches!(&requests[..], [Request::LoadLight(Light { spectrum: None, .. })]), "{requests:?}");
}

#[test]
fn points_are_dragged_added_and_removed() {
    let mut window = opened();
    click(&mut window, "Set");
    loaded(&mut window);
    let plot = window.get_by_label("Plot of the spectrum").rect();
    // As the panel draws it: 6 points of room at the sides, 4 above and below, and the colours and wavelengths beneath.
    let x = |nm: f32| plot.left() + 6.0 + (plot.width() - 12.0) * (nm - 360.0) / 420.0;
    let y = |power: f32| plot.bottom() - 27.0 - (plot.height() - 31.0) * power / 1.1;
    let steps = window.state().model.undo.steps();
    window.drag_at(egui::pos2(x(550.0), y(1.0)));
    window.run();
    for part in [0.3, 0.6, 1.0] {
        window.hover_at(egui::pos2(x(550.0 + 20.0 * part), y(1.0 - 0.5 * part)));
        window.run();
        assert_eq!(window.state().model.requests, [], "nothing is loaded before the point is let go");
    }
    window.drop_at(egui::pos2(x(570.0), y(0.5)));
    window.run();
    let moved = loaded(&mut window);
    assert!((moved.wavelengths_nm[1] - 570.0).abs() < 1.0 && (moved.power[1] - 0.5).abs() < 0.02, "{moved:?}");
    assert_eq!(window.state().model.undo.steps(), steps + 1);
    // The scale follows the largest power.
    let at = egui::pos2(x(650.0), y(0.5));
    wait_for_double_clicks(&mut window);
    for _ in 0..2 {
        window.drag_at(at);
        window.drop_at(at);
    }
    window.run();
    let more = loaded(&mut window);
    assert_eq!(more.power.len(), 4);
    assert!((more.wavelengths_nm[3] - 650.0).abs() < 1.0, "{more:?}");
    for pressed in [true, false] {
        let button = egui::PointerButton::Secondary;
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
    }
    window.run();
    assert_eq!(loaded(&mut window).power.len(), 3);
}

#[test]
fn points_have_numbers_for_the_keyboard() {
    let mut window = opened();
    click(&mut window, "Set");
    loaded(&mut window);
    click(&mut window, "Points (3)");
    let number = |window: &Harness<'static, State>, nth: usize| {
        window.get_all_by_role_and_label(Role::SpinButton, "Point 2").nth(nth).unwrap().rect().center()
    };
    for (nth, text) in [(0, "600"), (1, "2.5")] {
        let at = number(&window, nth);
        window.drag_at(at);
        window.drop_at(at);
        window.run();
        window.event(egui::Event::Text(text.to_owned()));
        press(&mut window, Modifiers::NONE, Key::Enter);
        loaded(&mut window);
    }
    let points = window.state().model.scene.light.spectrum.clone().unwrap();
    // The right neighbour stands at 580 nm.
    assert_eq!((points.wavelengths_nm[1], points.power[1]), (579.0, 2.5));
    assert_eq!(window.state().model.scene.validate(), Ok(()));
}

#[test]
fn darkness_is_refused_with_its_reason() {
    let mut window = opened();
    let spectrum = LightSpectrum { wavelengths_nm: vec![500.0, 600.0], power: vec![1.0, 0.0] };
    window.state_mut().model.scene.change(|scene| scene.light.spectrum = Some(spectrum));
    window.run();
    click(&mut window, "Points (2)");
    let at = window.get_all_by_role_and_label(Role::SpinButton, "Point 1").nth(1).unwrap().rect().center();
    window.drag_at(at);
    window.drop_at(at);
    window.run();
    window.event(egui::Event::Text("0".to_owned()));
    press(&mut window, Modifiers::NONE, Key::Enter);
    let model = &mut window.state_mut().model;
    assert_eq!(model.requests, []);
    assert!(model.messages.at(0.0).iter().any(|message| message.text.contains("no usable power")));
}
