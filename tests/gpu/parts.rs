//! Parts of pictures on the GPU: photographs behind bubbles, and rectangles of a picture.

use std::sync::Arc;

use glam::DVec3;
use soapfilm::{
    input::LoadedScene,
    physics::picture::Plate,
    plan::{FrameRequest, TonemapKey},
    scene::FilmStateName,
    verify::reference,
};

use crate::support::{load, mean_and_max, radiance, renderer, still};

/// A bubble of one thickness before a photograph of many colours.
fn plated(preset: &str) -> LoadedScene {
    let mut loaded = load(preset);
    loaded.scene.bubbles[0].film.state = FilmStateName::Uniform;
    loaded.scene.view.plate = Some("plate.png".to_owned());
    let colour = |k: usize| [(k % 16) as f32 / 15.0, (k / 16) as f32 / 8.0, ((7 * k) % 5) as f32 / 4.0];
    loaded.resources.plate = Plate::new([16, 9], (0..16 * 9).map(colour).collect()).map(Arc::new);
    loaded
}

#[test]
fn a_photograph_is_seen_through_films_as_in_f64() {
    let Some(mut renderer) = renderer() else { return };
    // On a bath, and in light whose red is faint in blue.
    for (preset, illuminant) in [("bath", "D65"), ("tent", "sodium")] {
        let mut loaded = plated(preset);
        loaded.resources.illuminant = Arc::new(illuminant.parse().unwrap());
        let mut request = still(&loaded, [64, 36], 0.0);
        // The reference has no foot.
        request.picture.draw.bubbles[0].bodies.clear();
        let seen = radiance(&mut renderer, &request);
        let truth = reference::radiance(&request.picture.draw, &Default::default(), &|| ()).unwrap();
        let errors = seen.iter().zip(&truth).map(|(a, b)| (*a - *b).abs().max_element());
        let (mean, max) = mean_and_max(errors);
        eprintln!("measured: {preset}, {illuminant}: mean error {mean:.5}, at most {max:.4}");
        // Beside the bubble both show the photograph; at its outline a pixel is the mean of few samples here, and of many there.
        assert!(mean < 1e-3, "{preset}, {illuminant}: {mean}");
        let corner = (seen[0] - truth[0]).abs().max_element();
        assert!(corner < 1e-5, "{preset}, {illuminant}: {corner}");
    }
}

#[test]
fn rectangles_of_a_picture_are_what_the_picture_shows_there() {
    let Some(mut renderer) = renderer() else { return };
    let request = still(&plated("tent"), [64, 36], 0.0);
    let whole = radiance(&mut renderer, &request);
    for (columns, rows) in [(0..20, 0..36), (20..64, 3..17), (31..33, 17..19)] {
        let draw = request.picture.draw.cut(&columns, &rows);
        let part = FrameRequest { picture: TonemapKey { draw, ..request.picture.clone() }, ..request.clone() };
        let part = radiance(&mut renderer, &part);
        let places = rows.clone().flat_map(|y| columns.clone().map(move |x| (y * 64 + x) as usize));
        let errors = places.zip(part).map(|(place, seen): (usize, DVec3)| (seen - whole[place]).abs().max_element());
        let (_, max) = mean_and_max(errors);
        eprintln!("measured: columns {columns:?}, rows {rows:?}: {max:.2e}");
        // Rays differ by the rounding of f32, which mirrors magnify.
        assert!(max < 1e-5, "columns {columns:?}, rows {rows:?}: {max}");
    }
}
