//! A camera that keyframes move.

use glam::DVec2;

use super::*;
use crate::scene::{Camera, Ease, Keyframe, Lens};

/// A stirred film, and a camera that goes around and away.
fn moved_scene() -> Scene {
    let key = |time_s: f64, azimuth_deg: f64, distance_m: f64| Keyframe {
        time_s,
        azimuth_deg: Some(azimuth_deg),
        distance_m: Some(distance_m),
        ..Keyframe::default()
    };
    let mut scene = stirred_scene();
    scene.camera.keyframes = vec![key(0.05, 10.0, 0.3), key(0.2, 370.0, 0.6)];
    scene
}

/// The scene with a camera that stands where keyframes have it at a time.
fn standing(scene: &Scene, time_s: f64) -> Scene {
    Scene { camera: scene.camera.at(time_s), ..scene.clone() }
}

#[test]
fn a_picture_is_that_of_the_camera_at_its_moment() {
    let mut scene = moved_scene();
    scene.lens = Lens { aperture_mm: 5.0, ..Lens::default() };
    settle_detail(&mut scene);
    let story = Story::new(scene.clone());
    for (tick, fraction) in [(0, 0.0), (3, 0.0), (5, 0.0), (5, 0.5), (12, 0.0), (99, 0.0)] {
        let shot = Shot { moment: Moment { tick, fraction }, ..shot(0, Pace::Whole) };
        let time_s = shot.moment.ticks() * scene.motion.tick_s;
        let seen = story.request(&resources(), &shot).unwrap().picture;
        let stood = request(&standing(&scene, time_s), &resources(), &shot).unwrap().picture;
        assert!(seen == stood, "tick {tick} + {fraction}");
        assert_eq!(seen.draw.camera.eye_m, scene.camera.at(time_s).eye());
        let from = story.request_from(&Camera::default(), &resources(), &shot).unwrap().picture;
        assert_eq!(from.draw.camera.eye_m, Camera::default().eye());
    }
}

#[test]
fn a_camera_that_moves_by_keyframes_draws_a_film_at_rest_anew_and_nothing_else() {
    let mut scene = moved_scene();
    scene.motion.flow = Flow::Rest;
    assert_eq!(between((&scene, 5), (&scene, 6)), ["draw", "tonemap"]);
    assert_eq!(between((&scene, 500), (&scene, 600)), [] as [&str; 0], "it stands after the last keyframe");
}

#[test]
fn what_the_camera_passes_is_in_sight_when_it_does() {
    let mut scene = moved_scene();
    // On the left of a camera at +x that looks along the horizon, and in the middle after a quarter turn.
    scene.bubbles.push(Bubble { center_m: [0.0, -2.0, 0.0], ..Bubble::default() });
    scene.camera = Camera { elevation_deg: 0.0, ..scene.camera };
    let key = |time_s, azimuth_deg| Keyframe {
        time_s,
        azimuth_deg: Some(azimuth_deg),
        ease: Ease::Hold,
        ..Keyframe::default()
    };
    scene.camera.keyframes = vec![key(0.0, 0.0), key(0.1, 90.0)];
    let seen = |tick| {
        let bubbles = frame_request(&scene, tick, Pace::Whole).picture.draw.bubbles;
        bubbles.iter().map(|bubble| bubble.index).collect::<Vec<_>>()
    };
    assert_eq!([0, 5, 6, 600].map(seen), [vec![0], vec![0], vec![1, 0], vec![1, 0]]);
}

#[test]
fn a_film_is_as_fine_as_the_nearest_keyframe_asks_for() {
    let mut scene = preset("tent").unwrap();
    let grids = |scene: &Scene| film_grids(scene, 0);
    scene.camera.distance_m = 20.0;
    assert_eq!(grids(&scene), [128, 32]);
    let key = |time_s, distance_m| Keyframe { time_s, distance_m: Some(distance_m), ..Keyframe::default() };
    scene.camera.keyframes = vec![key(0.0, 30.0), key(4.0, 0.24), key(5.0, 30.0)];
    assert_eq!(grids(&scene), [256, 64]);
    scene.camera.distance_m = 0.24;
    scene.camera.keyframes.remove(1);
    assert_eq!(grids(&scene), [128, 32], "the camera is never where `[camera]` has it");
}

#[test]
fn a_camera_that_goes_below_a_bath_is_refused_with_the_time() {
    let mut scene = preset("bath").unwrap();
    let key = |time_s, elevation_deg| Keyframe { time_s, elevation_deg: Some(elevation_deg), ..Keyframe::default() };
    scene.camera.keyframes = vec![key(0.0, 30.0), key(1.0, -30.0)];
    assert!(request(&scene, &resources(), &shot(0, Pace::Whole)).is_ok());
    let error = request(&scene, &resources(), &shot(60, Pace::Whole)).unwrap_err().to_string();
    assert!(error.contains("at 1.00 s; raise it, or `target_m`, in the keyframes"), "{error}");
}

