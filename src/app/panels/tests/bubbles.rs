//! Several bubbles that are selected at once, and the gizmo that moves them.

use egui::Pos2;
use glam::DVec3;

use super::*;
use crate::{app::tools::outline, input::load_scene, scene::Drag};

fn trio() -> Harness<'static, State> {
    let mut window = harness(Model::new(load_scene("trio").unwrap()), vec2(1280.0, 1200.0));
    window.state_mut().model.clock.running = false;
    window.run();
    window
}

fn place(window: &Harness<'static, State>, bubble: usize) -> Pos2 {
    let (middle, _) = outline(&window.state().model.scene, 0, bubble).unwrap();
    let rect = window.state().picture.unwrap().rect;
    rect.center() + rect.height() * vec2(middle.x as f32, -middle.y as f32)
}

/// Clicks at a place with keys held.
fn click_at(window: &mut Harness<'static, State>, pos: Pos2, modifiers: Modifiers) {
    window.event(egui::Event::PointerMoved(pos));
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        window.event_modifiers(egui::Event::PointerButton { pos, button, pressed, modifiers }, modifiers);
    }
    window.run();
}

fn pull(window: &mut Harness<'static, State>, name: &str, by: egui::Vec2) {
    let at = window.get_by_label(name).rect().center();
    window.drag_at(at);
    window.run();
    for part in [0.3, 0.7, 1.0] {
        window.hover_at(at + part * by);
        window.run();
    }
    window.drop_at(at + by);
    window.run();
}

fn centers(window: &Harness<'static, State>) -> Vec<DVec3> {
    window.state().model.scene.bubbles.iter().map(|bubble| bubble.center_m.into()).collect()
}

#[test]
fn clicks_with_a_key_select_several() {
    let mut window = trio();
    for (bubble, modifiers, selection) in [
        (1, Modifiers::SHIFT, vec![1]),
        (2, Modifiers::SHIFT, vec![1, 2]),
        (0, Modifiers::COMMAND, vec![0, 1, 2]),
        (2, Modifiers::SHIFT, vec![0, 1]),
        (2, Modifiers::NONE, vec![2]),
    ] {
        let at = place(&window, bubble);
        // The gizmo stands in the middle of the bubble that was clicked last.
        click_at(&mut window, at + vec2(0.0, 24.0), modifiers);
        assert_eq!(window.state().model.selection(), selection, "{bubble} {modifiers:?}");
    }
    press(&mut window, Modifiers::COMMAND, Key::A);
    assert_eq!(window.state().model.selection(), [0, 1, 2]);
    window.get_by_label("3 of 3");
    let beside = window.state().picture.unwrap().rect.left_bottom() + vec2(30.0, -30.0);
    click_at(&mut window, beside, Modifiers::NONE);
    assert!(window.state().model.selection().len() == 1 && !window.state().model.outlines);
    click(&mut window, "Select all");
    assert_eq!(window.state().model.selection().len(), 3);
}

#[test]
fn edits_change_all_that_are_selected_and_only_what_was_edited() {
    let mut window = trio();
    let before = Scene::clone(&window.state().model.scene);
    window.state_mut().model.select_all();
    window.run();
    set_slider(&mut window, "Stratification", -1.5);
    let expected: Vec<_> = before
        .bubbles
        .iter()
        .map(|bubble| {
            let mut bubble = bubble.clone();
            bubble.film.stratification = -1.5;
            bubble
        })
        .collect();
    assert_eq!(window.state().model.scene.bubbles, expected);
    assert_eq!(window.state().model.undo.last_name(), Some("Stratification"));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*window.state().model.scene, before);
    assert_eq!(window.state().model.undo.steps(), 0);
}

