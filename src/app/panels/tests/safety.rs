//! Undo, questions before loss, and messages.

use super::*;

#[test]
fn every_change_can_be_taken_back_and_made_again() {
    let mut window = window();
    let mut scenes = vec![Scene::clone(&window.state().model.scene)];
    window.state_mut().model.clock.tick = 60;
    set_slider(&mut window, "Exposure", -1.5);
    scenes.push(Scene::clone(&window.state().model.scene));
    set_slider(&mut window, "Evaporation", 5.0);
    scenes.push(Scene::clone(&window.state().model.scene));
    click(&mut window, "bath");
    scenes.push(Scene::clone(&window.state().model.scene));
    press(&mut window, Modifiers::NONE, Key::N);
    scenes.push(Scene::clone(&window.state().model.scene));
    let name = |window: &Harness<'static, State>| window.state().model.undo.last_name().map(str::to_owned);
    let mut names = Vec::new();
    for scene in scenes.iter().rev().skip(1) {
        names.extend(name(&window));
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(*window.state().model.scene, *scene, "{names:?}");
    }
    assert_eq!(names, ["New seeds", "Boundary", "Evaporation", "Exposure"]);
    assert_eq!((name(&window), window.state().model.undo.is_dirty()), (None, false));
    for scene in &scenes[1..] {
        press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
        assert_eq!(*window.state().model.scene, *scene);
    }
    // What is done after an undo takes the place of what was undone.
    click(&mut window, "Undo");
    set_slider(&mut window, "Exposure", 1.0);
    assert_eq!(window.state().model.undo.next_name(), None);
}

#[test]
fn a_drag_is_one_step_and_a_stroke_of_a_tool_another() {
    let mut window = window();
    let middle = window.state().picture.unwrap().rect.center();
    let before = Scene::clone(&window.state().model.scene);
    for tool in ["Orbit", "Stir"] {
        click(&mut window, tool);
        window.drag_at(middle);
        for k in 1..=5u8 {
            window.step();
            window.state_mut().model.clock.tick += 6;
            window.hover_at(middle + vec2(20.0 * f32::from(k), 0.0));
        }
        window.step();
        window.drop_at(middle + vec2(100.0, 0.0));
        window.run();
    }
    assert!(window.state().model.scene.events.len() > 2 && window.state().model.undo.is_dirty());
    assert_eq!(window.state().model.undo.last_name(), Some("Stir"));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(window.state().model.scene.events, []);
    assert_eq!(window.state().model.undo.last_name(), Some("Camera"));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*window.state().model.scene, before);
}

#[test]
fn work_that_would_be_lost_is_asked_about() {
    let mut window = window();
    press(&mut window, Modifiers::COMMAND, Key::Q);
    assert_eq!(std::mem::take(&mut window.state_mut().model.requests), [Request::Quit], "nothing would be lost");
    set_slider(&mut window, "Exposure", 1.0);
    assert!(window.state().model.title().ends_with("(edited)"));
    press(&mut window, Modifiers::COMMAND, Key::Q);
    window.get_by_label_contains("before the window closes");
    press(&mut window, Modifiers::NONE, Key::Space);
    assert!(!window.state().model.clock.running, "keys wait for the answer");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!((&window.state().model.question, &window.state().model.requests[..]), (&None, &[][..]));
    window.state_mut().model.ask_for(Request::LoadScene("trio".to_owned()));
    window.run();
    click(&mut window, "Do not save");
    let model = &mut window.state_mut().model;
    assert_eq!(std::mem::take(&mut model.requests), [Request::LoadScene("trio".to_owned())]);
    model.ask_for(Request::Quit);
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    let model = &mut window.state_mut().model;
    assert_eq!(std::mem::take(&mut model.requests), [Request::Ask(Target::SaveScene)], "a preset has no file yet");
    model.saved("/a/b.toml".into(), model.undo.state());
    assert_eq!(std::mem::take(&mut model.requests), [Request::Quit]);
    assert_eq!(model.title(), "soapfilm – /a/b.toml");
    assert_eq!(model.settings.recent, ["/a/b.toml"]);
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert_eq!(window.state().model.requests, [Request::Save], "its file is known now");
}

#[test]
fn a_path_is_typed_where_no_dialog_can_ask() {
    let mut window = window();
    let ask = |model: &mut Model| model.question = Some(Question::path(Target::SaveScene, &model.name, &model.folder));
    ask(&mut window.state_mut().model);
    window.run();
    let field = window.get_by_role(Role::TextInput);
    let proposed = std::path::absolute("furnace.toml").unwrap().display().to_string();
    assert_eq!(field.value().as_ref(), Some(&proposed), "with its folder");
    field.type_text("2");
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    let typed = Request::Typed(Target::SaveScene, format!("{proposed}2"));
    assert_eq!(std::mem::take(&mut window.state_mut().model.requests), [typed]);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().model.question, None);
}

#[test]
fn left_work_is_offered() {
    let mut window = window();
    window.state_mut().model.question = Some(Question::Left("trio".to_owned()));
    window.run();
    click(&mut window, "Recover");
    assert_eq!(window.state().model.requests, [Request::Left(Fate::TakeUp)]);
    assert_eq!(window.state().model.question, None);
}

#[test]
fn problems_are_shown_until_they_are_dismissed() {
    let mut window = window();
    window.state_mut().model.messages.problem("hall.exr is damaged");
    window.run();
    window.get_by_label("hall.exr is damaged");
    click(&mut window, "×");
    assert!(window.query_by_label("hall.exr is damaged").is_none());
}
