//! From a scene and a shot of it to what the picture needs.

use std::{collections::BTreeMap, sync::Arc};

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::{
    BackdropKey, BandsKey, BubbleKey, CameraKey, DrawKey, EnvironmentKey, FieldKey, FilmEnd, FilmKey, FlowLaw,
    FlowSegment, FreeFlow, LightKey, Lighting, Moment, OpticsKey, Pace, PushKey, TableKey, TonemapKey, Want,
    keys::evaporated_nm,
    lives::{Life, life, since},
    range_nm,
};
use crate::{
    physics::{
        bubble::{CentrePath, Oscillator, Shape, reach},
        colour::{Gamut, Illuminant, bt709_to_bt2020, daylight_scale, seen_light, white_balance},
        environment::CubeMap,
        film::{
            Cap, InitialFilm, Push, Regeneration,
            properties::{DENSITY, VISCOSITY, air_drag, evaporation_rate},
        },
        flow::{AIR_DRAG, FlowForces},
        optics::{FilmIndex, FilmIndexError, FilmMaterial},
        transport::Scheme,
    },
    scene::{
        Backdrop, Blow, Boundary, Bubble, Change, Film, FilmIndexName, FilmStateName, Flow, Motion, Scene, Stir,
        TransportScheme,
    },
};

/// What a scene names and somebody has loaded.
#[derive(Clone, Debug)]
pub struct Resources {
    /// The environment, in linear BT.2020.
    pub environment: Arc<CubeMap>,
    /// The light's spectrum.
    pub illuminant: Arc<Illuminant>,
    /// Lamps of other spectra, which the environment lacks.
    pub lamps: Vec<Lamp>,
    /// Liquids from files, by the paths that the scene gives them.
    pub liquids: BTreeMap<String, FilmIndex>,
}

/// All light of one spectrum that is not the scene's own.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// Where it comes from, in linear BT.2020.
    pub environment: Arc<CubeMap>,
    /// Its spectrum.
    pub illuminant: Arc<Illuminant>,
}

/// One picture of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Width and height in pixels, both above zero.
    pub size: [u32; 2],
    /// When it is taken.
    pub moment: Moment,
    /// Whether radiance is kept as f32.
    pub full_precision: bool,
    /// Colours that the display, or the file, has.
    pub gamut: Gamut,
    /// Whether films are replaced by the yardstick of the frame's cost.
    pub yardstick: bool,
    /// How much may be done at once.
    pub pace: Pace,
}

/// A scene that cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WantError {
    /// Two visible films of different liquids.
    #[error(
        "bubbles of different films cannot share one picture: set the same `index` and `skin_nm` in every [bubble.film]"
    )]
    MixedFilms,
    /// A camera that cannot see the bubbles for the bath.
    #[error("the camera is below the bath that the bubbles stand on: raise `elevation_deg` or `target_m` in [camera]")]
    BelowBath,
    /// An index that no film has.
    #[error(transparent)]
    Index(#[from] FilmIndexError),
}

/// What a shot of a scene needs.
pub fn want(scene: &Scene, resources: &Resources, shot: &Shot) -> Result<Want, WantError> {
    let camera = camera(scene, shot.size);
    let bath_m = scene.bubbles.iter().find(|bubble| bubble.boundary == Boundary::Bath).map(|bubble| bubble.center_m[2]);
    if bath_m.is_some_and(|height_m| camera.eye_m.z <= height_m) {
        return Err(WantError::BelowBath);
    }
    let mut bubbles: Vec<BubbleKey> = scene
        .bubbles
        .iter()
        .enumerate()
        .filter_map(|(index, bubble)| visible(scene, &camera, shot, index, bubble))
        .collect();
    let distance = |bubble: &BubbleKey| bubble.centre_m.distance_squared(camera.eye_m);
    bubbles.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
    let film = material(scene, resources, &bubbles)?;
    let range_nm = range_nm(bubbles.iter().map(thickest_nm).fold(0.0, f64::max));
    let own = Lamp { environment: resources.environment.clone(), illuminant: resources.illuminant.clone() };
    let lighting = |lamp: &Lamp, light: LightKey| lighting(scene, lamp, light, &film, range_nm);
    let light = light(scene, resources, &camera);
    let draw = DrawKey {
        size: shot.size,
        full_precision: shot.full_precision,
        yardstick: shot.yardstick,
        camera,
        lighting: lighting(&own, light),
        lamps: resources.lamps.iter().map(|lamp| lighting(lamp, lamp_light(scene, lamp, light))).collect(),
        bubbles,
        on_bath: bath_m.is_some(),
    };
    let dither = scene.view.dither.then_some(fold_seed(scene.view.dither_seed));
    let balances = scene.view.white_balance && !resources.illuminant.is_monochromatic();
    let balance = if balances { white_balance(&resources.illuminant) } else { DMat3::IDENTITY };
    let exposure_ev = scene.view.exposure_ev;
    Ok(Want { picture: TonemapKey { draw, exposure_ev, balance, gamut: shot.gamut, dither }, pace: shot.pace })
}