#[test]
fn values_that_differ_are_mixed_until_one_is_set() {
    let mut window = trio();
    window.state_mut().model.scene.change(|scene| {
        scene.bubbles[1].film.thickness_nm = 321.0;
        scene.bubbles[1].film.state = FilmStateName::Rest;
    });
    window.run();
    let marks = |window: &Harness<'static, State>| window.query_all_by_label_contains("—").count();
    let numbers = |window: &Harness<'static, State>, name: &str| {
        let all = window.query_all_by_role_and_label(Role::SpinButton, name);
        all.filter_map(|node| node.value()).any(|value| value.contains('—'))
    };
    assert!(marks(&window) == 0 && !numbers(&window, "Thickness"));
    window.state_mut().model.select_all();
    window.run();
    assert!(marks(&window) > 0 && numbers(&window, "Thickness") && !numbers(&window, "Stratification"));
    // The bubble that is shown is blown already; the others become so too.
    click(&mut window, "blown");
    set_slider(&mut window, "Thickness", 400.0);
    let bubbles = &window.state().model.scene.bubbles;
    let same = |bubble: &crate::scene::Bubble| (bubble.film.state, bubble.film.thickness_nm);
    assert!(bubbles.iter().all(|bubble| same(bubble) == (FilmStateName::Blown, 400.0)), "{bubbles:?}");
    assert!(!numbers(&window, "Thickness"));
    window.get_by_role_and_label(Role::Slider, "Thickness");
}

#[test]
fn all_that_are_selected_are_duplicated_and_deleted() {
    let mut window = trio();
    let before = Scene::clone(&window.state().model.scene);
    window.state_mut().model.select_all();
    press(&mut window, Modifiers::COMMAND, Key::D);
    assert_eq!(window.state().model.selection(), [3, 4, 5]);
    let centers = centers(&window);
    let way = centers[3] - centers[0];
    assert!((1..3).all(|k| (centers[3 + k] - centers[k]).distance(way) < 2e-4), "{centers:?}");
    assert_eq!(window.state().model.scene.validate(), Ok(()));
    let stir = |bubble| crate::scene::Stir { bubble, ..crate::scene::Stir::default() };
    let events = [4, 1].map(|bubble| Event { tick: 60, change: Change::Stir(stir(bubble)) });
    window.state_mut().model.edit(Edit::History(before.motion.clone().into(), events.into()));
    click(&mut window, "Delete");
    let model = &window.state().model;
    assert_eq!((&model.scene.bubbles, model.scene.events.len()), (&before.bubbles, 1));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!((window.state().model.scene.bubbles.len(), window.state().model.scene.events.len()), (6, 2));
    (0..2).for_each(|_| press(&mut window, Modifiers::COMMAND, Key::Z));
    // The camera has stepped back to show the copies, which is no step.
    let camera = window.state().model.scene.camera.clone();
    assert_eq!(*window.state().model.scene, Scene { camera, ..before });
}

#[test]
fn an_arrow_moves_a_bubble_along_its_axis_in_one_step() {
    let mut window = trio();
    assert!(window.query_by_label("Move along z").is_none(), "no bubble was clicked");
    let at = place(&window, 1);
    click_at(&mut window, at, Modifiers::NONE);
    let before = centers(&window);
    pull(&mut window, "Move along z", vec2(15.0, -60.0));
    let after = centers(&window);
    assert_eq!((after[0], after[2], after[1].x, after[1].y), (before[0], before[2], before[1].x, before[1].y));
    assert!(after[1].z > before[1].z + 1e-3, "{} {}", before[1], after[1]);
    let model = &window.state().model;
    assert_eq!((model.undo.steps(), model.undo.last_name(), model.gizmo), (1, Some("Move bubble"), None));
    assert_eq!(model.scene.events, []);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(centers(&window), before);
    // The ring takes the selected bubbles along.
    window.state_mut().model.select_all();
    window.run();
    pull(&mut window, "Move across the view", vec2(40.0, 0.0));
    let moved: Vec<_> = centers(&window).iter().zip(&before).map(|(after, before)| *after - *before).collect();
    assert!(moved[0].length() > 1e-3 && moved.iter().all(|way| way.distance(moved[0]) < 1e-9), "{moved:?}");
    assert_eq!(window.state().model.undo.steps(), 1);
}

#[test]
fn the_gizmo_moves_what_a_drag_has_moved_from_there_on() {
    let mut window = trio();
    let to_m = [0.05, 0.0, 0.02];
    let drag = Change::Drag(Drag { bubble: 0, to_m });
    window.state_mut().model.clock.tick = 60;
    window.state_mut().model.edit(Edit::Happens(drag));
    window.state_mut().model.clock.tick = 600;
    window.state_mut().model.outlines = true;
    window.run();
    let before = centers(&window);
    pull(&mut window, "Move along z", vec2(0.0, -40.0));
    assert_eq!(centers(&window), before);
    let [Event { tick: 60, change: Change::Drag(drag) }] = &window.state().model.scene.events[..] else {
        panic!("the same event")
    };
    assert!(drag.to_m[..2] == to_m[..2] && drag.to_m[2] > to_m[2] + 1e-3, "{drag:?}");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(window.state().model.scene.events, []);
}

