//! What a scene says of its bubbles, as their courses: how each film begins, what drives and pushes it, what leaves it, and what ends it.

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::{FlowLaw, FreeFlow, turns::Turns};
use crate::{
    physics::{
        bubble::{Bursting, Course, Oscillator},
        film::{
            InitialFilm, Push, Pushes, Thinning, fold_seed,
            properties::{DENSITY, VISCOSITY, air_drag, evaporation_rate},
        },
        flow::{AIR_DRAG, FlowForces},
        timeline::{Spans, Timeline},
    },
    scene::{Blow, Bubble, Change, Event, FilmStateName, Flow, Motion, Stir},
};

/// All that ever happens to bubbles that move so, by the events that befall them.
pub(super) fn courses(bubbles: &[Bubble], events: &[Event], motions: &Timeline<Motion>, turns: &Turns) -> Vec<Course> {
    let mut changes = vec![Vec::new(); bubbles.len()];
    for event in events {
        // What happens to bubbles that are not there happens to none.
        let Some(changes) = event.change.bubble().and_then(|bubble| changes.get_mut(bubble)) else { continue };
        changes.push((event.tick, &event.change));
    }
    bubbles
        .iter()
        .zip(changes)
        .enumerate()
        .map(|(index, (bubble, changes))| course(bubble, index, &changes, motions, turns))
        .collect()
}

/// What happens to one bubble.
fn course(
    bubble: &Bubble,
    index: usize,
    changes: &[(u64, &Change)],
    motions: &Timeline<Motion>,
    turns: &Turns,
) -> Course {
    let (radius_m, film) = (bubble.radius_mm * 1e-3, initial_film(bubble));
    let thickness_m = 1e-9 * film.mean_nm();
    let oscillator = Oscillator::new(radius_m, thickness_m);
    Course {
        tick_s: turns.tick_s(),
        radius_m,
        film,
        seed: bubble.film.seed,
        stream: index as u32,
        flows: Timeline::of_changes(
            motions.iter().map(|(tick, motion)| (tick, flow_law(motion, radius_m, thickness_m))),
        ),
        evaporation_nm_s: Timeline::of_changes(
            motions.iter().map(|(tick, motion)| (tick, evaporation_nm_s(motion, radius_m))),
        ),
        // In other pieces it would round to other ticks.
        thinning: motions.iter().map(|(tick, motion)| (tick, thinning(motion, radius_m, thickness_m))).collect(),
        bursting: Timeline::of_changes(motions.iter().map(|(tick, motion)| (tick, bursting(motion)))),
        pushes: pushes(bubble, changes, turns.tick_s()),
        jets: jets(oscillator, changes, turns),
        pricks: changes.iter().filter_map(prick).collect(),
        rest_m: bubble.center_m.into(),
        drags: changes.iter().filter_map(drag).collect(),
    }
}

/// A bubble's first film as it was blown.
pub(super) fn initial_film(bubble: &Bubble) -> InitialFilm {
    let film = &bubble.film;
    let (thickness_nm, stratification) = (film.thickness_nm, film.stratification);
    match film.state {
        FilmStateName::Uniform => InitialFilm::Uniform { thickness_nm },
        FilmStateName::Rest if stratification == 0.0 => InitialFilm::Uniform { thickness_nm },
        FilmStateName::Rest => InitialFilm::Rest { thickness_nm, stratification },
        FilmStateName::Blown => InitialFilm::Blown { thickness_nm, stratification: 0.0, seed: fold_seed(film.seed) },
    }
}

/// What evaporates from the film of a bubble, nm/s.
fn evaporation_nm_s(motion: &Motion, radius_m: f64) -> f64 {
    motion.evaporation_nm_s + 1e9 * evaporation_rate(motion.humidity, radius_m, motion.air_speed_m_s)
}

/// What the top of a bubble's film thins by once it is sorted.
fn thinning(motion: &Motion, radius_m: f64, thickness_m: f64) -> Thinning {
    let free = free_flow(motion, radius_m, thickness_m);
    let drains = motion.flow == Flow::Free;
    Thinning {
        evaporation_nm_s: evaporation_nm_s(motion, radius_m),
        // The flux is as sin of the angle from the top, and its divergence there twice that.
        drainage_1_nm2_s: if drains { 2.0 * free.drainage * free.forces.gravity.length() } else { 0.0 },
    }
}

