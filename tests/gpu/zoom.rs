//! Near a bubble its film is looked up at each pixel, through the flow map.

use glam::DVec3;
use soapfilm::{
    gpu::Renderer,
    input::LoadedScene,
    output::{Metadata, Picture},
    physics::colour::Gamut,
    plan::FrameRequest,
    scene::Backdrop,
};

use crate::support::{display, load, mean_and_max, radiance, renderer, still};

const SIZE: [u32; 2] = [240, 135];
const TIME_S: f64 = 3.0;

/// A stirred film of a number of cells, seen at 16 times the default size.
fn near(cells: u32) -> LoadedScene {
    let mut loaded = load("stirred");
    loaded.scene.bubbles[0].film.cells = cells;
    loaded.scene.motion.strength = 1.0;
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    loaded.scene.camera.fov_y_deg /= 16.0;
    loaded
}

fn with_lookup_per_pixel(mut request: FrameRequest, is_on: bool) -> FrameRequest {
    request.picture.draw.bubbles.iter_mut().for_each(|bubble| bubble.magnified = is_on);
    request
}

/// Pixels, and a PNG of them in the folder of test output, to be looked at.
fn picture(renderer: &mut Renderer, request: &FrameRequest, name: &str) -> Vec<DVec3> {
    let pixels = radiance(renderer, request);
    let path = format!("{}/zoom_{name}.png", env!("CARGO_TARGET_TMPDIR"));
    let seen = Picture::Display { size: SIZE, gamut: Gamut::Srgb, rgba: display(renderer, request) };
    seen.save(path.as_ref(), &Metadata::new()).unwrap();
    pixels
}

/// On the same flow at the same time, against a film of four times as many cells along an edge, both looked up at each pixel. Between
/// cells the film as shown is bilinear and errs by the second power of a cell's angle, the lookup by the fourth power or more: a quarter of
/// the error leaves room for the map's own error, which grows with the stir.
#[test]
fn a_lookup_at_each_pixel_is_nearly_as_good_as_a_finer_film() {
    let Some(mut renderer) = renderer() else { return };
    let request = still(&near(64), SIZE, TIME_S);
    assert!(request.picture.draw.bubbles[0].magnified, "at this size cells are larger than pixels");
    let [through_map, plain] = [(true, "map"), (false, "plain")]
        .map(|(is_on, name)| picture(&mut renderer, &with_lookup_per_pixel(request.clone(), is_on), name));
    let fine = with_lookup_per_pixel(still(&near(256), SIZE, TIME_S), true);
    let fine = picture(&mut renderer, &fine, "fine");
    let scale = mean_and_max(fine.iter().map(|pixel| pixel.max_element())).0;
    let error =
        |found: &[DVec3]| mean_and_max(found.iter().zip(&fine).map(|(a, b)| (*a - *b).abs().max_element() / scale));
    let (through_map, plain) = (error(&through_map), error(&plain));
    eprintln!(
        "measured: 16 times as near, 64 cells against 256, error over the mean radiance (mean, max): through the map {through_map:.4?}, plain {plain:.4?}"
    );
    assert!(through_map.0 <= 0.25 * plain.0, "{through_map:?} {plain:?}");
}
