//! The ends of what a scene may ask for, through whole pictures: far from the origin, hardly any film and a very dense one, light and exposures
//! of all sizes, an eye where directions lose their meaning.

use std::sync::Arc;

use glam::DVec3;
use soapfilm::{
    input::LoadedScene,
    physics::{
        colour::{BT2020, bt709_to_bt2020},
        environment::CubeMap,
    },
    plan::FrameRequest,
    scene::{Backdrop, Bubble, Camera, FilmIndexName, FilmStateName, Flow, Quality},
};

use crate::support::{display, load, mean_and_max, radiance, renderer, short_or_long, still};

const SIZE: [u32; 2] = [160, 90];

/// The preset `tent` at rest, in the light of a preset, which also stands behind it.
fn at_rest(environment: &str) -> LoadedScene {
    let mut loaded = load("tent");
    loaded.resources = load(environment).resources;
    loaded.scene.bubbles[0].film.cells = 32;
    loaded.scene.motion.flow = Flow::Rest;
    loaded.scene.view.backdrop = Backdrop::Environment;
    loaded
}

/// This picture in light that is 1 from everywhere.
fn in_a_furnace() -> LoadedScene {
    at_rest("furnace")
}

fn departure_from_white(pixels: &[DVec3]) -> f64 {
    mean_and_max(pixels.iter().map(|pixel| (*pixel - 1.0).abs().max_element())).1
}

fn still_image(loaded: &LoadedScene) -> FrameRequest {
    still(loaded, SIZE, 0.0)
}

/// A still as windows have it: half floats, then eight bits.
fn shown(loaded: &LoadedScene) -> FrameRequest {
    let mut request = still_image(loaded);
    request.picture.draw.full_precision = false;
    request.picture.draw.exposed_ev = soapfilm::plan::exposed_ev(request.picture.exposure_ev);
    request
}

#[test]
fn a_film_of_index_1_is_not_there() {
    let Some(mut renderer) = renderer() else { return };
    for quality in Quality::ALL {
        let mut loaded = in_a_furnace();
        loaded.scene.view.quality = quality;
        let film = &mut loaded.scene.bubbles[0].film;
        (film.state, film.index) = (FilmStateName::Uniform, FilmIndexName::Constant(1.0));
        let error = departure_from_white(&radiance(&mut renderer, &still_image(&loaded)));
        assert!(error <= 1e-6, "{}: {error}", quality.name());
    }
}

/// A bubble of few pixels takes the maximum of samples, and a film of 30 µm the maximum of wavelengths.
#[test]
fn no_sample_of_a_small_bubble_of_thick_film_is_lost() {
    let Some(mut renderer) = renderer() else { return };
    for quality in Quality::ALL {
        let mut loaded = in_a_furnace();
        loaded.scene.view.quality = quality;
        let film = &mut loaded.scene.bubbles[0].film;
        (film.state, film.stratification, film.thickness_nm) = (FilmStateName::Rest, -5.0, 3400.0);
        loaded.scene.camera.distance_m = 1.2;
        let error = departure_from_white(&radiance(&mut renderer, &still_image(&loaded)));
        assert!(error <= 1e-3, "{}: {error}", quality.name());
    }
}

/// A scene looks the same wherever it stands.
#[test]
fn a_small_bubble_far_from_the_origin_looks_the_same() {
    let Some(mut renderer) = renderer() else { return };
    let place = |center_m: [f64; 3]| {
        let mut loaded = at_rest("windows");
        loaded.scene.bubbles[0] = Bubble { radius_mm: 1.0, center_m, ..loaded.scene.bubbles[0].clone() };
        loaded.scene.camera = Camera { target_m: center_m, distance_m: 0.005, ..Camera::default() };
        loaded
    };
    let near = radiance(&mut renderer, &still_image(&place([0.0; 3])));
    // Places are given in binary fractions, for f64 itself holds 1000.001 only to 1e-13.
    for center_m in [[1000.0; 3], [-1000.0, 512.0, 0.25]] {
        let far = radiance(&mut renderer, &still_image(&place(center_m)));
        let (_, error) = mean_and_max(near.iter().zip(&far).map(|(a, b)| (*a - *b).abs().max_element()));
        assert!(error < 1e-4, "{center_m:?}: {error}");
    }
}

/// Light and exposure that cancel leave the picture as it was, though neither fits half floats.
#[test]
fn strong_light_and_a_dark_exposure_cancel() {
    let Some(mut renderer) = renderer() else { return };
    let picture = |renderer: &mut _, stops: f64| {
        let mut loaded = at_rest("windows");
        loaded.scene.view.dither = false;
        loaded.scene.light.intensity = (-stops).exp2();
        loaded.scene.view.exposure_ev = stops;
        display(renderer, &shown(&loaded))
    };
    let plain = picture(&mut renderer, 0.0);
    for stops in [-13.0, -8.0, 8.0, 20.0] {
        let other = picture(&mut renderer, stops);
        let max = plain.iter().zip(&other).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(max <= 1, "{stops} stops: {max} steps");
    }
}

