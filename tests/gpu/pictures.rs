//! Pictures: what must vanish, what must stand where, and the GPU against the f64 picture.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use soapfilm::{
    gpu::Renderer,
    input::LoadedScene,
    physics::{
        environment::{CubeMap, Equirect, direction_of_uv},
        picture::PictureCamera,
    },
    plan::FrameRequest,
    scene::{Backdrop, Camera, FilmStateName, Flow, preset_names},
    verify::reference,
};

use crate::support::{display, load, mean_and_max, radiance, renderer, short_or_long, still};

const SIZE: [u32; 2] = [320, 180];

/// The preset `tent` with one uniform film, at rest, in some light that also stands behind it.
fn uniform(thickness_nm: f64, light: CubeMap) -> LoadedScene {
    let mut loaded = load("tent");
    let film = &mut loaded.scene.bubbles[0].film;
    (film.state, film.thickness_nm) = (FilmStateName::Uniform, thickness_nm);
    loaded.scene.motion.flow = Flow::Rest;
    loaded.scene.view.backdrop = Backdrop::Environment;
    loaded.resources.environment = Arc::new(light);
    loaded
}

fn even_light() -> CubeMap {
    CubeMap::constant(DVec3::ONE)
}

/// A soft lamp of some degrees in a dark room.
fn lamp(towards: DVec3, degrees: f64) -> CubeMap {
    let towards = towards.normalize();
    let radiance = move |direction: DVec3| {
        let angle = direction.angle_between(towards).to_degrees() / degrees;
        DVec3::splat(1000.0 * (-angle * angle).exp())
    };
    CubeMap::from_fn(512, 1, radiance)
}

fn camera(request: &FrameRequest) -> PictureCamera {
    let key = &request.picture.draw.camera;
    PictureCamera {
        eye_m: key.eye_m,
        forward: key.forward,
        right: key.right,
        up: key.up,
        pixel_height_m: key.pixel_height_m,
    }
}

fn pixel(pixels: &[DVec3], [width, _]: [u32; 2], x: u32, y: u32) -> DVec3 {
    pixels[(y * width + x) as usize]
}

/// Middle of the light within some pixels of a position, by brightness; and how bright its brightest pixel is.
fn highlight(pixels: &[DVec3], [width, height]: [u32; 2], at: DVec2, reach: f64) -> (DVec2, f64) {
    let positions = (0..width * height).map(|k| DVec2::new(f64::from(k % width) + 0.5, f64::from(k / width) + 0.5));
    let near: Vec<_> = positions.zip(pixels).filter(|(position, _)| position.distance(at) <= reach).collect();
    let floor = near.iter().map(|(_, pixel)| pixel.y).fold(f64::INFINITY, f64::min);
    let (mut middle, mut total, mut peak) = (DVec2::ZERO, 0.0, 0.0_f64);
    for (position, pixel) in near {
        let weight = pixel.y - floor;
        (middle, total, peak) = (middle + weight * position, total + weight, peak.max(weight));
    }
    (middle / total, peak)
}

/// The white furnace: in the same light from everywhere a bubble cannot be seen, whatever its film; the limit is f32 and f16 rounding.
#[test]
fn a_bubble_vanishes_in_even_light() {
    let Some(mut renderer) = renderer() else { return };
    for thickness_nm in [0.0, 10.0, 100.0, 300.0, 1000.0, 3000.0] {
        let mut loaded = uniform(thickness_nm, even_light());
        for (distance_m, fov_y_deg) in [(0.24, 30.0), (0.0, 90.0), (0.03, 90.0), (20.0, 30.0)] {
            loaded.scene.camera = Camera { distance_m, fov_y_deg, ..Camera::default() };
            let pixels = radiance(&mut renderer, &still(&loaded, [160, 90], 0.0));
            let (_, error) = mean_and_max(pixels.iter().map(|pixel| (*pixel - 1.0).abs().max_element()));
            assert!(error <= 1e-3, "{thickness_nm} nm from {distance_m} m: {error}");
        }
    }
}

