//! Panels driven through their accessible names, without window or GPU.

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
        time_line::Mark,
        tools::{Press, Tool},
    },
    scene::{
        Backdrop, Boundary, Change, Event, FilmStateName, Flow, Generator, Layout, Motion, MotionChange, Scene, Scheme,
    },
};

mod bubbles;
mod dialogs;
mod exports;
mod keyframes;
mod lamps;
mod lesson;
mod measure;
mod picture;
mod rows;
mod safety;
mod spectrum;
mod time_line;

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

/// A window on the furnace, whose film is made to vary and to flow, and whose clock stands.
fn window() -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    model.scene.change(|scene| {
        (scene.bubbles[0].film.state, scene.motion.flow) = (FilmStateName::Blown, Flow::Free);
    });
    let mut window = harness(model, vec2(1280.0, 1300.0));
    window.run();
    window
}

/// A frame of a test takes a quarter of a second, and two clicks eight frames. What was clicked before does not count.
fn wait_for_double_clicks(window: &mut Harness<'static, State>) {
    window.ctx.options_mut(|options| options.input_options.max_double_click_delay = 2.5);
    (0..12).for_each(|_| window.step());
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

/// A window so high that all keys stand in it.
fn high_window() -> Harness<'static, State> {
    let mut window = harness(model(), vec2(1280.0, 6000.0));
    window.state_mut().model.clock.running = false;
    window.run();
    window
}

/// Clicks the button of a name that stands nearest to a label's row.
fn click_beside(window: &mut Harness<'static, State>, button: &str, label: &str) {
    let y = window.get_all_by_label(label).next().unwrap().rect().center().y;
    let heights: Vec<f32> = window.get_all_by_label(button).map(|button| button.rect().center().y).collect();
    let nearest = (0..heights.len()).min_by(|a, b| (heights[*a] - y).abs().total_cmp(&(heights[*b] - y).abs()));
    window.get_all_by_label(button).nth(nearest.unwrap()).unwrap().click();
    window.run();
}

#[test]
fn all_keys_have_rows_and_can_be_set_back() {
    let mut window = high_window();
    click(&mut window, "All keys");
    let before = Scene::clone(&window.state().model.scene);
    window.state_mut().model.scene.change(|scene| scene.camera.azimuth_deg = 77.0);
    window.run();
    for label in ["Azimuth", "Target", "Center", "Film seed"] {
        assert!(window.query_all_by_label(label).next().is_some(), "{label}");
    }
    click_beside(&mut window, "reset", "Azimuth");
    assert_eq!(window.state().model.scene.camera.azimuth_deg, 20.0, "its normal value");
    assert_eq!(window.state().model.scene.bubbles, before.bubbles, "other keys stay");
}

#[test]
fn keys_without_a_value_are_set_and_unset() {
    let mut window = high_window();
    click(&mut window, "All keys");
    let before = Scene::clone(&window.state().model.scene);
    assert_eq!(before.camera.focal_mm, None);
    click_beside(&mut window, "set", "Focal length");
    let focal_mm = window.state().model.scene.camera.focal_mm.unwrap();
    assert!(focal_mm > 1.0 && window.state().model.scene.validate().is_ok(), "{focal_mm} mm");
    click_beside(&mut window, "unset", "Focal length");
    assert_eq!(window.state().model.scene.camera, before.camera);
    // Those of the motion too, of which most are events.
    for label in ["Gravity", "Tick"] {
        window.query_all_by_label(label).last().unwrap();
    }
}

#[test]
fn generators_are_added_and_deleted() {
    let mut window = high_window();
    click(&mut window, "Generators");
    // Bubbles are added above.
    window.get_all_by_label("Add").last().unwrap().click();
    window.run();
    assert_eq!(window.state().model.scene.generators.len(), 1);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(window.state().model.scene.generators.len(), 0);
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
    let camera = window.state().model.scene.camera.clone();
    assert_eq!(*window.state().model.scene, Scene { camera, ..before });
}

#[test]
fn a_scheme_is_chosen_for_the_whole_history() {
    let mut window = window();
    click(&mut window, "bicubic");
    assert_eq!(window.state().model.scene.motion.scheme, Scheme::Bicubic);
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
