//! Bubbles in front of, inside and through one another: pixels of random scenes against the f64 picture, which follows every ray to its end.

use std::{collections::BTreeMap, sync::Arc};

use glam::{DVec2, DVec3};

use super::{
    Run,
    picture::{colour_differences, frame_request, radiance, soft_lamps},
    random::Random,
    reference,
};
use crate::{
    gpu::{GpuError, Renderer},
    physics::{colour::Illuminant, environment::CubeMap},
    plan::{DrawKey, Resources},
    scene::{
        Backdrop, Bubble, Camera, Film, FilmIndexName, FilmStateName, Flow, Generator, Light, Motion, Quality, Scene,
        View,
    },
};

/// Pixels of each picture: bubbles have radii of 100 to 140, so that one sample is enough but near outlines.
const SIZE: [u32; 2] = [1600, 900];
/// Limits on the mean and the 99th percentile of CIEDE2000 over covered pixels.
type Limits = [(Quality, [f64; 2]); 3];
static LIMITS: Limits =
    [(Quality::Fast, [1.2, 8.0]), (Quality::Standard, [0.5, 2.0]), (Quality::Spectral, [0.15, 1.0])];
/// The same where bubbles intersect: what their walls leave of one another's s and p light is a factor on each primary.
static INTERSECTING: Limits =
    [(Quality::Fast, [1.3, 8.0]), (Quality::Standard, [0.5, 3.0]), (Quality::Spectral, [0.25, 1.8])];

/// What is reached with small bubbles, whose walls are looked up in the table at all qualities, which mirror no others, and of which some intersect;
/// in spectral pictures bubbles are small only below 16 pixels.
static SMALL: Limits = [(Quality::Fast, [0.9, 6.0]), (Quality::Standard, [0.9, 6.0]), (Quality::Spectral, [0.25, 3.5])];

/// Random scenes of one kind.
struct Kind {
    name: &'static str,
    /// Bubbles of each scene.
    counts: &'static [usize],
    /// Whether bubbles may intersect, and lie in one another.
    intersect: bool,
    /// Whether light is coloured.
    coloured: bool,
    /// Whether films are of several liquids.
    mixed: bool,
    /// Whether a generator makes the bubbles, and most are small.
    made: bool,
    /// Distance of the eye from the middle, m.
    distance_m: f64,
    /// Factor on the distances of the bubbles from the middle.
    spread: f64,
}

impl Kind {
    const APART: Self = Self {
        name: "apart",
        counts: &[2, 6, 24],
        intersect: false,
        coloured: false,
        mixed: false,
        made: false,
        distance_m: 0.6,
        spread: 1.0,
    };

    const INTERSECTING: Self = Self { name: "intersecting", counts: &[2, 6, 20], intersect: true, ..Self::APART };
    const SMALL: Self = Self { name: "small ones", counts: &[40], made: true, ..Self::APART };

    const ALL: [Self; 7] = [
        Self::APART,
        Self { name: "apart, coloured light", coloured: true, ..Self::APART },
        Self { name: "apart, two liquids", counts: &[2, 6], mixed: true, ..Self::APART },
        Self::INTERSECTING,
        Self { name: "seen from inside", counts: &[3, 6], distance_m: 0.0, spread: 0.3, ..Self::INTERSECTING },
        Self::SMALL,
        Self { name: "small ones, coloured light", coloured: true, ..Self::SMALL },
    ];
}

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    let mut renderer = Renderer::new(pollster::block_on(run.gpu.another())?);
    furnace(run, &mut renderer)?;
    // To compile the shaders of a kind of scene takes longer than all else: a short run takes the kind that has all in it, and one for spectral ones.
    let (kinds, pixels) = run.short_or_full((&[Kind::INTERSECTING, Kind::APART][..], 200), (&Kind::ALL[..], 400));
    kinds.iter().try_for_each(|kind| measure(run, &mut renderer, kind, pixels))
}

