//! What a lens makes of a picture.

use std::path::Path;

use glam::DVec3;
use soapfilm::{
    input::LoadedScene,
    physics::colour::{Display, Gamut},
    plan::{LensSample, Moment, Pace, Shot, Story},
    scene::{Backdrop, Lens, Light, Scene},
};

use crate::support::{display, load, mean_and_max, radiance, renderer, still};

const SIZE: [u32; 2] = [64, 36];

/// The default scene without its bubble, behind which the park is out of focus, against rays from all over a flat lens through the plane in focus
/// into the sharp environment.
#[test]
fn a_far_background_is_that_of_rays_through_a_lens() {
    const RAYS: u32 = 3000;
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("default");
    loaded.scene.bubbles.clear();
    let request = still(&loaded, SIZE, 0.0);
    let seen = radiance(&mut renderer, &request);
    let camera = request.picture.draw.camera;
    let scene = &loaded.scene;
    let lens_radius = 0.5e-3 * scene.lens.aperture_mm / scene.camera.distance_m;
    // On the plane one metre before the eye, where a point of the lens shifts the whole picture.
    let through = |x: f64, y: f64| {
        let rays = (0..RAYS).map(|ray| {
            let (radius, turn) =
                (lens_radius * ((f64::from(ray) + 0.5) / f64::from(RAYS)).sqrt(), f64::from(ray) * 2.399_963);
            let (right, up) = (x + radius * turn.cos(), y + radius * turn.sin());
            loaded.resources.environment.sample(camera.forward + right * camera.right + up * camera.up)
        });
        rays.sum::<DVec3>() / f64::from(RAYS)
    };
    let pixels = (0..SIZE[0] * SIZE[1]).step_by(7);
    let errors = pixels.clone().map(|pixel| {
        let place = |at: u32, size: u32| (f64::from(at) + 0.5 - 0.5 * f64::from(size)) * camera.pixel_height_m;
        let truth = through(place(pixel % SIZE[0], SIZE[0]), -place(pixel / SIZE[0], SIZE[1]));
        (seen[pixel as usize] - truth).abs().max_element()
    });
    let (mean, worst) = mean_and_max(errors);
    let (light, brightest) = mean_and_max(seen.iter().map(|pixel| pixel.max_element()));
    eprintln!(
        "measured: defocus: mean {:.4} of the mean, worst {:.4} of the brightest",
        mean / light,
        worst / brightest
    );
    // The discs' edges are an eighth of their radius wide, and the picture's pixels a fifth.
    assert!(mean < 0.04 * light && worst < 0.12 * brightest, "{mean} of {light}, {worst} of {brightest}");
}

/// Bubbles before and behind the plane in focus, small ones of a generator too, against the mean of pictures through places all over the lens.
#[test]
fn bubbles_out_of_focus_are_those_of_rays_through_a_lens() {
    const PLACES: u32 = 49;
    let Some(mut renderer) = renderer() else { return };
    let size = [256, 144];
    let moment = Moment { tick: 0, fraction: 0.0 };
    let shot = Shot { size, moment, full_precision: true, gamut: Gamut::Srgb, pace: Pace::Whole };
    for quality in ["fast", "standard"] {
        let loaded = out_of_focus(quality);
        let story = Story::new(loaded.scene.clone());
        let mut seen = |lens: &LensSample| {
            radiance(&mut renderer, &story.request_through(lens, &loaded.resources, &shot).unwrap())
        };
        let whole = seen(&LensSample::MIDDLE);
        let sharp = seen(&LensSample { blurs_bubbles: false, ..LensSample::MIDDLE });
        let mut truth = vec![DVec3::ZERO; whole.len()];
        for k in 0..PLACES {
            let lens = LensSample::point(k, PLACES, 0.5e-3 * loaded.scene.lens.aperture_mm, 0);
            truth.iter_mut().zip(seen(&lens)).for_each(|(sum, radiance)| *sum += radiance / f64::from(PLACES));
        }
        // As they are shown: of two bright pixels nobody sees how bright they are.
        let shown = |radiance: DVec3| radiance / (1.0 + radiance);
        let error = |picture: &[DVec3]| {
            let errors = picture.iter().zip(&truth).map(|(a, b)| (shown(*a) - shown(*b)).length_squared() / 3.0);
            mean_and_max(errors).0.sqrt()
        };
        let [blurred, sharp] = [&whole, &sharp].map(|picture| error(picture));
        eprintln!("measured: bubbles out of focus, {quality}: {blurred:.4} rms of white, {sharp:.4} if they are sharp");
        assert!(blurred < 0.008 && blurred < 0.4 * sharp, "{quality}: {blurred} {sharp}");
    }
}

