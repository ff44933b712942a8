//! Pictures in hard light: a few lamps, thousands of times as bright as the dark room around them, as in a studio. Whatever a picture gets wrong
//! about where a reflection ends, or about light that a wall reflects several times, stands alone before black here.

use std::{collections::BTreeMap, f64::consts::TAU, sync::Arc};

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
    plan::{BubbleKey, DrawKey, Resources},
    scene::{Backdrop, Bubble, Camera, Film, FilmStateName, Flow, Motion, Quality, Scene, View},
};

/// Pixels of each picture.
const SIZE: [u32; 2] = [320, 180];
/// How many times as bright as their surroundings lamps are.
const CONTRAST: f64 = 3730.0;
/// Part of the bubble's radius beyond which a pixel belongs to its limb.
const LIMB: f64 = 0.96;
/// Every second column and row of the limb is compared, and every fifth of the rest of the bubble.
const LIMB_STEP: u32 = 2;
const STEP: u32 = 5;
/// Samples along each side of a pixel of the truth at first, and at most: they are doubled until the picture stays.
const SAMPLES: [u32; 2] = [6, 48];
/// By how much, in CIEDE2000 on average, the truth may change with twice as many samples along each side of a pixel.
const STAYS: f64 = 0.05;
/// Limits on the mean of CIEDE2000 over the bubble, and over its limb alone. `fast`, whose products of reflectances are products of colours, is held
/// to what it reaches.
static LIMITS: [(Quality, [f64; 2]); 3] =
    [(Quality::Fast, [4.0, 8.0]), (Quality::Standard, [0.5, 2.0]), (Quality::Spectral, [0.2, 1.0])];

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    let mut renderer = Renderer::new(pollster::block_on(run.gpu.another())?);
    // A short run takes the room whose truth needs the fewest samples, and leaves out the quality whose shaders take the longest to compile.
    let (studios, limits) = run.short_or_full((&Studio::ALL[..1], &LIMITS[1..2]), (Studio::ALL, &LIMITS[..]));
    studios.iter().try_for_each(|studio| measure(run, &mut renderer, studio, limits))
}

/// A dark room with lamps.
struct Studio {
    name: &'static str,
    /// Number of lamps, and half their width and height seen from 1 away.
    lamps: usize,
    half_size: DVec2,
    film: FilmStateName,
    thickness_nm: f64,
}

impl Studio {
    const ALL: &[Self] = &[
        Self {
            name: "two softboxes",
            lamps: 2,
            half_size: DVec2::new(0.5, 0.65),
            film: FilmStateName::Rest,
            thickness_nm: 580.0,
        },
        Self {
            name: "five panels",
            lamps: 5,
            half_size: DVec2::new(0.25, 0.4),
            film: FilmStateName::Rest,
            thickness_nm: 420.0,
        },
        Self {
            name: "three strips",
            lamps: 3,
            half_size: DVec2::new(0.06, 0.9),
            film: FilmStateName::Rest,
            thickness_nm: 300.0,
        },
        Self {
            name: "nine spots",
            lamps: 9,
            half_size: DVec2::new(0.08, 0.08),
            film: FilmStateName::Uniform,
            thickness_nm: 350.0,
        },
        Self {
            name: "one window",
            lamps: 1,
            half_size: DVec2::new(0.6, 0.6),
            film: FilmStateName::Blown,
            thickness_nm: 700.0,
        },
    ];

    /// Rectangles of light in random directions, whose edges are a degree wide: a few texels of a panorama.
    fn environment(&self) -> Arc<CubeMap> {
        const EDGE: f64 = 0.02;
        let mut random = Random::new(self.lamps as u64);
        let lamps: Vec<DVec3> = (0..self.lamps)
            .map(|lamp| {
                let azimuth = TAU * (lamp as f64 + 0.6 * random.next()) / self.lamps as f64;
                DVec2::from_angle(azimuth).extend(0.9 * random.next() - 0.2).normalize()
            })
            .collect();
        let half_size = self.half_size;
        let light = move |direction: DVec3| {
            let direction = direction.normalize();
            let lit = |towards: &DVec3| {
                let facing = direction.dot(*towards);
                let right = towards.cross(DVec3::Z).normalize();
                let place = DVec2::new(direction.dot(right), direction.dot(right.cross(*towards))) / facing;
                let inside = (half_size - place.abs()) / EDGE + 0.5;
                let part = inside.clamp(DVec2::ZERO, DVec2::ONE);
                if facing > 0.0 { part.x * part.y } else { 0.0 }
            };
            let lamps = lamps.iter().map(lit).fold(0.0, f64::max);
            DVec3::splat(8.0 * (1.0 / CONTRAST + lamps))
        };
        Arc::new(CubeMap::from_fn(512, 2, light))
    }

