//! From a scene to what its films are at a moment: how each began, what drives and pushes it, and where its bubble goes.

use glam::{DQuat, DVec3};

use super::{
    FieldKey, FilmEnd, FilmKey, FlowLaw, FlowSegment, FreeFlow, Moment, PushKey,
    detail::film_grids,
    lives::{Life, life, since},
    thinning::Thinning,
};
use crate::{
    physics::{
        bubble::{CentrePath, Oscillator, Shape},
        film::{
            Cap, InitialFilm, Push, Regeneration,
            properties::{DENSITY, VISCOSITY, air_drag, evaporation_rate},
        },
        flow::{AIR_DRAG, FlowForces},
    },
    scene::{Blow, Bubble, Change, FilmStateName, Flow, Motion, Scene, Stir},
};

/// How far all films have turned as a whole at a time in ticks.
#[must_use]
pub fn film_turn(scene: &Scene, ticks: f64) -> DQuat {
    Turns::new(scene).at(ticks)
}

/// How films turn as a whole under each motion.
struct Turns {
    tick_s: f64,
    /// From which tick on, what they have turned by until then, and how fast they turn from then on, radians a second.
    motions: Vec<(u64, DQuat, DVec3)>,
}

impl Turns {
    fn new(scene: &Scene) -> Self {
        let mut turns = Self { tick_s: scene.motion.tick_s, motions: Vec::new() };
        for (tick, motion) in scene.motions() {
            let speed = DVec3::from(motion.spin_deg_s) * (std::f64::consts::PI / 180.0);
            turns.motions.push((tick, turns.at(tick as f64), speed));
        }
        turns
    }

    /// What films have turned by until a time in ticks.
    fn at(&self, ticks: f64) -> DQuat {
        let begun = self.motions.partition_point(|(tick, ..)| *tick as f64 <= ticks);
        let Some((tick, turn, speed)) = self.motions[..begun].last() else { return DQuat::IDENTITY };
        DQuat::from_scaled_axis(*speed * ((ticks - *tick as f64) * self.tick_s)) * *turn
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

/// Whether the film of a bubble can move: one of a single thickness looks the same however it flows.
pub(super) fn has_field(bubble: &Bubble) -> bool {
    !matches!(initial_film(bubble, 0), InitialFilm::Uniform { .. })
}

/// Where the film of a bubble ends, if anything lies beyond.
pub(super) fn cap(bubble: &Bubble) -> Option<Cap> {
    bubble.boundary.cap(bubble.rim_deg)
}

/// What the film of a bubble that was blown after so many others ends at, unless it is free.
fn film_end(bubble: &Bubble, generation: u32) -> Option<FilmEnd> {
    let rim_deg = bubble.boundary.rim_deg(bubble.rim_deg)?;
    let regeneration = || Regeneration {
        rim: rim_deg.to_radians(),
        radius: bubble.patch_mm / bubble.radius_mm,
        amount: bubble.regeneration,
        seed: fold_seed(bubble.film.seed.wrapping_add(generation.into())),
    };
    Some(FilmEnd {
        cap: cap(bubble),
        drop_rad: bubble.boundary.drop_rad(bubble.rim_deg),
        regeneration: (bubble.regeneration > 0.0).then(regeneration),
    })
}

pub(super) fn film(scene: &Scene, index: usize, bubble: &Bubble, life: &Life) -> FilmKey {
    let initial = initial_film(bubble, life.generation);
    if let InitialFilm::Uniform { thickness_nm } = initial {
        return FilmKey::Uniform(thickness_nm);
    }
    let radius_m = bubble.radius_mm * 1e-3;
    let flows: Vec<_> = flows(scene, radius_m).iter().map(|segment| (segment.from_tick, segment.law)).collect();
    let flows = since(life.born, &flows);
    let [cells, flow_cells] = film_grids(scene, index);
    let mut key = FieldKey {
        cells,
        flow_cells,
        initial,
        end: film_end(bubble, life.generation).map(Box::new),
        tick_s: scene.motion.tick_s,
        scheme: scene.motion.scheme,
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
        key.evaporation = since(life.born, &evaporation(scene, radius_m)).collect();
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
pub(super) fn shape(scene: &Scene, index: usize, bubble: &Bubble, life: &Life) -> Shape {
    let tick_s = scene.motion.tick_s;
    let oscillator = Oscillator::new(bubble.radius_mm * 1e-3, 1e-9 * bubble.film.thickness_nm);
    let now_s = (life.moment.tick as f64 + life.moment.fraction) * tick_s;
    let turns = Turns::new(scene);
    let dragged = oscillator.along(&path_since(life.born, scene, index, bubble, 1.0), now_s);
    let jets = scene.events.iter().filter_map(|event| match &event.change {
        Change::Blow(blow) if blow.bubble == index && event.tick >= life.born => {
            let to_world = turns.at(event.tick as f64);
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

/// What evaporates from the film of a bubble, nm/s.
fn evaporation_nm_s(motion: &Motion, radius_m: f64) -> f64 {
    motion.evaporation_nm_s + 1e9 * evaporation_rate(motion.humidity, radius_m, motion.air_speed_m_s)
}

/// The same, from which tick on, each entry where it differs from the one before.
pub(super) fn evaporation(scene: &Scene, radius_m: f64) -> Vec<(u64, f64)> {
    let mut rates: Vec<_> = scene.motions().map(|(tick, motion)| (tick, evaporation_nm_s(&motion, radius_m))).collect();
    rates.dedup_by_key(|(_, rate)| *rate);
    rates
}

/// What the top of a bubble's film thins by once it is sorted, from which tick on.
pub(super) fn thinning(scene: &Scene, radius_m: f64) -> Vec<(u64, Thinning)> {
    let law = |(tick, motion): (u64, Motion)| {
        let free = free_flow(&motion, radius_m);
        let drains = motion.flow == Flow::Free;
        let thinning = Thinning {
            evaporation_nm_s: evaporation_nm_s(&motion, radius_m),
            // The flux is as sin of the angle from the top, and its divergence there twice that.
            drainage_1_nm2_s: if drains { 2.0 * free.drainage * free.forces.gravity.length() } else { 0.0 },
        };
        (tick, thinning)
    };
    scene.motions().map(law).collect()
}

/// The laws that drive the film of a bubble, in order, each where it differs from the one before.
fn flows(scene: &Scene, radius_m: f64) -> Vec<FlowSegment> {
    let mut flows: Vec<FlowSegment> = Vec::new();
    for (from_tick, motion) in scene.motions() {
        let (strength, seed) = (motion.strength, fold_seed(motion.seed));
        let law = match motion.flow {
            Flow::Free => FlowLaw::Free(free_flow(&motion, radius_m)),
            _ if strength == 0.0 => FlowLaw::Rest,
            Flow::Rest => FlowLaw::Rest,
            flow => FlowLaw::Prescribed { flow, strength, seed },
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