/// One bubble in focus, one before it, one behind it, and small ones all over.
fn out_of_focus(quality: &str) -> LoadedScene {
    let text = format!(
        "version = 1\n\
         [[bubble]]\nradius_mm = 20\n[bubble.film]\nstate = \"uniform\"\nthickness_nm = 420\n\
         [[bubble]]\nradius_mm = 14\ncenter_m = [0.2, 0.04, 0.01]\n[bubble.film]\ncells = 32\n\
         [[bubble]]\nradius_mm = 40\ncenter_m = [-0.5, -0.06, 0.05]\n[bubble.film]\ncells = 32\n\
         [[generator]]\nlayout = \"cloud\"\ncount = 40\nsize_m = [0.6, 0.3, 0.15]\nradius_mm = 4\n\
         [camera]\ndistance_m = 0.5\nazimuth_deg = 0\nelevation_deg = 0\nfov_y_deg = 22\n\
         [lens]\naperture_mm = 24\n[light]\nenvironment = \"studio\"\n\
         [view]\nquality = \"{quality}\"\nbackdrop = [0.02, 0.02, 0.02]\n"
    );
    LoadedScene::from_toml(&text, "out of focus", Path::new("")).unwrap()
}

/// In even light, a bubble vanishes out of focus too.
#[test]
fn bubbles_out_of_focus_vanish_in_a_white_furnace() {
    let Some(mut renderer) = renderer() else { return };
    for quality in ["fast", "standard", "spectral"] {
        let mut loaded = out_of_focus(quality);
        loaded.scene.light = Light { constant: Some([1.0; 3]), ..Light::default() };
        loaded.scene.view.backdrop = Backdrop::Environment;
        let loaded = LoadedScene::from_toml(&loaded.scene.to_toml(), "furnace", Path::new("")).unwrap();
        let seen = radiance(&mut renderer, &still(&loaded, [256, 144], 0.0));
        let (_, worst) = mean_and_max(seen.iter().map(|pixel| (*pixel - seen[0]).abs().max_element() / seen[0].y));
        assert!(worst < 1e-3, "{quality}: {worst}");
    }
}

/// A round lamp on black.
fn lamp(lens: &str) -> LoadedScene {
    let text = format!(
        "version = 1\nbubble = []\n[lens]\n{lens}\n[light]\nconstant = [0, 0, 0]\n[[light.lamp]]\nshape = \"disc\"\n\
         azimuth_deg = 200\nelevation_deg = -8\nwidth_deg = 5\nluminance = 0.5\n[view]\nexposure_ev = 0\nbackdrop = \"environment\"\ndither = false\n"
    );
    LoadedScene::from_toml(&text, "lamp", Path::new("")).unwrap()
}