    fn scene(&self) -> (Scene, Resources) {
        let film = Film { state: self.film, thickness_nm: self.thickness_nm, ..Film::default() };
        let scene = Scene {
            bubbles: vec![Bubble { film, ..Bubble::default() }],
            camera: Camera::default(),
            view: View { backdrop: Backdrop::Radiance([8.0 / CONTRAST; 3]), ..View::default() },
            motion: Motion { flow: Flow::Rest, ..Motion::default() },
            ..Scene::default()
        };
        let resources = Resources {
            environment: self.environment(),
            illuminant: Arc::new(Illuminant::default()),
            spectral_lights: Vec::new(),
            liquids: BTreeMap::new(),
            plate: None,
        };
        (scene, resources)
    }
}

/// Errors of each quality over the bubble and over its limb.
fn measure(
    run: &mut Run<'_>,
    renderer: &mut Renderer,
    studio: &Studio,
    limits: &[(Quality, [f64; 2])],
) -> Result<(), GpuError> {
    let (mut scene, resources) = studio.scene();
    let key = frame_request(&scene, &resources, SIZE)?.picture.draw;
    let places = places(&key);
    let pixels: Vec<[u32; 2]> = places.iter().map(|place| place.pixel).collect();
    let (truth, samples) = truth(&key, &pixels)?;
    for (quality, [bubble, limb]) in limits {
        scene.view.quality = *quality;
        let picture = radiance(renderer, &frame_request(&scene, &resources, SIZE)?)?;
        let seen: Vec<DVec3> = pixels.iter().map(|[x, y]| picture[(y * SIZE[0] + x) as usize]).collect();
        let errors = colour_differences(&truth, &seen);
        let mean = |is_meant: fn(&Place) -> bool| {
            let meant = || places.iter().zip(&errors).filter(|(place, _)| is_meant(place));
            let sum: f64 = meant().map(|(place, error)| place.weight * error).sum();
            sum / meant().map(|(place, _)| place.weight).sum::<f64>()
        };
        let name = |what: &str| {
            format!("hard light, {}, {samples}² samples, {}: dE2000 mean over {what}", studio.name, quality.name())
        };
        run.at_most(name("the bubble"), mean(|_| true), *bubble);
        run.at_most(name("its limb"), mean(Place::is_limb), *limb);
    }
    Ok(())
}

/// The picture in f64 at some pixels, with as many samples in a pixel as it takes, and that number along each side.
fn truth(key: &DrawKey, pixels: &[[u32; 2]]) -> Result<(Vec<DVec3>, u32), GpuError> {
    let with = |samples: u32| {
        let bubbles = key.bubbles.iter().map(|bubble| BubbleKey { samples, ..bubble.clone() }).collect();
        reference::radiance_of(&DrawKey { bubbles, ..key.clone() }, &BTreeMap::new(), pixels)
            .map_err(|error| GpuError::Refused(error.to_string()))
    };
    let [mut samples, most] = SAMPLES;
    let mut found = with(samples)?;
    while samples < most {
        samples *= 2;
        let finer = with(samples)?;
        let changes = colour_differences(&finer, &found);
        let change = changes.iter().sum::<f64>() / changes.len() as f64;
        found = finer;
        if change < STAYS {
            break;
        }
    }
    Ok((found, samples))
}

/// A pixel of the bubble.
struct Place {
    pixel: [u32; 2],
    /// Distance from the outline's middle over its radius.
    from_middle: f64,
    /// How many pixels it stands for.
    weight: f64,
}

impl Place {
    fn is_limb(&self) -> bool {
        self.from_middle > LIMB
    }
}

/// Some pixels of the bubble, more of its limb than of its middle, so that a truth takes no hours.
fn places(key: &DrawKey) -> Vec<Place> {
    let place = |pixel: [u32; 2]| {
        let from_middle = reference::distance_from_middle(key, &key.bubbles[0], pixel);
        let step = if from_middle > LIMB { LIMB_STEP } else { STEP };
        let is_taken = from_middle < 1.0 && pixel.iter().all(|k| k.is_multiple_of(step));
        is_taken.then_some(Place { pixel, from_middle, weight: f64::from(step * step) })
    };
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])).filter_map(place).collect()
}
