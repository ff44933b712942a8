//! The picture in the middle: gestures, tools, the probe, and the room that panels leave.

use super::*;

#[test]
fn the_picture_can_stand_alone() {
    let mut window = window();
    press(&mut window, Modifiers::NONE, Key::F11);
    let rect = window.state().picture.unwrap().rect;
    assert!(rect.width() > 1260.0 && rect.height() > 1180.0, "{rect}");
    assert!(window.query_by_label("Play").is_none() && window.query_by_label("Orbit").is_none());
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.get_by_label("Play");
}

/// No widget of a small window reaches beyond it.
#[test]
fn nothing_is_clipped_in_a_small_window() {
    let mut window = harness(model(), vec2(640.0, 480.0));
    window.step();
    window.step();
    let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(640.0, 480.0)).expand(1.0);
    for name in
        ["Pause", "Step", "Reset", "Loop", "Length", "Time", "Orbit", "Probe", "Presets", "File", "Window", "Undo"]
    {
        let rect = window.get_by_label(name).rect();
        assert!(screen.contains_rect(rect), "{name}: {rect}");
    }
    let picture = window.state().picture.unwrap().rect;
    assert!(picture.width() > 300.0 && picture.height() > 350.0, "{picture}");
}

#[test]
fn the_probe_shows_its_numbers_and_keeps_what_was_clicked() {
    let mut window = window();
    press(&mut window, Modifiers::NONE, Key::Num6);
    let middle = window.state().picture.unwrap().rect.center();
    window.hover_at(middle);
    window.run();
    assert_eq!(window.state().model.probe.asked(), Some(glam::DVec2::ZERO));
    let reading = crate::app::probe::tests::reading();
    window.state_mut().model.probe.answer(Some(reading.clone()), &[], true);
    window.run();
    window.get_all_by_label("320.0 nm").next().unwrap();
    assert_eq!(window.state().model.probe.pinned, None, "nothing was clicked");
    window.drag_at(middle);
    window.drop_at(middle);
    window.run();
    window.state_mut().model.probe.answer(Some(reading), &[], true);
    window.run();
    click(&mut window, "CSV…");
    assert_eq!(window.state().model.requests, [Request::Ask(Target::SaveCsv(Plot::Spectra))]);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().model.probe.pinned, None);
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert_eq!(window.state().model.probe.asked(), None, "other tools measure nothing");
}

#[test]
fn a_kept_picture_is_compared() {
    let mut window = window();
    press(&mut window, Modifiers::NONE, Key::K);
    assert_eq!(window.state_mut().model.compare.wants.take(), Some(Want::Keep));
    let pixels = |grey: u8| Pixels { size: [2, 2], rgba: vec![grey; 16].into() };
    window.state_mut().model.compare.keep(pixels(90), "furnace at 0.00 s".to_owned());
    window.run();
    let line = window.get_by_role_and_label(Role::Slider, "Split").rect().center();
    window.drag_at(line);
    window.step();
    window.hover_at(line + vec2(30.0, 0.0));
    window.step();
    window.hover_at(line + vec2(200.0, 0.0));
    window.step();
    window.drop_at(line + vec2(200.0, 0.0));
    window.run();
    assert!(window.state().model.compare.split > 0.6, "{}", window.state().model.compare.split);
    click(&mut window, "ΔE map");
    assert_eq!(window.state_mut().model.compare.wants.take(), Some(Want::Map));
    window.state_mut().model.compare.map = Some(Map::new(&pixels(90), &pixels(90)));
    window.run();
    window.get_by_label_contains("mean 0.000");
    click(&mut window, "Split");
    click(&mut window, "Close");
    assert_eq!(window.state().model.compare.kept(), None);
}

#[test]
fn hidden_panels_leave_the_window_to_the_picture() {
    let mut window = window();
    let narrow = window.state().picture.unwrap().rect.width();
    window.key_press(Key::H);
    window.run();
    let wide = window.state().picture.unwrap().rect.width();
    assert!(wide - narrow > 250.0, "{narrow} and {wide} points wide");
}

#[test]
fn a_drag_on_the_picture_turns_and_a_wheel_zooms() {
    let mut window = window();
    let rect = window.state().picture.unwrap().rect;
    let middle = rect.center();
    window.drag_at(middle);
    window.step();
    window.hover_at(middle + vec2(60.0, 0.0));
    window.step();
    let turn = window.state().picture.unwrap().gesture.turn;
    assert!((turn.x - 60.0 / f64::from(rect.height())).abs() < 1e-6 && turn.y == 0.0, "{turn}");
    window.drop_at(middle);
    window.step();
    window.hover_at(middle);
    window.step();
    let unit = egui::MouseWheelUnit::Line;
    window.event(egui::Event::MouseWheel {
        unit,
        delta: vec2(0.0, 1.0),
        modifiers: Modifiers::NONE,
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
    });
    // egui spreads a notch over several frames.
    let zoom: f64 = (0..20)
        .map(|_| {
            window.step();
            window.state().picture.unwrap().gesture.zoom
        })
        .sum();
    assert!((0.1..0.3).contains(&zoom), "{zoom}");
}

