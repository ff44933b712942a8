//! Rows of the panels: what the keyboard does to them, and the way back to their defaults.

use super::*;

fn focus(window: &mut Harness<'static, State>, name: &str) {
    window.get_by_role_and_label(Role::Slider, name).focus();
    window.run();
}

#[test]
fn arrow_keys_move_sliders_by_round_steps() {
    let mut window = window();
    window.state_mut().model.scene.change(|scene| {
        scene.view.exposure_ev = 0.7;
        scene.bubbles[0].film.thickness_nm = 700.0;
    });
    window.run();
    focus(&mut window, "Exposure");
    for (modifiers, key, expected) in [
        (Modifiers::NONE, Key::ArrowRight, 0.8),
        (Modifiers::NONE, Key::ArrowRight, 0.9),
        (Modifiers::NONE, Key::ArrowLeft, 0.8),
        (Modifiers::SHIFT, Key::ArrowRight, 1.8),
        (Modifiers::SHIFT, Key::ArrowLeft, 0.8),
    ] {
        press(&mut window, modifiers, key);
        assert_eq!(window.state().model.scene.view.exposure_ev, expected, "{modifiers:?} {key:?}");
    }
    focus(&mut window, "Thickness");
    for expected in [710.0, 720.0] {
        press(&mut window, Modifiers::NONE, Key::ArrowRight);
        assert_eq!(window.state().model.scene.bubbles[0].film.thickness_nm, expected);
    }
    window.state_mut().model.scene.change(|scene| scene.bubbles[0].film.thickness_nm = 100.0);
    window.run();
    for (key, expected) in [(Key::ArrowLeft, 99.0), (Key::ArrowRight, 100.0), (Key::ArrowRight, 110.0)] {
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(window.state().model.scene.bubbles[0].film.thickness_nm, expected);
    }
}

#[test]
fn arrow_keys_move_a_number_that_has_the_keyboard() {
    let mut window = window();
    window.state_mut().model.scene.change(|scene| scene.view.exposure_ev = 0.7);
    window.run();
    window.get_by_role_and_label(Role::SpinButton, "Exposure").focus();
    window.run();
    for (key, expected) in [(Key::ArrowUp, 0.8), (Key::ArrowUp, 0.9), (Key::ArrowDown, 0.8)] {
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(window.state().model.scene.view.exposure_ev, expected);
    }
}

#[test]
fn arrow_keys_move_the_time_by_ticks() {
    let mut window = window();
    window.state_mut().model.clock.seek(100);
    window.run();
    focus(&mut window, "Time");
    for (modifiers, key, expected) in [
        (Modifiers::NONE, Key::ArrowRight, 101),
        (Modifiers::NONE, Key::ArrowLeft, 100),
        (Modifiers::SHIFT, Key::ArrowRight, 110),
    ] {
        press(&mut window, modifiers, key);
        assert_eq!(window.state().model.clock.tick, expected);
    }
}

#[test]
fn panels_follow_the_keyboard() {
    let mut window = harness(model(), vec2(1280.0, 500.0));
    window.state_mut().model.clock.running = false;
    window.run();
    let visible = egui::Rangef::new(80.0, 440.0);
    let exposure =
        |window: &Harness<'static, State>| window.get_by_role_and_label(Role::Slider, "Exposure").rect().center().y;
    assert!(!visible.contains(exposure(&window)), "it begins out of sight");
    focus(&mut window, "Exposure");
    (0..20).for_each(|_| window.step());
    assert!(visible.contains(exposure(&window)), "{}", exposure(&window));
    // What is seen already scrolls nothing.
    let before = exposure(&window);
    window.get_by_role_and_label(Role::Slider, "Time").focus();
    (0..20).for_each(|_| window.step());
    assert_eq!(exposure(&window), before);
}

#[test]
fn rows_are_set_back_one_by_one() {
    let mut window = harness(model(), vec2(1280.0, 2400.0));
    window.state_mut().model.clock.running = false;
    window.state_mut().model.scene.change(|scene| *scene = Scene { light: scene.light.clone(), ..Scene::default() });
    window.run();
    let names = ["Exposure", "Spin", "Gravity", "Dither", "Quality", "Scheme"];
    let reset = |name: &str| format!("Reset {name}");
    for name in names {
        assert!(window.query_by_label(&reset(name)).is_none(), "{name} is at its default");
    }
    let place = |window: &Harness<'static, State>| window.get_by_role_and_label(Role::Slider, "Exposure").rect();
    let before = place(&window);
    let changed = |scene: &mut Scene| {
        (scene.view.exposure_ev, scene.motion.spin_deg_s, scene.motion.gravity_m_s2) = (3.0, [0.0, 0.0, 9.0], [0.0; 3]);
        (scene.view.dither, scene.motion.scheme) = (!scene.view.dither, Scheme::Bicubic);
        scene.view.quality = crate::scene::Quality::ALL[0];
        if scene.view.quality == crate::scene::View::default().quality {
            scene.view.quality = crate::scene::Quality::ALL[1];
        }
    };
    window.state_mut().model.scene.change(changed);
    window.run();
    assert_eq!(place(&window), before, "a row keeps its layout");
    for name in names {
        click(&mut window, &reset(name));
        assert!(window.query_by_label(&reset(name)).is_none(), "{name} is set back");
    }
    let scene = &window.state().model.scene;
    assert_eq!((&scene.view, &scene.motion), (&Scene::default().view, &Scene::default().motion));
    assert!(window.state().model.undo.last_name().is_some());
}

#[test]
fn escape_closes_a_menu_and_nothing_else() {
    let mut window = window();
    window.state_mut().model.messages.problem("a problem");
    window.run();
    click(&mut window, "File");
    window.get_by_label("Save as…");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Save as…").is_none());
    window.get_by_label("a problem");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("a problem").is_none());
}

#[test]
fn names_of_files_stand_in_one_line() {
    let mut window = window();
    let name = "a picture of a bubble with a name that is rather long.toml";
    window.state_mut().model.settings.remember(&format!("/tmp/{name}"));
    window.get_by_label("File").click();
    (0..2).for_each(|_| window.step());
    let height = window.get_by_label(name).rect().height();
    assert!(height < 30.0, "{height}");
}

#[test]
fn a_near_eye_has_a_distance_that_is_not_0() {
    let mut window = window();
    window.state_mut().model.scene.change(|scene| scene.camera.distance_m = 0.000_12);
    window.run();
    let shown = window.get_by_role_and_label(Role::SpinButton, "Distance").value();
    assert_eq!(shown.as_deref(), Some("0.00012 m"));
}

#[test]
fn a_film_at_rest_has_no_rows_of_its_flow() {
    let mut window = window();
    window.get_by_role_and_label(Role::Slider, "Strength");
    window.state_mut().model.scene.change(|scene| scene.motion.flow = Flow::Rest);
    window.run();
    assert!(window.query_by_label("Strength").is_none() && window.query_by_label("New flow seed").is_none());
}

#[test]
fn an_added_bubble_has_its_detail_settled() {
    let mut window = window();
    click(&mut window, "Add");
    let scene = &window.state().model.scene;
    assert_eq!(scene.bubbles[1].film.detail, crate::scene::Detail::Full);
}