fn camera(scene: &Scene, [_, height]: [u32; 2]) -> CameraKey {
    let camera = &scene.camera;
    CameraKey {
        eye_m: camera.eye(),
        forward: camera.forward(),
        right: camera.right(),
        up: camera.up(),
        pixel_height_m: 2.0 * (0.5 * camera.fov_y_deg.to_radians()).tan() / f64::from(height),
    }
}

fn light(scene: &Scene, resources: &Resources, camera: &CameraKey) -> LightKey {
    // A constant environment is a white cube times this factor: exact, where half floats in the cube would round.
    let constant = scene.light.constant.map_or(DVec3::ONE, |rgb| bt709_to_bt2020() * DVec3::from(rgb));
    let backdrop = match scene.view.backdrop {
        Backdrop::Environment => BackdropKey::Environment,
        Backdrop::Radiance(rgb) => BackdropKey::Colour(bt709_to_bt2020() * DVec3::from(rgb)),
    };
    let polariser = scene.view.polariser_deg.map(|angle| {
        let (sin, cos) = angle.to_radians().sin_cos();
        cos * camera.right + sin * camera.up
    });
    LightKey {
        gain: scene.light.intensity * constant,
        seen: seen_light(&resources.illuminant),
        scale: daylight_scale(),
        polariser,
        rotation_rad: scene.light.rotation_deg.to_radians(),
        backdrop,
    }
}

/// What a lamp's light is beside the scene's own.
fn lamp_light(scene: &Scene, lamp: &Lamp, own: LightKey) -> LightKey {
    let backdrop = match own.backdrop {
        BackdropKey::Environment => BackdropKey::Environment,
        // A colour behind the bubbles is seen by the scene's own light.
        BackdropKey::Colour(_) => BackdropKey::Colour(DVec3::ZERO),
    };
    LightKey { gain: DVec3::splat(scene.light.intensity), seen: seen_light(&lamp.illuminant), backdrop, ..own }
}

fn lighting(scene: &Scene, lamp: &Lamp, light: LightKey, film: &FilmMaterial, range_nm: f64) -> Lighting {
    let optics = OpticsKey { film: film.clone(), illuminant: lamp.illuminant.clone() };
    let bands = BandsKey { optics, range_nm, quality: scene.view.quality };
    let table = bands.needs_table().then(|| table(scene, lamp, &light, &bands));
    Lighting { light, environment: EnvironmentKey(lamp.environment.clone()), table, bands }
}

fn table(scene: &Scene, lamp: &Lamp, light: &LightKey, bands: &BandsKey) -> TableKey {
    let full = TableKey::full(bands.optics.clone(), bands.range_nm);
    let is_grey = |rgb: DVec3| rgb.max_element() - rgb.min_element() <= 1e-12 * rgb.max_element();
    let backdrop = match light.backdrop {
        BackdropKey::Colour(rgb) => is_grey(rgb),
        BackdropKey::Environment => true,
    };
    let neutral = lamp.environment.is_neutral() && is_grey(light.gain) && backdrop;
    TableKey { coloured: !neutral, polarised: scene.view.polariser_deg.is_some(), ..full }
}

