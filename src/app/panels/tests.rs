//! Panels driven through their accessible names, without window or GPU.

mod exports;

use egui::{Key, Modifiers, accesskit::Role, vec2};
use egui_kittest::{Harness, kittest::Queryable};

use super::Picture;
use crate::{
    app::{
        compare::{Map, Pixels, Want},
        edit::Edit,
        model::{Model, tests::model},
        probe::Plot,
        request::{Fate, Question, Request, Target},
        tools::Tool,
    },
    scene::{
        Backdrop, Boundary, Change, Event, FilmStateName, Flow, Generator, Layout, Motion, MotionChange, Scene, Scheme,
    },
};

mod lesson;
mod measure;

struct State {
    model: Model,
    picture: Option<Picture>,
}

fn harness(model: Model, size: egui::Vec2) -> Harness<'static, State> {
    let state = State { model, picture: None };
    // Notes leave by time; nothing else moves, so a frame settles in a few steps.
    Harness::builder().with_size(size).build_ui_state(
        |ui, state| {
            let picture = super::show(ui, &mut state.model);
            state.model.move_camera(&picture.gesture, 1.2);
            state.picture = Some(picture);
        },
        state,
    )
}

/// A window on the furnace, whose film is made to vary and whose clock stands.
fn window() -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    model.scene.change(|scene| scene.bubbles[0].film.state = FilmStateName::Blown);
    let mut window = harness(model, vec2(1280.0, 1200.0));
    window.run();
    window
}

fn click(window: &mut Harness<'static, State>, name: &str) {
    window.get_by_label(name).click();
    window.run();
}

fn set_slider(window: &mut Harness<'static, State>, name: &str, value: f64) {
    window.get_by_role_and_label(Role::Slider, name).set_value_accesskit(value);
    window.run();
}

#[test]
fn films_end_where_the_panel_says_and_only_where_they_can() {
    let mut window = window();
    window.get_by_label("bath").click();
    window.run();
    let model = &window.state().model;
    assert_eq!((model.scene.bubbles[0].boundary, model.clock.tick), (Boundary::Bath, 0));
    set_slider(&mut window, "Regeneration", 4.0);
    assert_eq!(window.state().model.scene.bubbles[0].regeneration, 4.0);
    window.get_by_label("stirred").click();
    window.run();
    let model = &mut window.state_mut().model;
    assert_ne!(model.motion().flow, Flow::Stirred, "no prescribed flow keeps within a rim");
    assert!(model.messages.at(0.0).iter().any(|message| message.text.contains("across a rim")));
}

#[test]
fn sliders_change_what_they_are_called() {
    let mut window = window();
    for (name, value) in [
        ("Radius", 20.0),
        ("Thickness", 321.0),
        ("Stratification", -1.0),
        ("Strength", 2.5),
        ("Spin", -45.0),
        ("Evaporation", 12.5),
        ("Gravity", 5.0),
        ("Tilt", 90.0),
        ("Speed", 0.5),
        ("Rotation", 90.0),
        ("Intensity", 3.0),
        ("Exposure", -1.5),
        ("Field of view", 50.0),
        ("Distance", 0.5),
    ] {
        set_slider(&mut window, name, value);
    }
    let scene = &window.state().model.scene;
    let bubble = &scene.bubbles[0];
    assert_eq!((bubble.radius_mm, bubble.film.thickness_nm, bubble.film.stratification), (20.0, 321.0, -1.0));
    assert_eq!((scene.motion.strength, scene.motion.speed), (2.5, 0.5));
    assert_eq!((scene.motion.spin_deg_s, scene.motion.evaporation_nm_s), ([0.0, 0.0, -45.0], 12.5));
    assert_eq!(scene.motion.gravity_m_s2, [0.0, 5.0, 0.0]);
    assert_eq!((scene.light.rotation_deg, scene.light.intensity), (90.0, 3.0));
    assert_eq!((scene.view.exposure_ev, scene.camera.fov_y_deg, scene.camera.distance_m), (-1.5, 50.0, 0.5));
    assert_eq!(scene.validate(), Ok(()));
}