#[test]
fn a_tool_in_hand_works_on_the_film_and_beside_it_the_view_turns() {
    let mut window = window();
    click(&mut window, "Stir");
    let middle = window.state().picture.unwrap().rect.center();
    for (from, events, turns) in [(middle, 3, false), (middle - vec2(0.0, 550.0), 3, true)] {
        window.drag_at(from);
        window.step();
        for k in 1..=3u8 {
            window.state_mut().model.clock.tick += 6;
            window.hover_at(from + vec2(30.0 * f32::from(k), 0.0));
            window.step();
        }
        let Picture { gesture, .. } = window.state().picture.unwrap();
        assert_eq!((window.state().model.scene.events.len(), gesture.turn.x > 0.0), (events, turns));
        window.drop_at(from + vec2(90.0, 0.0));
        window.step();
    }
    let scene: &Scene = &window.state().model.scene;
    assert!(scene.events.iter().all(|event| matches!(event.change, Change::Stir(_))));
    assert_eq!(Scene::from_toml(&scene.to_toml(), "saved").as_ref(), Ok(scene));
}

#[test]
fn keys_take_tools_and_tilt_gravity() {
    let mut window = window();
    for (key, tool) in
        [(Key::Num2, Tool::Stir), (Key::Num5, Tool::Prick), (Key::Num7, Tool::Profile), (Key::Num1, Tool::Orbit)]
    {
        window.key_press(key);
        window.run();
        assert_eq!(window.state().model.tool, tool);
    }
    window.state_mut().model.clock.tick = 60;
    let from_x = |scene: &mut Scene| (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (0.0, 0.0);
    window.state_mut().model.scene.change(from_x);
    (0..9).for_each(|_| {
        window.key_press(Key::ArrowRight);
        window.run();
    });
    // Seen from +x, +y is on the right.
    let [x, y, z] = window.state().model.motion().gravity_m_s2;
    assert!(x.abs() < 0.01 && (y - 9.81).abs() < 0.01 && z.abs() < 0.01, "{x} {y} {z}");
    assert_eq!(window.state().model.scene.events.len(), 1, "one tick, one event");
    window.key_press(Key::ArrowUp);
    window.run();
    assert!(window.state().model.motion().gravity_m_s2[1] > 9.8, "it lies along the axis of that turn");
}

#[test]
fn every_size_of_window_has_a_layout() {
    for size in [vec2(1.0, 1.0), vec2(200.0, 150.0), vec2(320.0, 900.0), vec2(4000.0, 2500.0)] {
        let mut model = model();
        model.shows_help = true;
        model.messages.problem("a problem with a long name that must find its place somewhere");
        model.loading = Some("hall.exr".to_owned());
        let mut window = harness(model, size);
        window.step();
        window.step();
        assert!(window.state().picture.is_some());
    }
}

#[test]
fn two_fingers_zoom_and_shift_but_neither_turn_nor_press() {
    let mut window = window();
    let middle = window.state().picture.unwrap().rect.center();
    let touch = |id: u64, phase, pos| egui::Event::Touch {
        device_id: egui::TouchDeviceId(1),
        id: egui::TouchId(id),
        phase,
        pos,
        force: None,
    };
    // The first finger is the pointer too, as in a window.
    window.drag_at(middle);
    window.event(touch(1, egui::TouchPhase::Start, middle));
    window.step();
    assert!(window.state().picture.unwrap().pressed.is_some());
    window.event(touch(2, egui::TouchPhase::Start, middle + vec2(50.0, 0.0)));
    window.step();
    window.hover_at(middle - vec2(50.0, 0.0));
    window.event(touch(1, egui::TouchPhase::Move, middle - vec2(50.0, 0.0)));
    window.step();
    let picture = window.state().picture.unwrap();
    assert!((picture.gesture.zoom - 2.0_f64.ln()).abs() < 1e-3, "{}", picture.gesture.zoom);
    let shift = picture.gesture.shift * f64::from(picture.rect.height());
    assert!((shift.x + 25.0).abs() < 0.01 && shift.y == 0.0, "{shift}");
    assert_eq!((picture.gesture.turn, picture.pressed.is_none()), (glam::DVec2::ZERO, true));
    // The finger that is left does nothing until it is lifted.
    window.event(touch(2, egui::TouchPhase::End, middle + vec2(50.0, 0.0)));
    window.hover_at(middle);
    window.step();
    let picture = window.state().picture.unwrap();
    assert_eq!((picture.gesture.turn, picture.pressed.is_none()), (glam::DVec2::ZERO, true));
    window.event(touch(1, egui::TouchPhase::End, middle));
    window.drop_at(middle);
    window.run_steps(2);
    window.drag_at(middle);
    window.step();
    assert!(window.state().picture.unwrap().pressed.is_some());
}

#[test]
fn a_finger_that_rests_goes_on_holding_the_picture() {
    let mut window = window();
    let middle = window.state().picture.unwrap().rect.center();
    window.drag_at(middle);
    window.event(egui::Event::Touch {
        device_id: egui::TouchDeviceId(1),
        id: egui::TouchId(1),
        phase: egui::TouchPhase::Start,
        pos: middle,
        force: None,
    });
    // Longer than a click may take, which is when egui takes a finger for a secondary click.
    window.input_mut().time = Some(0.0);
    window.step();
    window.input_mut().time = Some(2.0);
    window.step();
    window.step();
    assert!(window.state().picture.unwrap().pressed.is_some());
    window.hover_at(middle + vec2(60.0, 0.0));
    window.step();
    let picture = window.state().picture.unwrap();
    let turn = picture.gesture.turn * f64::from(picture.rect.height());
    assert!((turn.x - 60.0).abs() < 0.01 && picture.pressed.is_some(), "{turn}");
}