/// The brightest light that a scene may have, at the exposure that shows it brightest and at the darkest one.
#[test]
fn the_brightest_light_is_shown_without_holes() {
    let Some(mut renderer) = renderer() else { return };
    for exposure_ev in [-20.0, 0.0, 20.0] {
        let mut loaded = in_a_furnace();
        loaded.scene.light.constant = Some([65504.0, 65504.0, 65504.0]);
        loaded.scene.light.intensity = 10000.0;
        loaded.scene.view.exposure_ev = exposure_ev;
        let pixels = display(&mut renderer, &shown(&loaded));
        assert!(pixels.iter().all(|value| *value >= 254), "{exposure_ev} EV");
    }
    let mut loaded = in_a_furnace();
    loaded.scene.light.intensity = 10000.0;
    loaded.scene.view.exposure_ev = -20.0;
    loaded.scene.view.dither = false;
    // 10000 / 2^20 = 0.0095, of sRGB 0.0254 * 255 = 24.6 levels: below the tone curve's shoulder.
    let linear = 10000.0 / 1_048_576.0_f64;
    let level = (255.0 * (1.055 * linear.powf(1.0 / 2.4) - 0.055)).round() as u8;
    let pixels = display(&mut renderer, &shown(&loaded));
    assert!(pixels.chunks(4).all(|rgba| rgba[..3].iter().all(|value| value.abs_diff(level) <= 1)), "{level} expected");
}

/// From a bubble's center no direction leads to its center; through the middle of its outline none leads away from it.
#[test]
fn an_eye_at_the_center_or_on_the_axis_sees_as_one_beside_it() {
    let Some(mut renderer) = renderer() else { return };
    for distance_m in [0.0, 0.24] {
        let mut loaded = at_rest("tent");
        let mut view = |renderer: &mut _, distance_m: f64, target_m: [f64; 3]| {
            loaded.scene.camera = Camera { distance_m, target_m, ..Camera::default() };
            // An odd size has a pixel whose ray is the axis.
            radiance(renderer, &still(&loaded, [81, 61], 0.0))
        };
        let there = view(&mut renderer, distance_m, [0.0; 3]);
        let beside = view(&mut renderer, distance_m, [1e-7, 1e-7, 1e-7]);
        assert!(there.iter().all(|pixel| pixel.is_finite()));
        let scale = mean_and_max(there.iter().map(|pixel| pixel.max_element())).1;
        let (_, error) = mean_and_max(there.iter().zip(&beside).map(|(a, b)| (*a - *b).abs().max_element() / scale));
        assert!(error < 2e-3, "{distance_m} m: {error}");
    }
}

/// A dark room with hot lamps of a few texels, in colours as saturated as a file can have.
fn hot_lamps() -> CubeMap {
    let lamps = [
        (DVec3::new(1.0, 0.4, 0.5), DVec3::new(8000.0, 60.0, 10.0)),
        (DVec3::new(-0.3, 1.0, 0.2), DVec3::new(20.0, 4000.0, 90.0)),
        (DVec3::new(-0.6, -0.7, 0.9), DVec3::new(10.0, 40.0, 9000.0)),
    ];
    let to_bt2020 = bt709_to_bt2020();
    CubeMap::from_fn(128, 1, move |direction| {
        let lit = |(towards, radiance): &(DVec3, DVec3)| {
            if direction.angle_between(*towards) < 0.03 { *radiance } else { DVec3::ZERO }
        };
        to_bt2020 * (DVec3::splat(0.02) + lamps.iter().map(lit).sum::<DVec3>())
    })
}

/// Fitted wavelengths may not take away more light than there is, not even from a dense film, whose fringes are sharp, among hot lamps.
#[test]
fn no_light_is_negative_and_qualities_agree_on_dense_films() {
    let Some(mut renderer) = renderer() else { return };
    let (xyz, lamps) = (BT2020.to_xyz(), Arc::new(hot_lamps()));
    // What differs is the light of lamps that are seen after more reflections than a quality follows.
    let limits = [(4.0, 0.06, 0.001), (1.5, 0.12, 0.04), (2.4, 0.05, 0.004)];
    for (index, fast, standard) in limits.into_iter().take(short_or_long(2, 3)) {
        let mut picture = |quality: Quality| {
            let mut loaded = at_rest("windows");
            loaded.resources.environment = lamps.clone();
            loaded.scene.view.quality = quality;
            loaded.scene.bubbles[0].film.index = FilmIndexName::Constant(index);
            radiance(&mut renderer, &still(&loaded, [96, 54], 0.0))
        };
        let truth = picture(Quality::Spectral);
        let scale = mean_and_max(truth.iter().map(|pixel| (xyz * *pixel).y)).0;
        for quality in Quality::ALL {
            let pixels = if quality == Quality::Spectral { truth.clone() } else { picture(quality) };
            let min = pixels.iter().map(|pixel| (xyz * *pixel).min_element()).fold(f64::INFINITY, f64::min);
            let (error, _) =
                mean_and_max(truth.iter().zip(&pixels).map(|(a, b)| (xyz * (*a - *b)).abs().max_element()));
            eprintln!("measured: index {index}, {}: {:.4}, min {min:.2e}", quality.name(), error / scale);
            assert!(min >= -1e-6 * scale, "index {index}, {}: {min}", quality.name());
            let limit = if quality == Quality::Fast { fast } else { standard };
            assert!(error <= limit * scale, "index {index}, {}: {}", quality.name(), error / scale);
        }
    }
}
