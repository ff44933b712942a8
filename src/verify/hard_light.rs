//! A bubble in hard light: lamps some thousand times as bright as the room around them. What the film mirrors of such a lamp after several
//! reflections inside is still as bright as the room, so that near the limb it is seen.

use std::{collections::BTreeMap, sync::Arc};

use glam::{DVec2, DVec3};

use super::{
    Run,
    picture::{colour_differences, frame_request, radiance},
    random::Random,
    reference,
};
use crate::{
    gpu::{GpuError, Renderer},
    physics::{colour::Illuminant, environment::CubeMap},
    plan::{DrawKey, Resources},
    scene::{Backdrop, Bubble, Film, FilmStateName, Flow, Motion, Quality, Scene, View},
};

/// Pixels of each picture.
const SIZE: [u32; 2] = [320, 180];
/// Radiance of the room; lamps are [`CONTRAST`] times as bright.
const ROOM: f64 = 0.002;
/// How much brighter lamps are, as measured in a photographed studio.
const CONTRAST: f64 = 3730.0;
/// Texels along an edge of a face of the environment.
const TEXELS: usize = 256;
/// Samples along each side of a pixel of the truth: with twice as many the mean over the ring changes by less than 0.1.
const SAMPLES: u32 = 16;
/// Part of the outline's angle beyond which a pixel belongs to the ring.
const RING: f64 = 0.96;
/// Limits on the mean of CIEDE2000 over the bubble and over the ring at its limb.
const LIMITS: [(Quality, [f64; 2]); 2] = [(Quality::Standard, [0.5, 2.0]), (Quality::Spectral, [0.2, 1.0])];

/// A lamp with an even face: directions within an ellipse, or a rectangle, around its middle.
struct Lamp {
    azimuth_deg: f64,
    elevation_deg: f64,
    /// Tangents of half the angles that it spans.
    half: DVec2,
    round: bool,
}

/// Lamps of each scene: two softboxes and a strip, a softbox overhead, a lamp behind, four bulbs, a window.
const SCENES: [&[Lamp]; 5] = [
    &[lamp(-42.0, 24.0, 0.52, 0.66), lamp(112.0, 12.0, 0.34, 0.62), lamp(176.0, 30.0, 0.06, 0.6)],
    &[lamp(10.0, 80.0, 0.7, 0.7)],
    &[disc(200.0, 10.0, 0.15)],
    &[disc(-60.0, 40.0, 0.08), disc(30.0, 55.0, 0.08), disc(120.0, 20.0, 0.08), disc(215.0, -15.0, 0.08)],
    &[lamp(65.0, 15.0, 0.35, 0.5)],
];

const fn lamp(azimuth_deg: f64, elevation_deg: f64, half_width: f64, half_height: f64) -> Lamp {
    Lamp { azimuth_deg, elevation_deg, half: DVec2::new(half_width, half_height), round: false }
}

const fn disc(azimuth_deg: f64, elevation_deg: f64, half: f64) -> Lamp {
    Lamp { azimuth_deg, elevation_deg, half: DVec2::splat(half), round: true }
}

impl Lamp {
    /// Whether a lamp is seen in a direction.
    fn is_at(&self, direction: DVec3) -> bool {
        let (sin, cos) = self.elevation_deg.to_radians().sin_cos();
        let aside = DVec2::from_angle(self.azimuth_deg.to_radians());
        let (ahead, right) = ((cos * aside).extend(sin), aside.perp().extend(0.0));
        let depth = direction.dot(ahead);
        let place = DVec2::new(direction.dot(right), direction.dot(ahead.cross(right))) / (depth * self.half);
        let reach = if self.round { place.length() } else { place.abs().max_element() };
        depth > 0.0 && reach < 1.0
    }
}