/// What all visible films are made of.
fn material(scene: &Scene, resources: &Resources, bubbles: &[BubbleKey]) -> Result<FilmMaterial, WantError> {
    let mut films = bubbles.iter().map(|bubble| &scene.bubbles[bubble.index].film);
    let Some(first) = films.next() else { return Ok(FilmMaterial::default()) };
    if films.any(|film| (&film.index, film.skin_nm) != (&first.index, first.skin_nm)) {
        return Err(WantError::MixedFilms);
    }
    Ok(FilmMaterial { index: film_index(first, resources)?, skin_nm: first.skin_nm })
}

fn film_index(film: &Film, resources: &Resources) -> Result<FilmIndex, WantError> {
    match &film.index {
        FilmIndexName::Water => Ok(FilmIndex::Water),
        FilmIndexName::Constant(n) => Ok(FilmIndex::constant(*n)?),
        FilmIndexName::Named(name) => match resources.liquids.get(name) {
            Some(liquid) => Ok(liquid.clone()),
            None => Ok(name.parse()?),
        },
    }
}

fn thickest_nm(bubble: &BubbleKey) -> f64 {
    match &bubble.film {
        FilmKey::Uniform(thickness_nm) => *thickness_nm,
        FilmKey::Field(field) => field.initial.range_nm().1,
    }
}

/// Radius in pixels below which a film's field cannot be seen: it is drawn with its mean thickness.
const SMALLEST_FIELD_PIXELS: f64 = 0.75;

/// A bubble as the picture sees it, if any pixel can.
fn visible(scene: &Scene, camera: &CameraKey, shot: &Shot, index: usize, bubble: &Bubble) -> Option<BubbleKey> {
    let ticks = shot.moment.tick as f64 + shot.moment.fraction;
    let centre_m = centre_path(scene, index, bubble).at(ticks * scene.motion.tick_s).place_m;
    let radius_m = bubble.radius_mm * 1e-3;
    let life = life(scene, index, shot.moment)?;
    // The bath holds a bubble's foot, and its oscillation is that of no sphere.
    let is_held = bubble.boundary == Boundary::Bath;
    let stretch = if is_held { DMat3::IDENTITY } else { shape(scene, index, bubble, &life).stretch() };
    let bounds = bounds(camera, shot.size, centre_m, radius_m * reach(stretch))?;
    let distance = centre_m.distance(camera.eye_m).max(radius_m);
    let radius_pixels = radius_m / distance / camera.pixel_height_m;
    let film = match film(scene, index, bubble, &life) {
        FilmKey::Field(_) if radius_pixels < SMALLEST_FIELD_PIXELS => FilmKey::Uniform(bubble.film.thickness_nm),
        film => film,
    };
    let ticks = life.moment.tick as f64 + life.moment.fraction;
    let rates = since(life.born, &evaporation(scene, radius_m));
    Some(BubbleKey {
        index,
        centre_m,
        radius_m,
        stretch,
        bounds,
        // A film of one thickness looks the same however it is turned.
        to_film: match film {
            FilmKey::Uniform(_) => DMat3::IDENTITY,
            FilmKey::Field(_) => DMat3::from_quat(film_turn(scene, life.born as f64 + ticks).inverse()),
        },
        thinned_nm: evaporated_nm(&rates, scene.motion.tick_s, ticks),
        samples: samples(radius_pixels).max(if bubble.boundary == Boundary::Ring { RING_SAMPLES } else { 1 }),
        // The edge of a hole is no thickness between others.
        filtered: life.hole.is_none() && is_filtered(&film, radius_pixels),
        magnified: is_magnified(&film, radius_m, radius_pixels, centre_m.distance(camera.eye_m)),
        film,
        hole: life.hole,
        cap: cap(bubble),
    })
}

/// Pixels that a cell of a film must span for the film to be looked up at each pixel: below that, a cell is interpolated well enough.
const MAGNIFIED_CELL_PIXELS: f64 = 3.0;

