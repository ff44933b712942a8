//! Bubbles whose film is finer than pixels.

use glam::{DVec2, DVec3};
use soapfilm::{
    gpu::Renderer,
    input::LoadedScene,
    physics::colour::{BT2020, Lab, ciede2000, xyz_to_lab},
    plan::FrameRequest,
    scene::{Backdrop, Camera, Detail, FilmStateName, Flow, Scene},
    verify::reference,
};

use crate::support::{load, mean_and_max, radiance, renderer, short_or_long, still};

const SIZE: [u32; 2] = [64, 64];
const FOV_Y_DEG: f64 = 9.0;

/// Pixels across the bubble.
fn diameters() -> &'static [f64] {
    short_or_long(&[10.0, 40.0], &[10.0, 20.0, 40.0])
}

/// The picture with each bubble's samples, and the thicknesses that each is the mean of, as given.
fn drawn(renderer: &mut Renderer, request: &FrameRequest, samples: u32, thicknesses: u32) -> Vec<DVec3> {
    let mut request = request.clone();
    for bubble in &mut request.picture.draw.bubbles {
        (bubble.samples, bubble.thicknesses) = (samples, thicknesses);
    }
    radiance(renderer, &request)
}

/// The picture with three times as many samples along a pixel's side.
fn truth(renderer: &mut Renderer, request: &FrameRequest) -> Vec<DVec3> {
    drawn(renderer, request, 3 * request.picture.draw.bubbles[0].samples, 1)
}

/// Pixels whose middle the bubble covers.
fn covered(request: &FrameRequest) -> Vec<usize> {
    let key = &request.picture.draw;
    let bubble = &key.bubbles[0];
    let offset = bubble.center_m - key.camera.eye_m;
    let is_covered = |k: &usize| {
        let position = DVec2::new((*k as u32 % SIZE[0]) as f64 + 0.5, (*k as u32 / SIZE[0]) as f64 + 0.5);
        let ray = reference::camera(&key.camera).ray(SIZE, position);
        offset.reject_from_normalized(ray).length() < bubble.radius_m
    };
    (0..(SIZE[0] * SIZE[1]) as usize).filter(is_covered).collect()
}

/// Y of a picture's brightest pixel.
fn brightest(picture: &[DVec3]) -> f64 {
    picture.iter().map(|pixel| (BT2020.to_xyz() * *pixel).y).fold(f64::MIN_POSITIVE, f64::max)
}

/// A pixel's colour where that Y is white's.
fn lab(pixel: DVec3, brightest: f64) -> Lab {
    xyz_to_lab(BT2020.to_xyz() * pixel / brightest, BT2020.to_xyz() * DVec3::ONE)
}

/// Colour differences (CIEDE2000) of the pixels that the bubble covers, the truth's brightest at Y = 1.
fn differences(request: &FrameRequest, truth: &[DVec3], seen: &[DVec3]) -> Vec<f64> {
    let white = brightest(truth);
    covered(request).into_iter().map(|k| ciede2000(lab(truth[k], white), lab(seen[k], white))).collect()
}

/// Looks at a bubble of the default size from where it is `diameter` pixels across; returns the span of a pixel there, in m.
fn step_back(scene: &mut Scene, diameter: f64) -> f64 {
    let pixel_m = 0.1 / diameter;
    let distance_m = pixel_m * f64::from(SIZE[1]) / (2.0 * (0.5 * FOV_Y_DEG).to_radians().tan());
    scene.camera = Camera { distance_m, fov_y_deg: FOV_Y_DEG, elevation_deg: 0.0, ..Camera::default() };
    pixel_m
}

/// A film sorted from 300 to 3000 nm.
fn sorted() -> LoadedScene {
    let mut loaded = load("tent");
    loaded.scene.motion.flow = Flow::Rest;
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    let film = &mut loaded.scene.bubbles[0].film;
    (film.state, film.thickness_nm, film.stratification, film.cells) = (FilmStateName::Rest, 1170.0, 1.15, 128);
    loaded
}