pub(super) fn run(run: &mut Run<'_>, renderer: &mut Renderer) -> Result<(), GpuError> {
    let scenes = run.short_or_full(&SCENES[..1], &SCENES[..]);
    let pixels = run.short_or_full(60, 200);
    let limits = run.short_or_full(&LIMITS[..1], &LIMITS[..]);
    let mut errors: [[Vec<f64>; 2]; LIMITS.len()] = Default::default();
    for (seed, lamps) in scenes.iter().enumerate() {
        let (mut scene, resources) = lit(lamps, seed)?;
        let key = frame_request(&scene, &resources, SIZE)?.picture.draw;
        let places = [0.0, RING].map(|inner| beyond(&key, inner, pixels, seed)).concat();
        let truth = truth(key, &places)?;
        for ((quality, _), errors) in limits.iter().zip(&mut errors) {
            scene.view.quality = *quality;
            let picture = radiance(renderer, &frame_request(&scene, &resources, SIZE)?)?;
            let seen: Vec<DVec3> = places.iter().map(|[x, y]| picture[(y * SIZE[0] + x) as usize]).collect();
            let found = colour_differences(&truth, &seen);
            errors.iter_mut().zip(found.chunks(pixels)).for_each(|(errors, found)| errors.extend(found));
        }
    }
    for ((quality, limits), errors) in limits.iter().zip(errors) {
        for ((part, limit), errors) in ["the bubble", "the ring at its limb"].into_iter().zip(limits).zip(errors) {
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            run.at_most(format!("hard light, {}: dE2000 mean over {part}", quality.name()), mean, *limit);
        }
    }
    Ok(())
}

/// Pixels in f64.
fn truth(mut key: DrawKey, places: &[[u32; 2]]) -> Result<Vec<DVec3>, GpuError> {
    key.bubbles.iter_mut().for_each(|bubble| bubble.samples = SAMPLES);
    reference::radiance_of(&key, &BTreeMap::new(), places).map_err(|error| GpuError::Refused(error.to_string()))
}

/// A bubble of random film among lamps, in a dark room.
fn lit(lamps: &'static [Lamp], seed: usize) -> Result<(Scene, Resources), GpuError> {
    let mut random = Random::new(seed as u64);
    let film = Film {
        state: FilmStateName::Rest,
        thickness_nm: 300.0 + 400.0 * random.next(),
        stratification: 0.6 * random.next(),
        ..Film::default()
    };
    let scene = Scene {
        bubbles: vec![Bubble { film, ..Bubble::default() }],
        view: View { backdrop: Backdrop::Environment, ..View::default() },
        motion: Motion { flow: Flow::Rest, ..Motion::default() },
        ..Scene::default()
    };
    let light = |direction: DVec3| {
        let lit = lamps.iter().any(|lamp| lamp.is_at(direction));
        DVec3::splat(if lit { CONTRAST * ROOM } else { ROOM })
    };
    let resources = Resources {
        environment: Arc::new(CubeMap::from_fn(TEXELS, 4, light)),
        illuminant: Arc::new(Illuminant::default()),
        spectral_lights: Vec::new(),
        liquids: BTreeMap::new(),
        plate: None,
    };
    Ok((scene, resources))
}

/// Random pixels of the bubble whose middle is farther from the middle of its disc than a part of its radius.
fn beyond(key: &DrawKey, inner: f64, count: usize, seed: usize) -> Vec<[u32; 2]> {
    let mut random = Random::new(1000 + seed as u64);
    let (camera, bubble) = (reference::camera(&key.camera), &key.bubbles[0]);
    let shows = |[x, y]: [u32; 2]| {
        let ray = camera.ray(SIZE, DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let aside = (bubble.center_m - key.camera.eye_m).reject_from_normalized(ray).length() / bubble.radius_m;
        (inner..1.0).contains(&aside)
    };
    let places = std::iter::repeat_with(|| SIZE.map(|size| (random.next() * f64::from(size)) as u32));
    places.filter(|place| shows(*place)).take(count).collect()
}
