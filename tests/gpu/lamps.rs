//! Light of several illuminants in one picture.

use std::{path::Path, sync::Arc};

use glam::DVec3;
use soapfilm::{
    input::{LoadedScene, load_environment},
    physics::{colour::Illuminant, environment::CubeMap},
    plan::SpectralLight,
    scene::{Environment, Flow, Quality},
    verify::reference,
};

use crate::support::{load, mean_and_max, radiance, renderer, short_or_long, still};

const SIZE: [u32; 2] = [96, 54];

/// Light adds up: a lamp of the scene's own illuminant, taken out of the environment, leaves the picture as it is but for the rounding of
/// half floats in the two cube maps.
#[test]
fn a_lamp_of_the_same_illuminant_changes_nothing() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("tent");
    loaded.scene.motion.flow = Flow::Rest;
    let whole = |direction: DVec3| DVec3::new(0.6, 0.5, 0.4) * (1.0 + 0.9 * direction.normalize().y);
    let share = |direction: DVec3| 0.5 + 0.5 * direction.normalize().z;
    loaded.resources.environment = Arc::new(CubeMap::from_fn(64, 1, whole));
    let alone = radiance(&mut renderer, &still(&loaded, SIZE, 0.0));
    loaded.resources.environment = Arc::new(CubeMap::from_fn(64, 1, |d| (1.0 - share(d)) * whole(d)));
    let environment = Arc::new(CubeMap::from_fn(64, 1, |d| share(d) * whole(d)));
    loaded.resources.spectral_lights =
        vec![SpectralLight { environment, illuminant: loaded.resources.illuminant.clone() }];
    let split = radiance(&mut renderer, &still(&loaded, SIZE, 0.0));
    let (_, error) = mean_and_max(alone.iter().zip(&split).map(|(a, b)| (*a - *b).abs().max_element()));
    assert!(error <= 1e-3, "{error}");
    loaded.resources.spectral_lights[0].illuminant = Arc::new("sodium".parse::<Illuminant>().unwrap());
    let other = radiance(&mut renderer, &still(&loaded, SIZE, 0.0));
    let (mean, _) = mean_and_max(alone.iter().zip(&other).map(|(a, b)| (*a - *b).abs().max_element()));
    assert!(mean > 0.01, "a lamp of another spectrum must look different: {mean}");
}

/// The preset's lamp in the tent, whose lamps are soft, against the f64 picture: the limits are as for the other presets, for filtered
/// lookups of the environment against averages over samples.
#[test]
fn the_picture_in_two_lights_matches_the_f64_picture() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("two_lights");
    loaded.scene.bubbles[0].film.cells = 64;
    loaded.scene.motion.flow = Flow::Rest;
    loaded.scene.light.environment = Environment::Tent;
    let (environment, spectral_lights) = load_environment(&loaded.scene.light, Path::new(""), &mut Vec::new()).unwrap();
    (loaded.resources.environment, loaded.resources.spectral_lights) = (environment, spectral_lights);
    // Fewer samples than pictures of this size have, the same for both.
    let frame_request = |loaded: &LoadedScene| {
        let mut request = still(loaded, SIZE, 0.0);
        request.picture.draw.bubbles[0].samples = short_or_long(2, 6);
        request
    };
    let request = frame_request(&loaded);
    assert_eq!(request.picture.draw.spectral_lights.len(), 1);
    // The f64 picture knows no qualities.
    let truth = reference::radiance(&request.picture.draw, &Default::default(), &|| ()).unwrap();
    for quality in Quality::ALL {
        loaded.scene.view.quality = quality;
        let request = frame_request(&loaded);
        let seen = radiance(&mut renderer, &request);
        let mut levels: Vec<f64> = truth.iter().map(|pixel| pixel.max_element()).collect();
        levels.sort_by(f64::total_cmp);
        let scale = levels[levels.len() * 9 / 10];
        let (mean, _) = mean_and_max(seen.iter().zip(&truth).map(|(a, b)| (*a - *b).abs().max_element() / scale));
        eprintln!("measured: GPU - f64 picture, two lights, {}: mean {mean:.5}", quality.name());
        assert!(mean <= 0.012, "{}: {mean}", quality.name());
    }
}