fn bursting(motion: &Motion) -> Bursting {
    let Motion { black_film_life_s, burst_slowdown: slowdown, renew_s, .. } = *motion;
    Bursting { black_film_life_s, slowdown, renew_s }
}

/// The law that drives the film of a bubble.
fn flow_law(motion: &Motion, radius_m: f64, thickness_m: f64) -> FlowLaw {
    let (strength, seed) = (motion.strength, fold_seed(motion.seed));
    match motion.flow {
        Flow::Free => FlowLaw::Free(free_flow(motion, radius_m, thickness_m)),
        _ if strength == 0.0 => FlowLaw::Rest,
        Flow::Rest => FlowLaw::Rest,
        flow => FlowLaw::Prescribed { flow, strength, seed },
    }
}

/// What a free film is subject to that is blown with a mean thickness, with the radius as the unit of length.
fn free_flow(motion: &Motion, radius_m: f64, thickness_m: f64) -> FreeFlow {
    FreeFlow {
        forces: FlowForces {
            gravity: DVec3::from(motion.gravity_m_s2) / radius_m,
            drag: motion.drag_1_s,
            air_drag: AIR_DRAG * motion.air_drag,
            viscosity: motion.film_viscosity_m2_s(thickness_m) / radius_m.powi(2),
        },
        diffusion: 1e-6 * motion.diffusion_mm2_s / radius_m.powi(2),
        // ρ/12μ, for thickness in nm.
        drainage: 1e-18 * motion.drainage * DENSITY / (12.0 * VISCOSITY),
        draught: motion.strength,
        seed: fold_seed(motion.seed),
    }
}

/// What pushes the film of a bubble.
fn pushes(bubble: &Bubble, changes: &[(u64, &Change)], tick_s: f64) -> Pushes {
    let push = |(tick, change): &(u64, &Change)| match change {
        Change::Stir(stir) => Some((lasting(*tick, stir.ticks), stir_push(stir, bubble, tick_s))),
        Change::Blow(blow) => Some((lasting(*tick, blow.ticks), blow_push(blow, bubble))),
        _ => None,
    };
    changes.iter().filter_map(push).collect()
}

fn lasting(tick: u64, ticks: u64) -> Range<u64> {
    tick..tick.saturating_add(ticks)
}

/// How jets dent a bubble that oscillates so.
fn jets(oscillator: Oscillator, changes: &[(u64, &Change)], turns: &Turns) -> Spans<DMat3> {
    let jet = |(tick, change): &(u64, &Change)| {
        let Change::Blow(blow) = change else { return None };
        let to_world = turns.at(*tick as f64);
        let [at, toward] = [blow.at, blow.toward].map(|vector| to_world * DVec3::from(vector).normalize());
        let sharpness = Push::sharpness_of(blow.radius_deg.to_radians());
        Some((lasting(*tick, blow.ticks), oscillator.jet_push(at, sharpness, toward, blow.speed_m_s)))
    };
    changes.iter().filter_map(jet).collect()
}

fn prick((tick, change): &(u64, &Change)) -> Option<(u64, DVec3)> {
    let Change::Prick(prick) = change else { return None };
    Some((*tick, DVec3::from(prick.at).normalize()))
}

fn drag((tick, change): &(u64, &Change)) -> Option<(u64, DVec3)> {
    let Change::Drag(drag) = change else { return None };
    Some((*tick, drag.to_m.into()))
}

/// The rate of a stir times its duration: half of a push is taken up by the film's tension and some is carried away, so that a film at rest
/// gets four fifths of the velocity in the middle.
const STIR: f64 = 6.0;

fn stir_push(stir: &Stir, bubble: &Bubble, tick_s: f64) -> Push {
    Push {
        center: DVec3::from(stir.at).normalize(),
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
        center: DVec3::from(blow.at).normalize(),
        sharpness: Push::sharpness_of(half_angle),
        velocity: blow.speed_m_s / radius_m * DVec3::from(blow.toward).normalize(),
        rate: 0.5 * air_drag(1e-9 * bubble.film.thickness_nm, blow.speed_m_s, half_angle * radius_m),
    }
}