/// Where a bubble shows a lamp, by plane geometry alone. With the angle α of the ray and ψ of the lamp, both from the direction to the
/// center, and sin θ = (D / R) sin α: the outer reflection turns the ray by π − 2θ away from the center, so α + π − 2θ = ψ on the lamp's
/// own side; one inner reflection turns it as far the other way, so π − 2θ − α = ψ on the opposite side.
fn seen_at(camera: &PictureCamera, size: [u32; 2], radius_m: f64, lamp: DVec3, inner: bool) -> DVec2 {
    let to_center = -camera.eye_m.normalize();
    let ratio = camera.eye_m.length() / radius_m;
    let psi = to_center.angle_between(lamp);
    let turned = |alpha: f64| std::f64::consts::PI - 2.0 * (ratio * alpha.sin()).min(1.0).asin();
    let misses = |alpha: f64| turned(alpha) + if inner { -alpha } else { alpha } - psi;
    let (mut low, mut high) = (0.0, (1.0 / ratio).asin());
    assert!(misses(low) > 0.0 && misses(high) < 0.0, "no such reflection");
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if misses(middle) > 0.0 { low = middle } else { high = middle }
    }
    let side = lamp.reject_from_normalized(to_center).normalize() * if inner { -1.0 } else { 1.0 };
    camera.position(size, low.cos() * to_center + low.sin() * side).unwrap()
}

/// Front highlights upright, back ones inverted, each within half a pixel of where exact perspective puts it.
#[test]
fn lamps_are_mirrored_where_geometry_says() {
    let Some(mut renderer) = renderer() else { return };
    let size = [640, 360];
    let mut worst = 0.0_f64;
    for (right, up) in [(0.9, 0.3), (-0.5, 0.8), (0.2, -1.0)] {
        let probe = uniform(300.0, even_light());
        let eye = camera(&still(&probe, size, 0.0));
        // Beside and a little behind the eye.
        let towards = (right * eye.right + up * eye.up - 0.6 * eye.forward).normalize();
        let mut loaded = uniform(300.0, lamp(towards, 2.0));
        loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
        let pixels = radiance(&mut renderer, &still(&loaded, size, 0.0));
        for inner in [false, true] {
            let expected = seen_at(&eye, size, 0.05, towards, inner);
            let (found, peak) = highlight(&pixels, size, expected, 7.0);
            assert!(peak > 1.0, "no highlight at {expected} (inner: {inner})");
            worst = worst.max(found.distance(expected));
            assert!(found.distance(expected) <= 0.5, "expected {expected}, found {found} (inner: {inner})");
        }
    }
    eprintln!("measured: highlights stand within {worst:.3} pixels of exact perspective");
}

/// The room behind is seen through the bubble where it would be seen without: upright and unmirrored.
#[test]
fn the_background_is_seen_straight_through() {
    let Some(mut renderer) = renderer() else { return };
    let eye = camera(&still(&uniform(30.0, even_light()), SIZE, 0.0));
    for (right, up) in [(0.1, 0.05), (-0.12, 0.02), (0.0, -0.1)] {
        let towards = eye.forward + right * eye.right + up * eye.up;
        let pixels = radiance(&mut renderer, &still(&uniform(30.0, lamp(towards, 1.5)), SIZE, 0.0));
        let expected = eye.position(SIZE, towards).unwrap();
        let (found, _) = highlight(&pixels, SIZE, expected, 10.0);
        assert!(found.distance(expected) <= 0.3, "expected {expected}, found {found}");
    }
}

/// Moving right in the picture of an environment is moving right in its file, and up is up.
#[test]
fn environments_are_not_mirrored() {
    let Some(mut renderer) = renderer() else { return };
    // Red grows to the right of the file's middle, green towards its top.
    let pixels = (0..64 * 32).map(|k| [(k % 64) as f32 / 64.0, 1.0 - (k / 64) as f32 / 32.0, 0.0]).collect();
    let mut loaded = uniform(0.0, CubeMap::from_equirect(&Equirect::new(64, 32, pixels).unwrap()));
    // Looks along +x, the file's middle.
    loaded.scene.camera =
        Camera { azimuth_deg: 180.0, elevation_deg: 0.0, distance_m: 0.0, fov_y_deg: 60.0, ..Camera::default() };
    let pixels = radiance(&mut renderer, &still(&loaded, SIZE, 0.0));
    let [left, right] = [80, 240].map(|x| pixel(&pixels, SIZE, x, 90));
    let [top, bottom] = [30, 150].map(|y| pixel(&pixels, SIZE, 160, y));
    assert!(right.x > left.x + 0.1 && top.y > bottom.y + 0.1, "{left} {right} {top} {bottom}");
    assert!((pixel(&pixels, SIZE, 160, 90) - DVec3::new(0.5, 0.5, 0.0)).abs().max_element() < 0.02);
}