fn is_magnified(film: &FilmKey, radius_m: f64, radius_pixels: f64, distance_m: f64) -> bool {
    let FilmKey::Field(field) = film else { return false };
    // From inside, and for the nearest point from outside, the film is nearer than the centre.
    let nearest_m = (distance_m - radius_m).abs().max(1e-3 * radius_m);
    let magnification = (distance_m.max(radius_m) / nearest_m).min(16.0);
    field.scheme.keeps_map() && field.cell_angle() * radius_pixels * magnification > MAGNIFIED_CELL_PIXELS
}

/// Whether a pixel spans more than a cell of a film, which may then change by much of a fringe across it. Several samples a pixel
/// see that better than a filter which takes the film to change evenly from pixel to pixel.
fn is_filtered(film: &FilmKey, radius_pixels: f64) -> bool {
    let is_finer = matches!(film, FilmKey::Field(field) if field.cell_angle() * radius_pixels < 1.0);
    is_finer && samples(radius_pixels) == 1
}

/// How far all films have turned as a whole at a time in ticks.
#[must_use]
pub fn film_turn(scene: &Scene, ticks: f64) -> DQuat {
    let starts: Vec<u64> = changes(scene).collect();
    let ends = starts.iter().skip(1).map(|tick| *tick as f64).chain(std::iter::once(f64::INFINITY));
    starts.iter().zip(ends).fold(DQuat::IDENTITY, |turn, (start, end)| {
        let motion: Motion = scene.motion_at(*start);
        let seconds = (ticks.min(end) - *start as f64).max(0.0) * motion.tick_s;
        DQuat::from_scaled_axis(DVec3::from(motion.spin_deg_s) * (std::f64::consts::PI / 180.0) * seconds) * turn
    })
}

fn scheme(motion: &Motion) -> Scheme {
    match motion.scheme {
        TransportScheme::Bilinear => Scheme::Bilinear,
        TransportScheme::Bicubic => Scheme::Bicubic,
        TransportScheme::Bfecc => Scheme::Bfecc,
        TransportScheme::Map => Scheme::Map,
        TransportScheme::MapAccurate => Scheme::MapAccurate,
    }
}

/// Samples along a pixel's side of a film that ends on a ring: its edge is not smoothed otherwise.
const RING_SAMPLES: u32 = 2;

/// Samples along a pixel's side: bubbles of few pixels need more, for their film and their reflections are finer than a pixel. About as many
/// rays meet every such bubble, 50 000 to 80 000, a quarter of what a bubble takes that fills a picture of 1280 x 720.
fn samples(radius_pixels: f64) -> u32 {
    match radius_pixels {
        r if r < 9.0 => 16,
        r if r < 13.0 => 12,
        r if r < 18.0 => 8,
        r if r < 26.0 => 6,
        r if r < 36.0 => 4,
        r if r < 50.0 => 3,
        r if r < 64.0 => 2,
        _ => 1,
    }
}

/// What the film of a bubble of a scene is at a moment; nothing if there is no such bubble then.
#[must_use]
pub fn film_key(scene: &Scene, index: usize, moment: Moment) -> Option<FilmKey> {
    life(scene, index, moment).map(|life| film(scene, index, &scene.bubbles[index], &life))
}

/// A bubble's film as it was blown, after so many others.
pub(super) fn initial_film(bubble: &Bubble, generation: u32) -> InitialFilm {
    let film = &bubble.film;
    let (thickness_nm, stratification) = (film.thickness_nm, film.stratification);
    match film.state {
        FilmStateName::Uniform => InitialFilm::Uniform { thickness_nm },
        FilmStateName::Rest if stratification == 0.0 => InitialFilm::Uniform { thickness_nm },
        FilmStateName::Rest => InitialFilm::Rest { thickness_nm, stratification },
        FilmStateName::Blown => {
            let seed = fold_seed(film.seed.wrapping_add(generation.into()));
            InitialFilm::Blown { thickness_nm, stratification: 0.0, seed }
        }
    }
}

