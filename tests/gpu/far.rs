//! Bubbles whose film is finer than pixels.

use glam::{DVec2, DVec3};
use soapfilm::{
    gpu::Renderer,
    physics::colour::{BT2020, ciede2000, xyz_to_lab},
    plan::Want,
    scene::{Backdrop, Camera, FilmStateName, Flow},
    verify::reference,
};

use crate::support::{load, mean_and_max, radiance, renderer, still};

const SIZE: [u32; 2] = [64, 64];
const FOV_Y_DEG: f64 = 9.0;
/// Pixels across the bubble.
const DIAMETERS: [f64; 3] = [10.0, 20.0, 40.0];

/// The picture with each bubble's samples and filter as given.
fn drawn(renderer: &mut Renderer, want: &Want, samples: Option<u32>, filtered: bool) -> Vec<DVec3> {
    let mut want = want.clone();
    for bubble in &mut want.picture.draw.bubbles {
        (bubble.samples, bubble.filtered) = (samples.unwrap_or(bubble.samples), filtered);
    }
    radiance(renderer, &want)
}

/// Colour differences (CIEDE2000) of the pixels whose middle the bubble covers, the truth's brightest at Y = 1.
fn differences(want: &Want, truth: &[DVec3], seen: &[DVec3]) -> Vec<f64> {
    let key = &want.picture.draw;
    let bubble = &key.bubbles[0];
    let offset = bubble.centre_m - key.camera.eye_m;
    let covered = |k: usize| {
        let position = DVec2::new((k as u32 % SIZE[0]) as f64 + 0.5, (k as u32 / SIZE[0]) as f64 + 0.5);
        let ray = reference::camera(&key.camera).ray(SIZE, position);
        offset.reject_from_normalized(ray).length() < bubble.radius_m
    };
    let to_xyz = BT2020.to_xyz();
    let brightest = truth.iter().map(|pixel| (to_xyz * *pixel).y).fold(f64::MIN_POSITIVE, f64::max);
    let lab = |pixel: &DVec3| xyz_to_lab(to_xyz * *pixel / brightest, to_xyz * DVec3::ONE);
    (0..truth.len()).filter(|k| covered(*k)).map(|k| ciede2000(lab(&truth[k]), lab(&seen[k]))).collect()
}

/// A far bubble, sorted from 300 to 3000 nm, moved by parts of a pixel, against 16 x 16 samples of each pixel: nothing sparkles, and
/// filtering the thickness over each sample brings it nearer. (Patches much finer than pixels stay further off, filtered or not.)
#[test]
fn far_bubbles_do_not_sparkle() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("default");
    loaded.scene.motion.flow = Flow::Rest;
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    let film = &mut loaded.scene.bubbles[0].film;
    (film.state, film.thickness_nm, film.stratification, film.cells) = (FilmStateName::Rest, 1170.0, 1.15, 128);
    for diameter in DIAMETERS {
        let pixel_m = 0.1 / diameter;
        let distance_m = pixel_m * f64::from(SIZE[1]) / (2.0 * (0.5 * FOV_Y_DEG).to_radians().tan());
        loaded.scene.camera = Camera { distance_m, fov_y_deg: FOV_Y_DEG, elevation_deg: 0.0, ..Camera::default() };
        let mut errors = [Vec::new(), Vec::new()];
        for tenths in [0.0, 3.0, 7.0] {
            loaded.scene.bubbles[0].center_m = [0.0, 0.0, 0.1 * tenths * pixel_m];
            let want = still(&loaded, SIZE, 0.0);
            let truth = drawn(&mut renderer, &want, Some(16), false);
            for (filtered, errors) in [false, true].into_iter().zip(&mut errors) {
                errors.extend(differences(&want, &truth, &drawn(&mut renderer, &want, None, filtered)));
            }
        }
        let [plain, filtered] = errors.map(mean_and_max);
        eprintln!("measured: {diameter} pixels across: dE2000 {plain:.3?} plain, {filtered:.3?} filtered");
        assert!(filtered.0 <= 0.2 && filtered.1 <= 3.0, "{diameter}: {filtered:?}");
        assert!(filtered.0 <= plain.0, "{diameter}: {filtered:?} is no better than {plain:?}");
    }
}
