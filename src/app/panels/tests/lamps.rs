//! The lamps of the light, in their panel and in the picture.

use super::*;
use crate::{
    input::load_environment,
    plan::Resources,
    scene::{LampShape, LightLamp},
};

fn opened() -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    let mut window = harness(model, vec2(1280.0, 1800.0));
    window.run();
    click(&mut window, "Lamps (0)");
    window
}

/// The lamps that were asked for, as if they were loaded.
#[track_caller]
fn loaded(window: &mut Harness<'static, State>) -> Vec<LightLamp> {
    let model = &mut window.state_mut().model;
    let requests = std::mem::take(&mut model.requests);
    let [Request::LoadLight(light)] = &requests[..] else { panic!("one light: {requests:?}") };
    let (environment, _) = load_environment(light, &model.folder, &mut Vec::new()).unwrap();
    model.adopt_light(light.clone(), Resources { environment, ..model.resources.clone() });
    window.run();
    assert_eq!(window.state().model.requests, []);
    window.state().model.scene.light.lamps.clone()
}

#[test]
fn lamps_are_added_edited_and_deleted() {
    let mut window = opened();
    click(&mut window, "Add lamp");
    assert_eq!(loaded(&mut window), [LightLamp::default()]);
    for (name, value) in [("Azimuth", 40.0), ("Elevation", -20.0), ("Height", 12.0), ("Luminance", 3.0)] {
        set_slider(&mut window, name, value);
        loaded(&mut window);
    }
    click(&mut window, "strip");
    let [lamp] = &loaded(&mut window)[..] else { panic!("one lamp") };
    assert_eq!((lamp.shape, lamp.azimuth_deg, lamp.elevation_deg), (LampShape::Strip, 40.0, -20.0));
    assert_eq!((lamp.height_deg, lamp.luminance), (12.0, 3.0));
    click(&mut window, "of the illuminant");
    assert_eq!(loaded(&mut window)[0].kelvin, Some(3200.0));
    click(&mut window, "Delete lamp");
    assert_eq!(loaded(&mut window), []);
    assert_eq!(window.state().model.undo.steps(), 8);
    (0..8).for_each(|_| press(&mut window, Modifiers::COMMAND, Key::Z));
    assert_eq!(window.state().model.scene.light, model().scene.light);
}

#[test]
fn a_lamp_is_dragged_by_its_highlight_in_one_step() {
    let mut window = opened();
    press(&mut window, Modifiers::NONE, Key::Num8);
    let rect = window.state().picture.unwrap().rect;
    window.drag_at(rect.center());
    window.drop_at(rect.center());
    window.run();
    assert!(window.state_mut().model.messages.at(0.0).iter().any(|message| message.text.contains("add one")));
    click(&mut window, "Add lamp");
    loaded(&mut window);
    let camera = window.state().model.scene.camera.clone();
    // It shines from where the camera looks to, and is mirrored near the limb of the bubble; a search finds it.
    let places = (-30..=30).flat_map(|x| (-30..=30).map(move |y| vec2(x as f32, y as f32) / 70.0));
    let found = places.into_iter().find(|at| {
        let press = Press { from: glam::DVec2::new(at.x.into(), (-at.y).into()), at: glam::DVec2::ZERO };
        let model = &mut window.state_mut().model;
        let is_held = model.hold_lamp(Some(press));
        model.lamps.grip = None;
        is_held
    });
    let from = rect.center() + rect.height() * found.expect("the lamp is seen");
    window.drag_at(from);
    window.run();
    assert!(window.state().model.lamps.grip.is_some());
    window.hover_at(from + vec2(10.0, 10.0));
    window.run();
    assert_eq!(window.state().model.requests, [], "it is loaded where it is let go");
    window.drop_at(from + vec2(10.0, 10.0));
    window.run();
    let [lamp] = &loaded(&mut window)[..] else { panic!("one lamp") };
    assert!((lamp.azimuth_deg, lamp.elevation_deg) != (0.0, 30.0), "{lamp:?}");
    assert_eq!(window.state().model.scene.camera, camera, "the view stands");
    assert_eq!(window.state().model.undo.steps(), 2);
}
