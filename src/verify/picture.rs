//! Whole pictures of random scenes in coloured light: the GPU's against the f64 picture.

use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;

use super::{Extent, Run, random::Random, reference};
use crate::{
    gpu::{GpuError, Renderer},
    physics::{
        colour::{BT2020, Gamut, bt709_to_bt2020, ciede2000, xyz_to_lab},
        environment::CubeMap,
    },
    plan::{DrawKey, FrameRequest, Moment, Pace, Resources, Shot, SpectralLight, request},
    scene::{Backdrop, Bubble, Camera, Film, FilmStateName, Flow, Motion, Quality, Scene, View},
};

/// Pixels of each picture.
const SIZE: [u32; 2] = [256, 144];
/// Soft lamps of a random environment.
const LAMPS: usize = 6;
/// Lights of the scenes in turn.
const LIGHTS: [&str; 4] = ["D65", "A", "LED", "FL2"];
/// Limits on the mean and the 99.9th percentile of CIEDE2000. That percentile lies at the limb, where a pixel spans many fringes and much of
/// the surroundings, of which both pictures take samples.
const LIMITS: [(Quality, [f64; 2]); 3] =
    [(Quality::Fast, [1.0, 8.0]), (Quality::Standard, [0.3, 3.0]), (Quality::Spectral, [0.05, 0.6])];

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    let mut renderer = Renderer::new(pollster::block_on(run.gpu.another())?);
    let scenes = if run.is_long() { 12 } else { LIGHTS.len() };
    let lamps = ["sodium", "A"].into_iter().take(run.short_or_full(1, 2));
    let lamps: Vec<_> = lamps.map(mixed_light_scene).collect::<Result<_, _>>()?;
    measure(run, &mut renderer, "daylight and a lamp", lamps)?;
    // A truth takes a minute: a short run computes only the room with a lamp, where all kinds of light meet.
    if run.extent == Extent::Short {
        return Ok(());
    }
    let random: Vec<_> = (0..scenes).map(random_scene).collect::<Result<_, _>>()?;
    measure(run, &mut renderer, &format!("{scenes} pictures in coloured light"), random)
}

/// Errors over all pixels of some scenes, at each quality.
fn measure(
    run: &mut Run<'_>,
    renderer: &mut Renderer,
    what: &str,
    scenes: Vec<(Scene, Resources)>,
) -> Result<(), GpuError> {
    let mut errors: [Vec<f64>; LIMITS.len()] = Default::default();
    for (mut scene, resources) in scenes {
        let truth =
            reference::radiance(&frame_request(&scene, &resources, SIZE)?.picture.draw, &Default::default(), &|| ());
        let truth = truth.map_err(|error| GpuError::Refused(error.to_string()))?;
        for ((quality, _), errors) in LIMITS.iter().zip(&mut errors) {
            scene.view.quality = *quality;
            let request = frame_request(&scene, &resources, SIZE)?;
            errors.extend(differences(&request.picture.draw, &truth, &radiance(renderer, &request)?));
        }
    }
    for ((quality, limits), mut errors) in LIMITS.into_iter().zip(errors) {
        errors.sort_by(f64::total_cmp);
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let rare = errors[(errors.len() - 1) * 999 / 1000];
        let name = format!("{what}, {}: dE2000", quality.name());
        run.at_most(format!("{name} mean"), mean, limits[0]);
        run.at_most(format!("{name} 99.9th percentile"), rare, limits[1]);
    }
    Ok(())
}

/// A scene in daylight, some of whose soft lamps are of another illuminant: the lamps of another random scene.
fn mixed_light_scene(illuminant: &str) -> Result<(Scene, Resources), GpuError> {
    let (scene, mut resources) = random_scene(0)?;
    let (_, other) = random_scene(1)?;
    let illuminant = Arc::new(illuminant.parse().map_err(|error| GpuError::Refused(format!("{error}")))?);
    resources.spectral_lights = vec![SpectralLight { environment: other.environment, illuminant }];
    Ok((scene, resources))
}