/// Where the film of a bubble ends, if anything lies beyond.
fn cap(bubble: &Bubble) -> Option<Cap> {
    match bubble.boundary {
        Boundary::Free | Boundary::Drop => None,
        Boundary::Bath => Some(Cap::HEMISPHERE),
        Boundary::Ring => Some(Cap::above(bubble.rim_deg.to_radians())),
    }
}

/// What the film of a bubble that was blown after so many others ends at, unless it is free.
fn film_end(bubble: &Bubble, generation: u32) -> Option<FilmEnd> {
    let rim_deg = match bubble.boundary {
        Boundary::Free => return None,
        Boundary::Bath => 90.0,
        Boundary::Ring | Boundary::Drop => bubble.rim_deg,
    };
    let regeneration = || Regeneration {
        rim: rim_deg.to_radians(),
        radius: bubble.patch_mm / bubble.radius_mm,
        amount: bubble.regeneration,
        seed: fold_seed(bubble.film.seed.wrapping_add(generation.into())),
    };
    Some(FilmEnd {
        cap: cap(bubble),
        drop_rad: (bubble.boundary == Boundary::Drop).then(|| (180.0 - rim_deg).to_radians()),
        regeneration: (bubble.regeneration > 0.0).then(regeneration),
    })
}

fn film(scene: &Scene, index: usize, bubble: &Bubble, life: &Life) -> FilmKey {
    let initial = initial_film(bubble, life.generation);
    if let InitialFilm::Uniform { thickness_nm } = initial {
        return FilmKey::Uniform(thickness_nm);
    }
    let radius_m = bubble.radius_mm * 1e-3;
    let flows: Vec<_> = flows(scene, radius_m).iter().map(|segment| (segment.from_tick, segment.law)).collect();
    let flows = since(life.born, &flows).into_iter();
    let mut key = FieldKey {
        cells: bubble.film.cells,
        initial,
        end: film_end(bubble, life.generation).map(Box::new),
        tick_s: scene.motion.tick_s,
        scheme: scheme(&scene.motion),
        remap_ticks: scene.motion.remap_ticks,
        evaporation: Vec::new(),
        flows: flows.map(|(from_tick, law)| FlowSegment { from_tick, law }).collect(),
        pushes: Vec::new(),
        path: CentrePath::default(),
        moment: life.moment,
    };
    key.moment = key.last_moved();
    // Laws that come into force later leave the film as it is: a key holds what its product depends on.
    let end = key.moment.end_tick();
    key.flows.retain(|segment| segment.from_tick < end);
    if key.flows.iter().any(|segment| matches!(segment.law, FlowLaw::Free(_))) {
        key.evaporation = since(life.born, &evaporation(scene, radius_m));
        key.evaporation.retain(|(tick, _)| *tick < end);
        key.pushes = pushes(scene, index, bubble, life.born);
        key.pushes.retain(|push| push.ticks.start < end);
        key.path = path_since(life.born, scene, index, bubble, radius_m).until(end as f64 * key.tick_s);
    }
    FilmKey::Field(key)
}

/// Where the centre of a bubble goes, in metres.
#[must_use]
pub fn centre_path(scene: &Scene, index: usize, bubble: &Bubble) -> CentrePath {
    CentrePath::new(bubble.center_m.into(), jumps(scene, index))
}

/// The same from where it is at a tick, at which it rests, from then on and seen from where it began, in a unit of length.
fn path_since(born: u64, scene: &Scene, index: usize, bubble: &Bubble, unit_m: f64) -> CentrePath {
    let born_s = born as f64 * scene.motion.tick_s;
    let in_units = |place_m: DVec3| (place_m - DVec3::from(bubble.center_m)) / unit_m;
    let jumps = jumps(scene, index).filter(|(time_s, _)| *time_s >= born_s);
    let start = in_units(centre_path(scene, index, bubble).at(born_s).place_m);
    CentrePath::new(start, jumps.map(|(time_s, place_m)| (time_s - born_s, in_units(place_m))))
}