#[test]
fn no_slider_leaves_the_ranges_of_a_scene() {
    let mut window = window();
    let names = ["Radius", "Thickness", "Stratification", "Strength", "Speed", "Rotation", "Intensity", "Exposure"];
    let others = ["Field of view", "Distance", "Spin", "Evaporation", "Gravity", "Tilt", "Time"];
    let names: Vec<_> = names.into_iter().chain(others).collect();
    for extreme in [-1e12, 1e12] {
        for name in &names {
            set_slider(&mut window, name, extreme);
        }
        assert_eq!(window.state().model.scene.validate(), Ok(()), "after {extreme}");
    }
}

#[test]
fn another_film_starts_from_the_beginning() {
    let mut window = window();
    window.state_mut().model.clock.tick = 500;
    // Film and flow both know a rest; the film's stands first.
    window.get_all_by_label("rest").next().unwrap().click();
    window.run();
    let model = &window.state().model;
    assert_eq!((model.scene.bubbles[0].film.state, model.clock.tick), (FilmStateName::Rest, 0));
}

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
    assert_eq!(window.state().model.time_line.selected, Some(0));
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
    assert_eq!(window.state().model.time_line.selected, Some(1), "the event stays selected");
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
fn all_keys_have_rows_and_can_be_set_back() {
    let mut model = model();
    model.clock.running = false;
    let mut window = harness(model, vec2(1280.0, 4000.0));
    window.run();
    click(&mut window, "All keys");
    let before = Scene::clone(&window.state().model.scene);
    window.state_mut().model.scene.change(|scene| scene.camera.azimuth_deg = 77.0);
    window.run();
    for label in ["Azimuth", "Target", "Center", "Film seed"] {
        assert!(window.query_all_by_label(label).next().is_some(), "{label}");
    }
    let resets: Vec<_> = window.query_all_by_label("reset").map(|reset| reset.rect().center().y).collect();
    let azimuth = window.query_all_by_label("Azimuth").next().unwrap().rect().center().y;
    let nearest =
        (0..resets.len()).min_by(|a, b| (resets[*a] - azimuth).abs().total_cmp(&(resets[*b] - azimuth).abs()));
    window.query_all_by_label("reset").nth(nearest.unwrap()).unwrap().click();
    window.run();
    assert_eq!(window.state().model.scene.camera.azimuth_deg, 20.0, "its normal value");
    assert_eq!(window.state().model.scene.bubbles, before.bubbles, "other keys stay");
}