fn linear(byte: u8) -> f64 {
    let encoded = f64::from(byte) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[test]
fn glare_spreads_light_and_keeps_its_sum() {
    let Some(mut renderer) = renderer() else { return };
    let size = [256, 192];
    let mut green = |lens: &str| -> Vec<f64> {
        let mut request = still(&lamp(lens), size, 0.0);
        request.picture.draw.full_precision = false;
        display(&mut renderer, &request).chunks(4).map(|pixel| linear(pixel[1])).collect()
    };
    let (sharp, spread, dark) = (green(""), green("glare = 0.3"), green("vignetting_ev = 1"));
    let sum = |pixels: &[f64]| pixels.iter().sum::<f64>();
    // Steps of eight bits.
    assert!((sum(&spread) / sum(&sharp) - 1.0).abs() < 0.03, "{} becomes {}", sum(&sharp), sum(&spread));
    let at = |pixels: &[f64], right: usize| pixels[96 * 256 + 128 + right];
    assert!((at(&sharp, 0) - 0.5).abs() < 0.01 && at(&sharp, 20) == 0.0);
    assert!(at(&spread, 0) < 0.49 && at(&spread, 20) > at(&spread, 40) && at(&spread, 40) > 0.0);
    // No darker in the middle.
    assert!((at(&dark, 0) - at(&sharp, 0)).abs() < 0.01 && sum(&dark) < sum(&sharp));
}

/// Glare, vignetting and grain, of a lamp near the picture's edge: within rounding of half floats, where a bright pixel's is a step of 8 bits.
#[test]
fn the_finish_of_a_picture_matches_its_f64_twin() {
    let Some(mut renderer) = renderer() else { return };
    let size = [150, 101];
    let mut request = still(&lamp("glare = 0.3\nvignetting_ev = 1.5\ngrain = 0.05"), size, 0.5);
    let sharp = radiance(&mut renderer, &request);
    request.picture.draw.full_precision = false;
    let seen = display(&mut renderer, &request);
    let key = &request.picture;
    let shown = Display { exposure_ev: key.exposure_ev, balance: key.balance, gamut: key.gamut, dither: key.dither };
    let finished = key.finish.applied(size, key.exposure_ev.exp2(), sharp);
    let truth = finished.iter().flat_map(|radiance| shown.encode(*radiance, [0, 0]));
    let seen = seen.chunks(4).flat_map(|pixel| &pixel[..3]);
    let (mean, most) = mean_and_max(seen.zip(truth).map(|(seen, truth)| f64::from(seen.abs_diff(truth))));
    eprintln!("measured: finish, levels of 8 bits: mean {mean:.4}, at most {most}");
    assert!(mean < 0.05 && most <= 1.0, "{mean} {most}");
}

#[test]
fn a_lens_is_forgotten_with_its_scene() {
    let (Some(mut used), Some(mut fresh)) = (renderer(), renderer()) else { return };
    let out_of_focus = load("default");
    let mut sharp = load("default");
    sharp.scene.lens = Lens::default();
    let moment = |loaded| still(loaded, SIZE, 0.0);
    let blurred = radiance(&mut used, &moment(&out_of_focus));
    let then = radiance(&mut used, &moment(&sharp));
    assert!(then == radiance(&mut fresh, &moment(&sharp)), "as if there had never been a lens");
    assert!(then != blurred);
}

#[test]
fn grain_is_another_in_each_moment_and_has_no_mean() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("tent");
    loaded.scene = Scene { bubbles: Vec::new(), lens: Lens { grain: 0.05, ..Lens::default() }, ..loaded.scene };
    loaded.scene.view.backdrop = Backdrop::Radiance([0.1; 3]);
    loaded.scene.view.dither = false;
    let mut picture = |time_s: f64| -> Vec<f64> {
        let mut request = still(&loaded, [128, 72], time_s);
        request.picture.draw.full_precision = false;
        display(&mut renderer, &request).chunks(4).map(|pixel| linear(pixel[1])).collect()
    };
    let (first, again, later) = (picture(0.0), picture(0.0), picture(0.5));
    assert!(first == again && first != later);
    let exposed = 0.1 * f64::exp2(loaded.scene.view.exposure_ev);
    let (mean, _) = mean_and_max(first.iter().copied());
    let (variance, _) = mean_and_max(first.iter().map(|pixel| (pixel / mean - 1.0).powi(2)));
    assert!((mean / exposed - 1.0).abs() < 0.01, "{mean} of {exposed}");
    assert!((variance.sqrt() * exposed.sqrt() / 0.05 - 1.0).abs() < 0.1, "{}", variance.sqrt());
}