/// Gravity sorts the film: in even light from the front, the black film is at the top.
#[test]
fn the_thin_film_is_on_top() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = uniform(60.0, even_light());
    let film = &mut loaded.scene.bubbles[0].film;
    (film.state, film.stratification) = (FilmStateName::Rest, 1.8);
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    loaded.scene.camera.elevation_deg = 0.0;
    let pixels = radiance(&mut renderer, &still(&loaded, SIZE, 0.0));
    // The disc reaches 72 pixels from the middle.
    let strip = |rows: std::ops::Range<u32>| mean_and_max(rows.map(|y| pixel(&pixels, SIZE, 160, y).y)).0;
    let (top, bottom) = (strip(30..50), strip(130..150));
    assert!(top < 0.1 * bottom, "top {top}, bottom {bottom}");
}

/// Column means over the picture's rows, of its green bytes.
fn column_means(rgba: &[u8]) -> Vec<f64> {
    let [width, height] = SIZE.map(|pixels| pixels as usize);
    let column = |x: usize| (0..height).map(|y| f64::from(rgba[4 * (y * width + x) + 1])).sum::<f64>() / height as f64;
    (0..width).map(column).collect()
}

/// Whether every column is darker than the one eight to its right.
fn rises_every_8_pixels(means: &[f64]) -> bool {
    means.windows(9).all(|window| window[8] > window[0])
}

/// A ramp of a fortieth of an 8-bit step a pixel: columns of 180 dithered pixels tell it within 8 pixels, without dither it is bands.
#[test]
fn dark_ramps_show_no_bands() {
    let Some(mut renderer) = renderer() else { return };
    let ramp = |direction: DVec3| DVec3::splat(0.004 + 0.003 * direction.y);
    let mut loaded = uniform(0.0, CubeMap::from_fn(256, 1, ramp));
    loaded.scene.bubbles.clear();
    loaded.scene.camera.azimuth_deg = 0.0;
    let dithered = column_means(&display(&mut renderer, &still(&loaded, SIZE, 0.0)));
    assert!(rises_every_8_pixels(&dithered), "{dithered:?}");
    loaded.scene.view.dither = false;
    let plain = column_means(&display(&mut renderer, &still(&loaded, SIZE, 0.0)));
    assert!(!rises_every_8_pixels(&plain), "without dither the ramp must show bands, or this test sees nothing");
}

/// Across the file's left and right edge a smooth environment stays what its formula says; bilinear interpolation of 1024 columns is
/// within (2π / 1024)² / 8 = 5e-6 of it, and the nine bits of its texels within 2^-10. A longer lens sees it spread over discs, whose texels are rounded too.
#[test]
fn environments_have_no_seam() {
    let Some(mut renderer) = renderer() else { return };
    let formula = |d: DVec3| 0.5 + 0.3 * d.y + 0.1 * d.x;
    let at = |k: usize| {
        formula(direction_of_uv(DVec2::new(((k % 1024) as f64 + 0.5) / 1024.0, ((k / 1024) as f64 + 0.5) / 512.0)))
    };
    let pixels = (0..1024 * 512).map(|k| [at(k) as f32; 3]).collect();
    let mut loaded = uniform(0.0, CubeMap::from_equirect(&Equirect::new(1024, 512, pixels).unwrap()));
    loaded.scene.bubbles.clear();
    for (fov_y_deg, limit) in [(80.0, 1e-3), (30.0, 2e-3)] {
        // Looks along -x, where the file's edges meet.
        loaded.scene.camera = Camera { azimuth_deg: 0.0, elevation_deg: 0.0, fov_y_deg, ..Camera::default() };
        let request = still(&loaded, SIZE, 0.0);
        let draw = &request.picture.draw;
        assert_eq!(draw.defocus(&draw.lighting).is_some(), fov_y_deg == 30.0);
        let (eye, pixels) = (camera(&request), radiance(&mut renderer, &request));
        let error = |k: u32| {
            let position = DVec2::new(f64::from(k % SIZE[0]) + 0.5, f64::from(k / SIZE[0]) + 0.5);
            (pixels[k as usize].x - formula(eye.ray(SIZE, position))).abs()
        };
        let (_, max) = mean_and_max((0..SIZE[0] * SIZE[1]).map(error));
        assert!(max < limit, "{fov_y_deg}: {max}");
    }
}

