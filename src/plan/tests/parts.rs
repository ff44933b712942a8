//! Parts of pictures, and the photograph behind them.

use glam::DVec2;

use super::*;
use crate::physics::picture::Plate;

fn plated(plate: &Arc<Plate>, size: [u32; 2]) -> FrameRequest {
    let mut scene = uniform_scene();
    scene.view.plate = Some("plate.png".to_owned());
    let resources = Resources { plate: Some(plate.clone()), ..resources() };
    request(&scene, &resources, &Shot { size, ..shot(0, Pace::Whole) }).unwrap()
}

fn photograph() -> Arc<Plate> {
    Arc::new(Plate::new([2, 1], vec![[0.1; 3], [0.9; 3]]).unwrap())
}

#[test]
fn a_photograph_is_sent_once_for_each_size() {
    let plate = photograph();
    let first = plan(&plated(&plate, [64, 36]), &GpuState::default());
    assert_eq!(names(&first).iter().filter(|name| **name == "upload_plate").count(), 1);
    assert!(plan(&plated(&plate, [64, 36]), &first.after).is_empty());
    assert_eq!(names(&plan(&plated(&plate, [32, 36]), &first.after)), ["upload_plate", "draw", "tonemap"]);
    assert_eq!(names(&plan(&plated(&photograph(), [64, 36]), &first.after)), ["upload_plate", "draw", "tonemap"]);
    let without = plan(&frame_request(&uniform_scene(), 0, Pace::Whole), &first.after);
    assert_eq!(without.after.plate, None);
}

#[test]
fn before_a_photograph_nothing_else_stands_behind() {
    let draw = plated(&photograph(), [64, 36]).picture.draw;
    assert_eq!(draw.lighting.light.backdrop, BackdropKey::Colour(DVec3::ZERO));
    assert_eq!(draw.pictures(), 2);
    assert_eq!(draw.before_black().plate, None);
    let white = draw.before_white();
    assert_eq!((white.lighting.light.gain, white.plate), (DVec3::ZERO, None));
    assert_eq!(white.lighting.light.backdrop, BackdropKey::Colour(DVec3::ONE));
    assert!(draw.without_bubbles().bubbles.is_empty() && draw.without_bubbles().plate.is_some());
}

#[test]
fn a_part_of_a_picture_keeps_its_place() {
    let draw = plated(&photograph(), [64, 36]).picture.draw;
    assert_eq!(draw.cut(&(0..64), &(0..36)), draw);
    let part = draw.cut(&(40..60), &(4..14));
    assert_eq!(part.size, [20, 10]);
    // The middle of the picture, 32 and 18, from the part's corner.
    assert_eq!(part.camera.axis(part.size), DVec2::new(-8.0, 14.0));
    let plate = part.plate.as_ref().unwrap();
    assert_eq!((plate.whole, plate.corner, plate.size), ([64, 36], [40, 4], [20, 10]));
    let pixel = |clip: DVec2, [width, height]: [u32; 2]| {
        DVec2::new(0.5 * (clip.x + 1.0) * f64::from(width), 0.5 * (1.0 - clip.y) * f64::from(height))
    };
    for (part_of, whole) in part.bubbles[0].bounds.iter().zip(draw.bubbles[0].bounds) {
        let moved = pixel(*part_of, part.size) + DVec2::new(40.0, 4.0);
        assert!(moved.abs_diff_eq(pixel(whole, draw.size), 1e-9), "{moved}");
    }
    assert_eq!(part.cut(&(5..10), &(2..6)), draw.cut(&(45..50), &(6..10)));
}