/// Soft lamps in random directions, of colours made from three random numbers. Lamps have no edges finer than pixels: the pictures compare
/// optics, not filters of environments.
pub(super) fn soft_lamps(random: &mut Random, colour: impl Fn([f64; 3]) -> DVec3) -> Arc<CubeMap> {
    let mut lamps = Vec::new();
    for _ in 0..LAMPS {
        let towards = DVec3::new(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5).normalize_or(DVec3::Z);
        let colour = colour([random.next(), random.next(), random.next()]);
        let width = 0.4 + 0.6 * random.next();
        lamps.push((towards, 3.0 * colour / colour.max_element().max(1e-3), width));
    }
    let to_bt2020 = bt709_to_bt2020();
    let light = move |direction: DVec3| {
        let lamp = |(towards, colour, width): &(DVec3, DVec3, f64)| {
            *colour * ((direction.normalize().dot(*towards) - 1.0) / (width * width)).exp()
        };
        to_bt2020 * (0.05 + lamps.iter().map(lamp).sum::<DVec3>())
    };
    Arc::new(CubeMap::from_fn(128, 1, light))
}

/// A bubble of random film among soft lamps of saturated colours.
fn random_scene(seed: usize) -> Result<(Scene, Resources), GpuError> {
    let mut random = Random::new(seed as u64);
    let environment = soft_lamps(&mut random, |[r, g, b]| DVec3::new(r, g, b).powf(3.0));
    let state = [FilmStateName::Rest, FilmStateName::Uniform][seed % 2];
    let thickness_nm = 150.0 + 600.0 * random.next();
    let film = Film { state, thickness_nm, stratification: 0.8 * random.next(), ..Film::default() };
    let scene = Scene {
        bubbles: vec![Bubble { film, ..Bubble::default() }],
        camera: Camera { azimuth_deg: 360.0 * random.next(), ..Camera::default() },
        view: View {
            backdrop: if seed.is_multiple_of(3) {
                Backdrop::Environment
            } else {
                Backdrop::Radiance([0.01, 0.01, 0.02])
            },
            ..View::default()
        },
        motion: Motion { flow: Flow::Rest, ..Motion::default() },
        ..Scene::default()
    };
    let illuminant = LIGHTS[seed % LIGHTS.len()].parse().map_err(|error| GpuError::Refused(format!("{error}")))?;
    Ok((
        scene,
        Resources {
            environment,
            illuminant: Arc::new(illuminant),
            spectral_lights: Vec::new(),
            liquids: BTreeMap::new(),
            plate: None,
        },
    ))
}

pub(super) fn frame_request(scene: &Scene, resources: &Resources, size: [u32; 2]) -> Result<FrameRequest, GpuError> {
    let shot = Shot { size, moment: Moment::default(), full_precision: true, gamut: Gamut::Srgb, pace: Pace::Whole };
    request(scene, resources, &shot).map_err(|error| GpuError::Refused(error.to_string()))
}

pub(super) fn radiance(renderer: &mut Renderer, request: &FrameRequest) -> Result<Vec<DVec3>, GpuError> {
    renderer.render(request)?;
    let Some(picture) = renderer.read_radiance() else { return Ok(Vec::new()) };
    let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&picture.wait(&renderer.gpu)?);
    Ok(pixels.into_iter().map(|[r, g, b, _]| DVec3::new(r.into(), g.into(), b.into())).collect())
}

/// Colour differences of the pixels that the bubble covers.
fn differences(key: &DrawKey, truth: &[DVec3], seen: &[DVec3]) -> Vec<f64> {
    let covered: Vec<usize> = (0..truth.len()).filter(|k| is_covered(key, *k)).collect();
    let [truth, seen] = [truth, seen].map(|pixels| covered.iter().map(|k| pixels[*k]).collect::<Vec<_>>());
    colour_differences(&truth, &seen)
}

/// CIEDE2000 of pixels, scaled so that the truth's 99th percentile of Y is 1; white is D65's.
pub(super) fn colour_differences(truth: &[DVec3], seen: &[DVec3]) -> Vec<f64> {
    let to_xyz = BT2020.to_xyz();
    let mut levels: Vec<f64> = truth.iter().map(|rgb| (to_xyz * *rgb).y).collect();
    levels.sort_by(f64::total_cmp);
    let scale = levels[(levels.len() - 1) * 99 / 100].max(f64::MIN_POSITIVE);
    let lab = |rgb: DVec3| xyz_to_lab(to_xyz * rgb / scale, to_xyz * DVec3::ONE);
    truth.iter().zip(seen).map(|(truth, seen)| ciede2000(lab(*truth), lab(*seen))).collect()
}

/// Whether a pixel's middle shows a bubble.
fn is_covered(key: &DrawKey, pixel: usize) -> bool {
    let place = [pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]];
    key.bubbles.iter().any(|bubble| reference::distance_from_middle(key, bubble, place) < 1.0)
}