/// A bubble ten pixels wide that moves by tenths of a pixel keeps its light: nothing twinkles.
#[test]
fn small_bubbles_do_not_twinkle() {
    let Some(mut renderer) = renderer() else { return };
    let size = [64, 64];
    let mut loaded = load("tent");
    loaded.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    loaded.scene.camera =
        Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance_m: 4.0, fov_y_deg: 9.0, ..Camera::default() };
    let pixel_m = 4.0 * 2.0 * 4.5_f64.to_radians().tan() / 64.0;
    let mut energy = |tenths: u32, up: bool| {
        let shift_m = 0.1 * f64::from(tenths) * pixel_m;
        loaded.scene.bubbles[0].center_m = if up { [0.0, 0.0, shift_m] } else { [0.0, shift_m, 0.0] };
        radiance(&mut renderer, &still(&loaded, size, 0.0)).iter().map(|pixel| pixel.y).sum::<f64>()
    };
    let energies: Vec<f64> = [false, true]
        .into_iter()
        .flat_map(|up| (0..10).map(move |tenths| (tenths, up)))
        .map(|(tenths, up)| energy(tenths, up))
        .collect();
    let (mean, max) = mean_and_max(energies.iter().copied());
    let (_, spread) = mean_and_max(energies.iter().map(|energy| (energy / mean - 1.0).abs()));
    eprintln!("measured: a bubble of 10 pixels moved by tenths keeps its light within {:.3} %", 100.0 * spread);
    assert!(max > 0.0 && spread <= 0.005, "{energies:?}");
}

/// Pixels on either side of the outline that count as the limb: light grazes the film there, thick films have fringes as narrow as pixels,
/// and reflections squeeze the room together.
const LIMB_PIXELS: f64 = 4.0;

/// How far the GPU's picture is from the f64 one.
struct Distance {
    /// Mean difference, in units of the f64 picture's brightest decile.
    mean: f64,
    /// Largest difference of pixels that the bubble's outline stays clear of, in the same units.
    inside_max: f64,
    /// Largest difference of the others, in units of the light's white, all of which a film reflects at the limb.
    limb_max: f64,
}

fn distance_from_reference(renderer: &mut Renderer, name: &str, loaded: &LoadedScene, time_s: f64) -> Distance {
    let size = [160, 90];
    let request = still(loaded, size, time_s);
    let seen = radiance(renderer, &request);
    let truth = reference::radiance(&request.picture.draw, &Default::default(), &|| ()).unwrap();
    let mut levels: Vec<f64> = truth.iter().map(|pixel| pixel.max_element()).collect();
    levels.sort_by(f64::total_cmp);
    let scale = levels[levels.len() * 9 / 10];
    let errors: Vec<f64> = seen.iter().zip(&truth).map(|(a, b)| (*a - *b).abs().max_element() / scale).collect();
    let eye = camera(&request);
    let limb = (0.05 / eye.eye_m.length()).asin();
    let at_limb = |k: usize| {
        let position = DVec2::new((k % 160) as f64 + 0.5, (k / 160) as f64 + 0.5);
        // Not a number, and so never at the limb, with the camera inside.
        (eye.ray(size, position).angle_between(-eye.eye_m) - limb).abs() < LIMB_PIXELS * eye.pixel_height_m
    };
    let part = |limb: bool| {
        let errors = errors.iter().enumerate().filter(|(k, _)| at_limb(*k) == limb).map(|(_, error)| *error);
        errors.fold(0.0, f64::max)
    };
    let (mean, _) = mean_and_max(errors.iter().copied());
    let white = request.picture.draw.lighting.light.gain.max_element() / scale;
    let distance = Distance { mean, inside_max: part(false), limb_max: part(true) / white };
    let Distance { mean, inside_max, limb_max } = distance;
    eprintln!("measured: GPU - f64 picture, {name}: mean {mean:.5}, max {inside_max:.4}, at the limb {limb_max:.4}");
    distance
}

