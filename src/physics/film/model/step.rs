//! What acts on a film during a step.

use super::{BlackeningLaw, DrainLaw};
use crate::physics::{
    film::{FlowLaw, Push},
    flow::FlowForces,
};

/// One step of a film: how long it lasts and what acts on it.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmStep {
    /// When it begins, s.
    pub from_s: f64,
    /// Ticks that it lasts.
    pub ticks: u32,
    /// Length of a tick, s.
    pub tick_s: f64,
    /// What drives the film.
    pub law: FlowLaw,
    /// The steps of a film's own flow, in order; empty for other films.
    pub parts: Vec<FreePart>,
    /// How the film drains, if it does, and the maximum ticks between two remaps that this allows.
    pub drain: Option<(DrainLaw, u32)>,
    /// How it collapses to black film, if any of it may.
    pub blackening: Option<BlackeningLaw>,
}

/// One step of a film's own flow.
#[derive(Clone, Debug, PartialEq)]
pub struct FreePart {
    /// When it begins, s.
    pub from_s: f64,
    /// How long it lasts, s.
    pub dt_s: f64,
    /// Gravity less the bubble's acceleration, drag and viscosity.
    pub forces: FlowForces,
    /// What pushes the film.
    pub pushes: Vec<Push>,
    /// What has evaporated from the film by the middle of the step, nm.
    pub evaporated_nm: f64,
    /// Thickness at which evaporation ends, nm.
    pub black_nm: f64,
    /// How fast the film may shear and turn because of what has pushed it, 1/s.
    pub strain: f64,
}

impl FreePart {
    /// The thickness that the flow takes thicknesses relative to, nm: the mean of what is left of film of a mean thickness in nm, but black
    /// film at least.
    #[must_use]
    pub fn reference_nm(&self, mean_nm: f64) -> f64 {
        (mean_nm - self.evaporated_nm).max(self.black_nm)
    }
}