/// The qualities that are measured, with their limits: in a short run spectral pictures, whose shaders take the longest to compile, are of bubbles apart,
/// and the others of bubbles that intersect.
fn limits(run: &Run<'_>, kind: &Kind) -> &'static [(Quality, [f64; 2])] {
    let limits = match kind {
        Kind { made: true, .. } => &SMALL,
        Kind { intersect: true, .. } => &INTERSECTING,
        Kind { .. } => &LIMITS,
    };
    run.short_or_full(if kind.intersect { &limits[..2] } else { &limits[2..] }, limits)
}

/// In even light nothing is seen of bubbles.
fn furnace(run: &mut Run<'_>, renderer: &mut Renderer) -> Result<(), GpuError> {
    let crowds = [(Kind::INTERSECTING, 6), (Kind::SMALL, 300), (Kind::INTERSECTING, 40), (Kind::APART, 24)];
    for (kind, count) in crowds.into_iter().take(run.short_or_full(2, 4)) {
        let (mut scene, resources) = random_scene(&kind, count, 0)?;
        scene.light.constant = Some([1.0; 3]);
        scene.view.backdrop = Backdrop::Environment;
        let lit = Resources { environment: Arc::new(CubeMap::constant(DVec3::ONE)), ..resources };
        let mut worst = 0.0_f64;
        // In spectral pictures, hundreds of these would not be small.
        let qualities = if kind.made { &SMALL[..2] } else { limits(run, &kind) };
        for (quality, _) in qualities {
            scene.view.quality = *quality;
            let pixels = radiance(renderer, &frame_request(&scene, &lit, SIZE)?)?;
            worst = pixels.iter().map(|rgb| (*rgb - 1.0).abs().max_element()).fold(worst, f64::max);
        }
        let name = format!("{count} bubbles in even white light, {}: what is seen of them", kind.name);
        run.at_most(name, worst, 1e-3);
    }
    Ok(())
}

/// Errors over some covered pixels of scenes of a kind, at each quality.
fn measure(run: &mut Run<'_>, renderer: &mut Renderer, kind: &Kind, pixels: usize) -> Result<(), GpuError> {
    let mut errors: [Vec<f64>; LIMITS.len()] = Default::default();
    let counts = run.short_or_full(if kind.intersect { &kind.counts[1..2] } else { kind.counts }, kind.counts);
    for (seed, &count) in counts.iter().enumerate() {
        let (mut scene, resources) = random_scene(kind, count, seed)?;
        let key = frame_request(&scene, &resources, SIZE)?.picture.draw;
        let places = covered(&key, pixels, seed);
        let truth = reference::radiance_of(&key, &BTreeMap::new(), &places);
        let truth = truth.map_err(|error| GpuError::Refused(error.to_string()))?;
        for ((quality, _), errors) in limits(run, kind).iter().zip(&mut errors) {
            scene.view.quality = *quality;
            let picture = radiance(renderer, &frame_request(&scene, &resources, SIZE)?)?;
            let seen: Vec<DVec3> = places.iter().map(|[x, y]| picture[(y * SIZE[0] + x) as usize]).collect();
            errors.extend(colour_differences(&truth, &seen));
        }
    }
    for ((quality, [mean, rare]), mut errors) in limits(run, kind).iter().zip(errors) {
        errors.sort_by(f64::total_cmp);
        let name = format!("{}, {}: dE2000", kind.name, quality.name());
        run.at_most(format!("{name} mean"), errors.iter().sum::<f64>() / errors.len() as f64, *mean);
        run.at_most(format!("{name} 99th percentile"), errors[(errors.len() - 1) * 99 / 100], *rare);
    }
    Ok(())
}

/// Random pixels whose middle shows a bubble.
fn covered(key: &DrawKey, count: usize, seed: usize) -> Vec<[u32; 2]> {
    let mut random = Random::new(1000 + seed as u64);
    let (camera, bubbles) = (reference::camera(&key.camera), key.all_bubbles());
    let shows = |[x, y]: [u32; 2]| {
        let ray = camera.ray(SIZE, DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        bubbles.iter().any(|bubble| {
            let offset = bubble.center_m - key.camera.eye_m;
            let aside = offset.reject_from_normalized(ray).length();
            aside < bubble.radius_m && (offset.dot(ray) > 0.0 || offset.length() < bubble.radius_m)
        })
    };
    let places = std::iter::repeat_with(|| SIZE.map(|size| (random.next() * f64::from(size)) as u32));
    places.take(1_000_000).filter(|place| shows(*place)).take(count).collect()
}

/// Bubbles of random films at random places, in soft light.
fn random_scene(kind: &Kind, count: usize, seed: usize) -> Result<(Scene, Resources), GpuError> {
    let mut random = Random::new(seed as u64);
    let grey = |[r, _, _]: [f64; 3]| DVec3::splat(0.2 + r);
    let saturated = |rgb: [f64; 3]| DVec3::from(rgb).powf(3.0);
    let environment = soft_lamps(&mut random, |rgb| if kind.coloured { saturated(rgb) } else { grey(rgb) });
    let generators = if kind.made { vec![generator(count, seed)] } else { Vec::new() };
    let count = if kind.made { 0 } else { count };
    let mut bubbles: Vec<Bubble> = Vec::new();
    while bubbles.len() < count {
        let bubble = random_bubble(kind, &mut random);
        let clear_m = |other: &Bubble| {
            DVec3::from(other.center_m).distance(bubble.center_m.into()) - 1e-3 * (other.radius_mm + bubble.radius_mm)
        };
        if kind.intersect || bubbles.iter().all(|other| clear_m(other) > 0.0) {
            bubbles.push(bubble);
        }
    }
    let scene = Scene {
        bubbles,
        generators,
        camera: Camera { distance_m: kind.distance_m, azimuth_deg: 0.0, elevation_deg: 0.0, ..Camera::default() },
        light: Light::default(),
        view: View { backdrop: Backdrop::Radiance([0.05; 3]), ..View::default() },
        motion: Motion { flow: Flow::Rest, ..Motion::default() },
        ..Scene::default()
    };
    let resources = Resources {
        environment,
        illuminant: Arc::new(Illuminant::default()),
        spectral_lights: Vec::new(),
        liquids: BTreeMap::new(),
        plate: None,
    };
    Ok((scene, resources))
}

/// Bubbles with radii of 4 to 36 pixels.
fn generator(count: usize, seed: usize) -> Generator {
    Generator {
        count: count as u32,
        seed: seed as u64,
        size_m: [0.12, 0.5, 0.3],
        radius_mm: 7.0,
        radius_spread: 0.8,
        films: 3,
        film: Film { state: FilmStateName::Rest, thickness_nm: 500.0, cells: 64, ..Film::default() },
        ..Generator::default()
    }
}

fn random_bubble(kind: &Kind, random: &mut Random) -> Bubble {
    let mut within = |half: f64| half * (2.0 * random.next() - 1.0);
    // Of about one size in the picture, so that films are neither magnified nor filtered, for which there are other shaders.
    let center_m = [within(0.06), within(0.2), within(0.12)].map(|m| kind.spread * m);
    let thickness_nm = 400.0 + within(300.0);
    let index = if kind.mixed && within(1.0) > 0.0 { FilmIndexName::Constant(1.45) } else { FilmIndexName::Water };
    let film = Film {
        state: FilmStateName::Rest,
        thickness_nm,
        cells: 64,
        stratification: within(0.8),
        index,
        ..Film::default()
    };
    Bubble { center_m, radius_mm: 42.5 + within(2.5), film, ..Bubble::default() }
}