#[test]
fn a_double_click_frames_the_bubbles_and_other_tools_have_no_gizmo() {
    let mut window = trio();
    window.state_mut().model.scene.change(|scene| scene.camera.distance_m *= 1.5);
    window.run();
    let at = place(&window, 0);
    let before = window.state().model.scene.camera.clone();
    wait_for_double_clicks(&mut window);
    for _ in 0..2 {
        window.drag_at(at);
        window.drop_at(at);
    }
    window.run();
    assert_ne!(window.state().model.scene.camera.distance_m, before.distance_m);
    assert!(window.query_by_label("Move along z").is_some());
    click(&mut window, "Stir");
    assert!(window.query_by_label("Move along z").is_none());
}

#[test]
fn a_bubble_on_a_bath_keeps_its_height() {
    let mut window = harness(Model::new(load_scene("bath").unwrap()), vec2(1280.0, 1200.0));
    window.state_mut().model.clock.running = false;
    window.state_mut().model.outlines = true;
    window.run();
    assert!(window.query_by_label("Move along z").is_none());
    let before = centers(&window)[0];
    pull(&mut window, "Move across the view", vec2(40.0, 20.0));
    let after = centers(&window)[0];
    assert!(after.z == before.z && after.distance(before) > 1e-3, "{before} {after}");
}

#[test]
fn the_tool_that_moves_takes_all_selected_along() {
    let mut window = trio();
    window.state_mut().model.select_all();
    window.state_mut().model.tool = Tool::Drag;
    let before = centers(&window);
    window.run();
    let at = place(&window, 1) + vec2(0.0, 24.0);
    window.drag_at(at);
    window.run();
    for step in 1..=3 {
        window.state_mut().model.clock.tick += 60;
        window.hover_at(at + vec2(20.0 * step as f32, 0.0));
        window.run();
    }
    window.drop_at(at + vec2(60.0, 0.0));
    window.run();
    let model = &window.state().model;
    let ways: Vec<_> = (0..3).map(|bubble| model.put_m(bubble) - before[bubble]).collect();
    assert!(ways[1].length() > 1e-3 && ways.iter().all(|way| way.distance(ways[1]) < 1e-6), "{ways:?}");
    assert_eq!((model.undo.steps(), model.scene.validate()), (1, Ok(())));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(window.state().model.scene.events, []);
}

#[test]
fn a_bubble_that_is_added_beside_the_picture_is_brought_into_it() {
    let mut model = model();
    let still = crate::app::orbit::Gesture::default();
    let before_m = model.scene.camera.distance_m;
    model.add_bubble(model.scene.bubbles[0].clone());
    model.move_camera(&still, 1.2);
    assert!(model.scene.camera.distance_m > before_m, "both are seen");
    let both = model.scene.camera.clone();
    model.move_camera(&still, 1.2);
    assert_eq!(model.scene.camera, both, "once");
    model.delete_bubbles();
    model.move_camera(&still, 1.2);
    assert_eq!(model.scene.camera, both);
}

#[test]
fn the_wand_blows_a_bubble_where_the_pointer_draws_it() {
    let mut window = trio();
    press(&mut window, Modifiers::NONE, Key::Num9);
    let rect = window.state().picture.unwrap().rect;
    let from = rect.center() + vec2(0.0, 0.3 * rect.height());
    window.drag_at(from);
    window.step();
    for side in [10.0, 30.0, 60.0] {
        window.hover_at(from + vec2(side, 0.0));
        window.step();
    }
    assert!(window.state().model.wand.is_some() && window.state().model.scene.bubbles.len() == 3);
    window.drop_at(from + vec2(60.0, 0.0));
    window.run();
    let model = &window.state().model;
    assert_eq!((model.scene.bubbles.len(), model.selected, model.wand), (4, 3, None));
    let (middle, radius) = crate::app::tools::outline(&model.scene, 0, 3).unwrap();
    let height = f64::from(rect.height());
    // A sphere's outline is a little larger than its great circle.
    assert!((middle.y + 0.3).abs() < 2e-3 && (radius * height - 60.0).abs() < 3.0, "{middle} {}", radius * height);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(window.state().model.scene.bubbles.len(), 3);
}