#[test]
fn bubbles_are_selected_added_and_deleted() {
    let mut window = harness(Model::new(crate::input::load_scene("trio").unwrap()), vec2(1280.0, 1000.0));
    window.state_mut().model.clock.running = false;
    window.run();
    let before = Scene::clone(&window.state().model.scene);
    let rect = window.state().picture.unwrap().rect;
    for bubble in 0..3 {
        let (middle, _) = crate::app::tools::outline(&window.state().model.scene, 0, bubble).unwrap();
        let at = rect.center() + rect.height() * vec2(middle.x as f32, -middle.y as f32);
        window.drag_at(at);
        window.drop_at(at);
        window.run();
        assert_eq!((window.state().model.selected, window.state().model.outlines), (bubble, true));
    }
    click(&mut window, "Duplicate");
    let scene = &window.state().model.scene;
    assert_eq!((scene.bubbles.len(), window.state().model.selected), (4, 3));
    assert_eq!(scene.bubbles[3].film, before.bubbles[2].film);
    assert_ne!(scene.bubbles[3].center_m, before.bubbles[2].center_m);
    click(&mut window, "Delete");
    assert_eq!(window.state().model.scene.bubbles, before.bubbles);
    click(&mut window, "Add");
    assert_eq!(window.state().model.undo.last_name(), Some("Add bubble"));
    (0..3).for_each(|_| press(&mut window, Modifiers::COMMAND, Key::Z));
    assert_eq!(*window.state().model.scene, before);
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
    assert_eq!(window.state().model.compare.kept, None);
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
fn a_scheme_is_chosen_for_the_whole_history() {
    let mut window = window();
    click(&mut window, "bicubic");
    assert_eq!(window.state().model.scene.motion.scheme, Scheme::Bicubic);
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

#[test]
fn files_and_lights_are_asked_for() {
    let mut window = window();
    click(&mut window, "Save");
    click(&mut window, "windows");
    window.get_by_role_and_label(Role::ComboBox, "Illuminant").click();
    window.run();
    click(&mut window, "D50");
    window.key_press_modifiers(Modifiers::COMMAND, Key::P);
    window.run();
    click(&mut window, "Presets");
    press(&mut window, Modifiers::NONE, Key::K);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!window.state().model.shows_gallery && window.state().model.compare.wants.is_none());
    click(&mut window, "Presets");
    window.get_by_label_contains("lamplight: ");
    window.get_by_role_and_label(Role::Button, "lamplight").click_accesskit();
    window.run();
    assert!(!window.state().model.shows_gallery);
    let requests = std::mem::take(&mut window.state_mut().model.requests);
    assert_eq!(requests.len(), 5, "{requests:?}");
    assert_eq!(requests[0], Request::Ask(Target::SaveScene));
    assert!(matches!(&requests[1], Request::LoadLight(light) if light.constant.is_none()));
    assert!(matches!(&requests[2], Request::LoadLight(light) if light.illuminant == "D50"));
    assert_eq!(requests[3], Request::Ask(Target::SavePng));
    assert_eq!(requests[4], Request::LoadScene("lamplight".to_owned()));
}

fn press(window: &mut Harness<'static, State>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run();
}

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
    assert_eq!(field.value(), Some("furnace.toml".to_owned()));
    field.type_text("2");
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    let typed = Request::Typed(Target::SaveScene, "furnace.toml2".to_owned());
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
fn backdrop_and_dither_are_switched() {
    let mut window = window();
    let dither = window.state().model.scene.view.dither;
    click(&mut window, "colour");
    click(&mut window, "Dither");
    let view = &window.state().model.scene.view;
    assert!(matches!(view.backdrop, Backdrop::Radiance(_)));
    assert_eq!(view.dither, !dither);
}

#[test]
fn a_seed_button_picks_a_new_seed() {
    let mut window = window();
    let before = window.state().model.scene.clone();
    click(&mut window, "New film seed");
    click(&mut window, "New flow seed");
    let after = &window.state().model.scene;
    assert_ne!(after.bubbles[0].film.seed, before.bubbles[0].film.seed);
    assert_ne!(after.motion.seed, before.motion.seed);
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

#[test]
fn help_lists_the_keys_and_goes_again() {
    let mut window = window();
    window.key_press(Key::F1);
    window.run();
    window.get_by_label("Turn around the bubble");
    window.key_press(Key::Escape);
    window.run();
    assert!(!window.state().model.shows_help);
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
fn generators_have_a_panel() {
    let mut model = model();
    model.clock.running = false;
    model.scene.change(|scene| {
        scene.bubbles.clear();
        scene.generators = vec![Generator::default(), Generator::default()];
    });
    let mut window = harness(model, vec2(1280.0, 1800.0));
    window.run();
    window.get_by_label("Generators make all bubbles of this scene.");
    set_slider(&mut window, "Generator", 2.0);
    set_slider(&mut window, "Bubbles", 700.0);
    window.get_by_label("wand").click();
    window.run();
    let [first, second] = &window.state().model.scene.generators[..] else { panic!("there are two") };
    assert_eq!(*first, Generator::default());
    assert_eq!((second.count, second.layout), (700, Layout::Wand));
    assert!(second.life_s > 0.0, "a wand's bubbles have an end: {}", second.life_s);
}

#[test]
fn a_scene_without_bubbles_has_panels_too() {
    let mut model = model();
    model.scene.change(|scene| scene.bubbles.clear());
    let mut window = harness(model, vec2(1280.0, 800.0));
    window.run();
    window.get_by_label("This scene has no bubble.");
}
