//! What a scene says of its films: how each begins, what drives it, and what leaves it.

use glam::DVec3;

use super::{FlowLaw, FlowSegment, FreeFlow, thinning::Thinning};
use crate::{
    physics::{
        film::{
            InitialFilm,
            properties::{DENSITY, VISCOSITY, evaporation_rate},
        },
        flow::{AIR_DRAG, FlowForces},
    },
    scene::{Bubble, FilmStateName, Flow, Motion, Scene},
};

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
pub(super) fn flows(scene: &Scene, radius_m: f64) -> Vec<FlowSegment> {
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