/// How far from round a bubble has been pushed, by the air that it is dragged through and by jets.
fn shape(scene: &Scene, index: usize, bubble: &Bubble, life: &Life) -> Shape {
    let tick_s = scene.motion.tick_s;
    let oscillator = Oscillator::new(bubble.radius_mm * 1e-3, 1e-9 * bubble.film.thickness_nm);
    let now_s = (life.moment.tick as f64 + life.moment.fraction) * tick_s;
    let dragged = oscillator.along(&path_since(life.born, scene, index, bubble, 1.0), now_s);
    let jets = scene.events.iter().filter_map(|event| match &event.change {
        Change::Blow(blow) if blow.bubble == index && event.tick >= life.born => {
            let to_world = film_turn(scene, event.tick as f64);
            let [at, toward] = [blow.at, blow.toward].map(|vector| to_world * DVec3::from(vector).normalize());
            let sharpness = Push::sharpness_of(blow.radius_deg.to_radians());
            let push = oscillator.jet_push(at, sharpness, toward, blow.speed_m_s);
            let since_s = now_s - (event.tick - life.born) as f64 * tick_s;
            Some(oscillator.after_push(push, blow.ticks as f64 * tick_s, since_s))
        }
        _ => None,
    });
    jets.fold(dragged, |sum, jet| sum + jet)
}

/// Where a bubble is dragged, from when on, in seconds.
fn jumps(scene: &Scene, index: usize) -> impl Iterator<Item = (f64, DVec3)> {
    scene.events.iter().filter_map(move |event| match &event.change {
        Change::Drag(drag) if drag.bubble == index => {
            Some((event.tick as f64 * scene.motion.tick_s, DVec3::from(drag.to_m)))
        }
        _ => None,
    })
}

/// What pushes the film of a bubble that was blown at a tick, from which its ticks count.
fn pushes(scene: &Scene, index: usize, bubble: &Bubble, born: u64) -> Vec<PushKey> {
    let of_bubble = scene.events.iter().filter(|event| event.change.bubble() == Some(index));
    let pushes = of_bubble.filter_map(|event| {
        let (push, ticks) = match &event.change {
            Change::Stir(stir) => (stir_push(stir, bubble, scene.motion.tick_s), stir.ticks),
            Change::Blow(blow) => (blow_push(blow, bubble), blow.ticks),
            _ => return None,
        };
        let end = event.tick.saturating_add(ticks);
        (end > born).then(|| PushKey { push, ticks: event.tick.saturating_sub(born)..end - born })
    });
    pushes.collect()
}

/// The rate of a stir times its duration: half of a push is taken up by the film's tension and some is carried away, so that a film at rest
/// gets four fifths of the velocity in the middle.
const STIR: f64 = 6.0;

fn stir_push(stir: &Stir, bubble: &Bubble, tick_s: f64) -> Push {
    Push {
        centre: DVec3::from(stir.at).normalize(),
        sharpness: Push::sharpness_of(stir.radius_deg.to_radians()),
        velocity: DVec3::from(stir.velocity_m_s) / (bubble.radius_mm * 1e-3),
        rate: STIR / (stir.ticks as f64 * tick_s),
    }
}

/// A jet's boundary layer, on one side of the film, as long as the jet is wide; on film of the bubble's mean thickness.
fn blow_push(blow: &Blow, bubble: &Bubble) -> Push {
    let radius_m = bubble.radius_mm * 1e-3;
    let half_angle = blow.radius_deg.to_radians();
    Push {
        centre: DVec3::from(blow.at).normalize(),
        sharpness: Push::sharpness_of(half_angle),
        velocity: blow.speed_m_s / radius_m * DVec3::from(blow.toward).normalize(),
        rate: 0.5 * air_drag(1e-9 * bubble.film.thickness_nm, blow.speed_m_s, half_angle * radius_m),
    }
}

/// A scene's seed as the generators take it: seeds below 2³² are themselves.
pub(super) fn fold_seed(seed: u64) -> u32 {
    (seed ^ (seed >> 32)) as u32
}

/// Ticks at which the motion may change, the first included.
fn changes(scene: &Scene) -> impl Iterator<Item = u64> {
    let changing = scene.events.iter().filter(|event| matches!(event.change, Change::Motion(_)));
    std::iter::once(0).chain(changing.map(|event| event.tick))
}