/// A far bubble, sorted from 300 to 3000 nm and moved by parts of a pixel.
#[test]
fn far_bubbles_do_not_sparkle() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = sorted();
    for diameter in diameters().iter().copied() {
        let pixel_m = step_back(&mut loaded.scene, diameter);
        let mut errors = Vec::new();
        for tenths in [3.0, 7.0, 0.0].into_iter().take(short_or_long(2, 3)) {
            loaded.scene.bubbles[0].center_m = [0.0, 0.0, 0.1 * tenths * pixel_m];
            let request = still(&loaded, SIZE, 0.0);
            errors.extend(differences(&request, &truth(&mut renderer, &request), &radiance(&mut renderer, &request)));
        }
        let (mean, max) = mean_and_max(errors);
        eprintln!("measured: sorted film, {diameter} pixels across: dE2000 mean {mean:.3}, max {max:.3}");
        assert!(mean <= 0.2 && max <= 3.0, "{diameter}: {mean} {max}");
    }
}

/// Where a pixel is one sample and spans more than a cell, means over thicknesses make the picture more accurate.
#[test]
fn means_over_thicknesses_are_nearer_to_the_truth() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = sorted();
    step_back(&mut loaded.scene, 60.0);
    let request = still(&loaded, SIZE, 0.0);
    let truth = drawn(&mut renderer, &request, 12, 1);
    let [plain, two, four] = [1, 2, 4].map(|thicknesses| {
        mean_and_max(differences(&request, &truth, &drawn(&mut renderer, &request, 1, thicknesses)))
    });
    eprintln!(
        "measured: one sample a pixel: dE2000 {plain:.3?} of one thickness, {two:.3?} of two, {four:.3?} of four"
    );
    assert!(four.0 <= 0.9 * plain.0 && four.0 <= two.0 && two.0 <= plain.0, "{plain:?} {two:?} {four:?}");
}

/// How far a bubble drifts across the picture from one frame to the next, in pixels.
const DRIFT_PIXELS: [f64; 2] = [0.31, 0.17];

/// What changes from frame to frame, in CIELAB: the mean of the truth's changes; mean and maximum of what the device's differ from them.
#[derive(Debug)]
struct Changes {
    truth: f64,
    excess: f64,
    max: f64,
}

fn changes(renderer: &mut Renderer, loaded: &mut LoadedScene, diameter: f64, time_s: f64) -> Changes {
    let pixel_m = step_back(&mut loaded.scene, diameter);
    let (mut before, mut white) = (None, None);
    let (mut truths, mut excesses) = (Vec::new(), Vec::new());
    for frame in 0..short_or_long(3, 6) {
        let [right, up] = DRIFT_PIXELS.map(|pixels| f64::from(frame) * pixels * pixel_m);
        loaded.scene.bubbles[0].center_m = [0.0, right, up];
        let request = still(loaded, SIZE, time_s);
        let pictures = [truth(renderer, &request), radiance(renderer, &request)];
        let white = *white.get_or_insert(brightest(&pictures[0]));
        let colours = pictures.map(|picture| picture.into_iter().map(|pixel| lab(pixel, white)).collect::<Vec<_>>());
        if let Some(before) = before.replace(colours.clone()) {
            for k in covered(&request) {
                let [truth, seen] = [0, 1].map(|which| change(&before[which][k], &colours[which][k]));
                truths.push(truth.length());
                excesses.push(seen.distance(truth));
            }
        }
    }
    let (excess, max) = mean_and_max(excesses);
    Changes { truth: mean_and_max(truths).0, excess, max }
}

fn change(from: &Lab, to: &Lab) -> DVec3 {
    DVec3::new(to.l - from.l, to.a - from.a, to.b - from.b)
}

/// Freshly blown, and a second later, when gravity has drawn the patches out.
#[test]
fn far_blown_bubbles_change_little_more_than_the_truth() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("tent");
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    for time_s in [0.0, 1.0].into_iter().take(short_or_long(1, 2)) {
        for diameter in diameters().iter().copied() {
            let changes = changes(&mut renderer, &mut loaded, diameter, time_s);
            eprintln!("measured: {time_s} s, {diameter} pixels across: {changes:.3?} from frame to frame");
            let Changes { truth, excess, max } = changes;
            assert!(excess <= 0.1 * truth && max <= 20.0, "{time_s} s, {diameter}: {changes:?}");
        }
    }
}

