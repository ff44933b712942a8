//! What drives a film, and in steps of what length it is followed.

use glam::DVec3;

use super::{Flow, PATCH_THICKNESS, PrescribedFlow, Regeneration, patch_speed};
use crate::physics::flow::{CORRECTED_TURN, FlowForces};

/// How the film's liquid is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlowLaw {
    /// Not at all.
    Rest,
    /// By a flow in closed form.
    Prescribed {
        /// Which.
        flow: Flow,
        /// Factor on all speeds.
        strength: f64,
        /// Seed: each gives another flow.
        seed: u32,
    },
    /// By gravity and the air: vorticity and stream function are solved for.
    Free(FreeFlow),
}

/// What a free film is subject to, on the unit sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeFlow {
    /// Gravity, drag and viscosity.
    pub forces: FlowForces,
    /// Diffusion of thickness, rad²/s.
    pub diffusion: f64,
    /// Times gravity and the cube of a thickness in nm, the flux of drainage, nm rad/s; 0 for none.
    pub drainage: f64,
    /// Factor on the speed of the draught around the film.
    pub draught: f64,
    /// Seed: each gives another draught.
    pub seed: u32,
}

impl FreeFlow {
    /// The law in an accelerated bubble: gravity is less by the acceleration, in radii per second squared.
    #[must_use]
    pub fn accelerated(self, acceleration: DVec3) -> Self {
        let gravity = self.forces.gravity - acceleration;
        Self { forces: FlowForces { gravity, ..self.forces }, ..self }
    }

    /// How fast patches of a mean thickness rise from a rim, rad/s.
    #[must_use]
    pub fn patch_speed(&self, regeneration: &Regeneration) -> f64 {
        let FlowForces { gravity, drag, viscosity, .. } = self.forces;
        let lack = 1.0 - 0.5 * (PATCH_THICKNESS[0] + PATCH_THICKNESS[1]);
        let slope = gravity.z.abs() * regeneration.rim.sin();
        patch_speed(lack, regeneration.radius, slope, viscosity, drag)
    }

    /// The longest step of the flow in seconds: a quarter of a radian of the fastest wave of buoyancy in film whose ln h changes by 1 a
    /// radian, at which film with 60 times as steep changes is still stable.
    #[must_use]
    pub fn longest_step_s(&self) -> f64 {
        const LONGEST_S: f64 = 1.0 / 30.0;
        (0.25 / self.forces.gravity.length().sqrt()).min(LONGEST_S)
    }

    /// Ticks in a step of the film.
    #[must_use]
    pub fn ticks_per_step(&self, tick_s: f64) -> u64 {
        (self.longest_step_s() / tick_s).max(1.0) as u64
    }
}

impl FlowLaw {
    /// The law as a velocity field; for a free film, the velocity of the air.
    #[must_use]
    pub fn prescribed(self) -> PrescribedFlow {
        match self {
            Self::Rest => PrescribedFlow::default(),
            Self::Free(free) => PrescribedFlow::draught(free.seed, free.draught),
            Self::Prescribed { flow, strength, seed } => flow.prescribed(seed, strength).unwrap_or_default(),
        }
    }

    /// How fast thickness spreads, rad²/s.
    #[must_use]
    pub fn diffusion(self) -> f64 {
        if let Self::Free(free) = self { free.diffusion } else { 0.0 }
    }

    /// Ticks in a step of the film, for a tick's length and the angle between cells: as many as keep the step accurate, and more where
    /// even those would move nothing by a thousandth of a cell.
    #[must_use]
    pub fn ticks_per_step(self, tick_s: f64, cell_angle: f64) -> u64 {
        let strength = match self {
            Self::Rest => 0.0,
            Self::Prescribed { strength, .. } => strength,
            Self::Free(free) => return free.ticks_per_step(tick_s),
        };
        // At strength 1 the fastest vortices turn by a quarter of a radian in 0.1 s, where a Runge-Kutta step errs by 1e-5 of that; the
        // swings of 2 s and more are followed by its three moments.
        let accurate_s = (0.1 / strength).min(0.2);
        (accurate_s.max(self.still_s(cell_angle)) / tick_s).max(1.0) as u64
    }

    /// Seconds in which the film moves by less than a thousandth of a cell, for the angle between cells: none for a free film, of whose
    /// speed only the device knows.
    #[must_use]
    pub fn still_s(self, cell_angle: f64) -> f64 {
        match self {
            Self::Rest => f64::INFINITY,
            Self::Free(_) => 0.0,
            _ => 1e-3 * cell_angle / self.prescribed().max_speed_bound(),
        }
    }
}

/// Steps of a flow in one step of its film at most: enough for 250 times the gravity of the Earth, or a stir of 10 m/s and 8°, on a bubble
/// of 5 cm.
const MAX_PARTS_PER_STEP: f64 = 16.0;

/// How one step of a film is divided into steps of its flow, because even a tick may be longer than those may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Steps of the flow, 1 to 16.
    pub parts: u32,
    /// Ticks that each lasts.
    pub part_ticks: f64,
    /// Part of gravity that the film feels, at most 1. Beyond the maximum number of parts, gravity is felt as far as they can follow it: such films
    /// are sorted within a tick anyway.
    pub gravity: f64,
}

impl Split {
    /// The parts of a step of a number of ticks, under the forces on a film that was pushed so hard that it may shear and turn at
    /// a rate in 1/s: see [`CORRECTED_TURN`].
    #[must_use]
    pub fn new(ticks: u32, tick_s: f64, felt: &FreeFlow, strain: f64) -> Self {
        let longest_s = felt.longest_step_s().min(CORRECTED_TURN / strain);
        let parts = (f64::from(ticks) * tick_s / longest_s).ceil().clamp(1.0, MAX_PARTS_PER_STEP);
        let part_ticks = f64::from(ticks) / parts;
        let gravity = (felt.longest_step_s() / (part_ticks * tick_s)).min(1.0).powi(2);
        Self { parts: parts as u32, part_ticks, gravity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(gravity: f64) -> FreeFlow {
        let forces = FlowForces { gravity: gravity * DVec3::NEG_Z, ..FlowForces::default() };
        FreeFlow { forces, diffusion: 0.0, drainage: 0.0, draught: 0.0, seed: 0 }
    }

    #[test]
    fn steps_are_divided_until_they_can_be_followed() {
        let tick_s = 1.0 / 60.0;
        let split = |gravity, strain| Split::new(2, tick_s, &free(gravity), strain);
        assert_eq!(split(9.8, 0.0), Split { parts: 1, part_ticks: 2.0, gravity: 1.0 });
        // A quarter of a radian of 100/s is 2.5 ms.
        assert_eq!(split(1e4, 0.0), Split { parts: 14, part_ticks: 2.0 / 14.0, gravity: 1.0 });
        assert_eq!(split(9.8, 500.0).parts, 5, "turns of 4 radians");
        let followed = split(1e6, 0.0);
        assert_eq!(followed.parts, 16);
        let longest_s = free(1e6 * followed.gravity).longest_step_s();
        assert!((longest_s / (followed.part_ticks * tick_s) - 1.0).abs() < 1e-12, "as far as the parts can follow");
    }
}