/// What evaporates from the film of a bubble, in nm/s, from which tick on, each entry where it differs from the one before.
pub(super) fn evaporation(scene: &Scene, radius_m: f64) -> Vec<(u64, f64)> {
    let rate = |tick| {
        let motion = scene.motion_at(tick);
        motion.evaporation_nm_s + 1e9 * evaporation_rate(motion.humidity, radius_m, motion.air_speed_m_s)
    };
    let mut rates: Vec<(u64, f64)> = changes(scene).map(|tick| (tick, rate(tick))).collect();
    rates.dedup_by_key(|(_, rate)| *rate);
    rates
}

/// The laws that drive the film of a bubble, in order, each where it differs from the one before.
fn flows(scene: &Scene, radius_m: f64) -> Vec<FlowSegment> {
    let mut flows: Vec<FlowSegment> = Vec::new();
    for from_tick in changes(scene) {
        let motion = scene.motion_at(from_tick);
        let (strength, seed) = (motion.strength, fold_seed(motion.seed));
        let law = match motion.flow {
            Flow::Free => FlowLaw::Free(free_flow(&motion, radius_m)),
            _ if strength == 0.0 => FlowLaw::Rest,
            Flow::Rest => FlowLaw::Rest,
            Flow::Sloshing => FlowLaw::Sloshing { strength, seed },
            Flow::Draught => FlowLaw::Draught { strength, seed },
            Flow::Stirred => FlowLaw::Stirred { strength, seed },
        };
        if flows.last().is_none_or(|last| last.law != law) {
            flows.push(FlowSegment { from_tick, law });
        }
    }
    flows
}

/// What a free film is subject to, with the radius as the unit of length.
fn free_flow(motion: &Motion, radius_m: f64) -> FreeFlow {
    FreeFlow {
        forces: FlowForces {
            gravity: DVec3::from(motion.gravity_m_s2) / radius_m,
            drag: motion.drag_1_s,
            air_drag: AIR_DRAG * motion.air_drag,
            viscosity: 1e-6 * motion.viscosity_mm2_s / radius_m.powi(2),
        },
        diffusion: 1e-6 * motion.diffusion_mm2_s / radius_m.powi(2),
        // ρ/12μ, for thickness in nm.
        drainage: 1e-18 * motion.drainage * DENSITY / (12.0 * VISCOSITY),
        draught: motion.strength,
        seed: fold_seed(motion.seed),
    }
}

/// Bounding rectangle of a sphere's outline in clip coordinates with a pixel of margin, cut to the picture; nothing if it is outside.
fn bounds(camera: &CameraKey, size: [u32; 2], centre_m: DVec3, radius_m: f64) -> Option<[DVec2; 2]> {
    let offset = centre_m - camera.eye_m;
    let depth = offset.dot(camera.forward);
    if depth < -radius_m {
        return None;
    }
    let half = size.map(|pixels| 0.5 * f64::from(pixels) * camera.pixel_height_m);
    let margin = DVec2::new(2.0 / f64::from(size[0]), 2.0 / f64::from(size[1]));
    let x = span(offset.dot(camera.right), depth, radius_m).map(|x| x / half[0]);
    let y = span(offset.dot(camera.up), depth, radius_m).map(|y| y / half[1]);
    let low = (DVec2::new(x[0], y[0]) - margin).max(DVec2::NEG_ONE);
    let high = (DVec2::new(x[1], y[1]) + margin).min(DVec2::ONE);
    (low.x < high.x && low.y < high.y).then_some([low, high])
}

/// Where the two lines from the eye that touch a circle cross the line one metre before it: the circle's projection.
/// Everything if the circle reaches behind the eye.
fn span(across: f64, depth: f64, radius: f64) -> [f64; 2] {
    if depth <= radius {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    let tangent = (across * across + depth * depth - radius * radius).sqrt();
    let edge = |side: f64| (across * tangent + side * depth * radius) / (depth * tangent - side * across * radius);
    [edge(-1.0), edge(1.0)]
}