/// A blown film with all of its cells, or with half, seen from where the bubble is `diameter` pixels across.
fn blown(detail: Detail, diameter: f64, time_s: f64) -> FrameRequest {
    let mut loaded = load("tent");
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    loaded.scene.bubbles[0].film.detail = detail;
    step_back(&mut loaded.scene, diameter);
    still(&loaded, SIZE, time_s)
}

/// A film on coarser grids: as blown within the limits of a far bubble that is sorted, and a little later within a tenth of what the next tick
/// changes, as far bubbles that drift must be.
#[test]
fn a_far_bubble_with_half_of_the_cells_looks_the_same() {
    let (Some(mut full), Some(mut half)) = (renderer(), renderer()) else { return };
    for (time_s, limits) in [(0.0, Some([0.2, 3.0])), (0.1, None)] {
        for diameter in diameters().iter().copied() {
            let request = blown(Detail::Full, diameter, time_s);
            let truth = radiance(&mut full, &request);
            let seen = radiance(&mut half, &blown(Detail::Half, diameter, time_s));
            let (mean, max) = mean_and_max(differences(&request, &truth, &seen));
            let next = limits.is_none().then(|| {
                let next = radiance(&mut full, &blown(Detail::Full, diameter, time_s + 1.0 / 60.0));
                mean_and_max(differences(&request, &truth, &next)).0
            });
            eprintln!(
                "measured: half of the cells, {time_s} s, {diameter} pixels across: dE2000 mean {mean:.3}, max {max:.3}; the next tick {next:.3?}"
            );
            if let Some([mean_limit, max_limit]) = limits {
                assert!(mean <= mean_limit && max <= max_limit, "{time_s} s, {diameter}: {mean} {max}");
            }
            assert!(next.is_none_or(|next| mean <= 0.1 * next), "{time_s} s, {diameter}: {mean} {next:?}");
        }
    }
}

/// Mean and spread of the colours of a bubble in CIELAB, where white has the Y given.
fn colours(request: &FrameRequest, picture: &[DVec3], white: f64) -> [DVec3; 2] {
    let black = Lab { l: 0.0, a: 0.0, b: 0.0 };
    let colours: Vec<DVec3> = covered(request).into_iter().map(|k| change(&black, &lab(picture[k], white))).collect();
    let count = colours.len() as f64;
    let mean = colours.iter().sum::<DVec3>() / count;
    let variance = colours.iter().map(|colour| (*colour - mean) * (*colour - mean)).sum::<DVec3>() / count;
    [mean, DVec3::from(variance.to_array().map(f64::sqrt))]
}

/// When small differences have grown, a film on coarser grids is another one of the same kind, at a fraction of the work: the mean and the spread of
/// its colours differ by no more than the colours of films of other seeds, which at this time are 2 to 5 apart.
#[test]
fn a_film_with_half_of_the_cells_sorts_itself_alike() {
    let Some(mut renderer) = renderer() else { return };
    let (mut white, time_s) = (None, short_or_long(0.3, 1.0));
    let found = [Detail::Full, Detail::Half].map(|detail| {
        let (request, before) = (blown(detail, 40.0, time_s), renderer.counts);
        let cpu = cpu_time::ProcessTime::now();
        let picture = radiance(&mut renderer, &request);
        let cells = renderer.counts.cells_stepped - before.cells_stepped;
        let cpu_s = cpu.elapsed().as_secs_f64();
        (colours(&request, &picture, *white.get_or_insert(brightest(&picture))), cells, cpu_s)
    });
    eprintln!("measured: {time_s} s of film, mean and spread of its colours, cells moved, CPU time: {found:.3?}");
    let [(full, full_cells, _), (half, half_cells, _)] = found;
    assert_eq!(full_cells, 4 * half_cells);
    assert!((0..2).all(|k| (full[k] - half[k]).abs().max_element() <= 2.0), "{found:?}");
}