#[test]
fn through_the_edge_of_a_lens_the_focus_stays_and_what_is_behind_it_moves() {
    let mut scene = uniform_scene();
    scene.camera = Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance_m: 0.5, ..Camera::default() };
    let bubble = |x_m: f64| Bubble { center_m: [x_m, 0.0, 0.0], radius_mm: 5.0, ..scene.bubbles[0].clone() };
    // In focus, and twice as far away.
    scene.bubbles = vec![bubble(0.0), bubble(-0.5)];
    let story = Story::new(scene);
    let through = |offset_m: DVec2| {
        let lens = LensSample { offset_m, ..LensSample::MIDDLE };
        story.request_through(&lens, &resources(), &shot(0, Pace::Whole)).unwrap().picture.draw
    };
    let offset_m = DVec2::new(0.01, 0.004);
    let (middle, edge) = (through(DVec2::ZERO), through(offset_m));
    let place = |draw: &DrawKey, index: usize| {
        let bubble = draw.bubbles.iter().find(|bubble| bubble.index == index).unwrap();
        let from_eye = bubble.center_m - draw.camera.eye_m;
        let across = DVec2::new(from_eye.dot(draw.camera.right), -from_eye.dot(draw.camera.up));
        let pixels = across / from_eye.dot(draw.camera.forward) / draw.camera.pixel_height_m;
        // The middle of the outline's rectangle, of which clip coordinates point up.
        let of_outline = 0.5 * (bubble.bounds[0] + bubble.bounds[1]) * DVec2::new(32.0, -18.0);
        assert!(of_outline.distance(pixels + draw.camera.shift) < 0.01, "{of_outline}");
        pixels + draw.camera.shift
    };
    assert!(place(&middle, 0).distance(place(&edge, 0)) < 1e-9);
    let moved = place(&edge, 1) - place(&middle, 1);
    let expected = DVec2::new(offset_m.x, -offset_m.y) * (1.0 / 0.5 - 1.0) / middle.camera.pixel_height_m;
    assert!(moved.distance(expected) < 1e-9, "{moved} {expected}");
}

#[test]
fn a_circle_of_confusion_is_as_wide_as_the_edge_of_the_lens_moves_a_bubble() {
    let mut scene = uniform_scene();
    scene.camera = Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance_m: 0.5, ..Camera::default() };
    scene.lens.aperture_mm = 40.0;
    let bubble = |x_m: f64| Bubble { center_m: [x_m, 0.0, 0.0], radius_mm: 10.0, ..scene.bubbles[0].clone() };
    // A little before the depth in focus, twice as deep, and before the eye.
    scene.bubbles = vec![bubble(0.002), bubble(-0.5), bubble(0.488)];
    let story = Story::new(scene);
    let draw = |lens: LensSample| {
        let shot = Shot { size: [1280, 720], ..shot(0, Pace::Whole) };
        story.request_through(&lens, &resources(), &shot).unwrap().picture.draw
    };
    let confusion = |draw: &DrawKey, index: usize| {
        let bubble = draw.bubbles.iter().find(|bubble| bubble.index == index).unwrap();
        draw.camera.confusion_pixels(bubble.center_m, bubble.radius_m)
    };
    let (whole, one_of_100) = (draw(LensSample::MIDDLE), draw(LensSample { defocus: 0.1, ..LensSample::MIDDLE }));
    // Where the bubble's nearer quarter is.
    let expected = 0.02 * (1.0 / 0.5 - 1.0 / 0.9975) / whole.camera.pixel_height_m;
    assert_eq!(confusion(&whole, 0), 0.0);
    assert!((confusion(&whole, 1) / expected - 1.0).abs() < 1e-12, "{} {expected}", confusion(&whole, 1));
    assert!((confusion(&one_of_100, 1) / expected - 0.1).abs() < 1e-12);
    assert_eq!(confusion(&whole, 2), 0.0, "its walls have no one depth");
    let sharp = draw(LensSample { blurs_bubbles: false, ..LensSample::MIDDLE });
    assert_eq!(confusion(&sharp, 1), 0.0);
    // What it is blurred over counts as its own.
    let height = |draw: &DrawKey| {
        let bubble = draw.bubbles.iter().find(|bubble| bubble.index == 1).unwrap();
        360.0 * (bubble.bounds[1].y - bubble.bounds[0].y)
    };
    assert!((height(&whole) - height(&sharp) - 2.0 * expected).abs() < 1e-6);
}

#[test]
fn a_preview_shows_the_same_with_half_as_many_pixels_a_side_and_has_its_films_ready_for_the_picture() {
    let whole = frame_request(&stirred_scene(), 0, Pace::Whole);
    let preview = FrameRequest { picture: whole.picture.preview().unwrap(), ..whole.clone() };
    let (draw, full) = (&preview.picture.draw, &whole.picture.draw);
    assert_eq!((draw.rendering, draw.size), (Rendering::Preview, [32, 18]));
    assert_eq!(draw.camera.corners(draw.size, 0.0), full.camera.corners(full.size, 0.0));
    assert_eq!(draw.bubbles, full.bubbles, "the shaders follow from them");
    let first = plan(&preview, &GpuState::default());
    let second = plan(&whole, &first.after);
    assert!(names(&first).contains(&"seed_field"), "{first}");
    assert_eq!(names(&second), ["draw", "tonemap"], "{second}");
}