/// In even light what remains is the optics. Inside the outline: products of walls in RGB (mean ΔE near 1, some per cent of the light where
/// colours are saturated), and light of the third inner reflection on given to the second, which is the same light here. At the outline:
/// one analytic coverage and one ray a pixel against 64 rays, where the film turns from 10 % to 100 % of reflectance within a pixel.
#[test]
fn the_picture_in_even_light_matches_the_f64_picture() {
    let Some(mut renderer) = renderer() else { return };
    let mut still_film = uniform(320.0, even_light());
    still_film.scene.view.backdrop = Backdrop::Radiance([0.0; 3]);
    let mut moving = load("stirred");
    moving.resources.environment = Arc::new(even_light());
    moving.scene.bubbles[0].film.cells = 64;
    let films =
        [(&moving, "stirred film at 0.51 s, even light"), (&still_film, "uniform 320 nm, even light, black card")];
    for (loaded, name) in films.into_iter().take(short_or_long(1, 2)) {
        let distance = distance_from_reference(&mut renderer, name, loaded, 0.51);
        assert!(distance.mean <= 0.01 && distance.inside_max <= 0.05 && distance.limb_max <= 0.12, "{name}");
    }
}

/// With a tent around it, filtered lookups of the environment stand against averages over samples: edges of lamps differ by a part of
/// their contrast within a pixel, and most where the limb squeezes them.
#[test]
fn the_pictures_of_presets_match_the_f64_pictures() {
    let Some(mut renderer) = renderer() else { return };
    let tent = load("tent").resources.environment;
    for name in ["lamplight", "inside", "bands"].into_iter().take(short_or_long(1, 3)) {
        let mut loaded = load(name);
        loaded.resources.environment = tent.clone();
        loaded.scene.bubbles[0].film.cells = 64;
        let distance = distance_from_reference(&mut renderer, name, &loaded, 0.0);
        assert!(distance.mean <= 0.012 && distance.inside_max <= 0.15 && distance.limb_max <= 0.12, "{name}");
    }
}

/// Equal history gives equal bits, on a fresh device and however the way there was cut.
#[test]
fn equal_history_gives_equal_bits() {
    let Some(mut first) = renderer() else { return };
    let mut second = Renderer::new(pollster::block_on(first.gpu.another()).unwrap());
    let mut loaded = load("fresh");
    loaded.scene.bubbles[0].film.cells = 64;
    let request = |time_s| still(&loaded, SIZE, time_s);
    let at_once = display(&mut first, &request(1.01));
    for time_s in [0.2, 0.5, 0.505, 0.9] {
        display(&mut second, &request(time_s));
    }
    assert!(display(&mut second, &request(1.01)) == at_once);
}

/// Every preset draws, and shows something: but for the furnace, whose bubble must not be seen.
#[test]
fn every_preset_draws() {
    let Some(mut renderer) = renderer() else { return };
    for name in preset_names().filter(|name| *name != "furnace") {
        let mut loaded = load(name);
        loaded.scene.bubbles.iter_mut().for_each(|bubble| bubble.film.cells = 32);
        let rgba = display(&mut renderer, &still(&loaded, [96, 54], 0.1));
        let levels =
            || rgba.chunks_exact(4).map(|pixel| u32::from(pixel[0]) + u32::from(pixel[1]) + u32::from(pixel[2]));
        let (darkest, brightest) = (levels().min().unwrap(), levels().max().unwrap());
        assert!(brightest > darkest + 60, "{name}: from {darkest} to {brightest}");
    }
}
