//! What acts on the film, and what it does to vorticity in half a step: the twin of `shaders/pass/flow_force.wgsl`.
//!
//! With G gravity over the radius, α the drag of the air, u the velocity half a step ahead and F what stirs the film besides, vorticity gains
//! `S = (G + α u)·(n × ∇ ln h) + F` and loses `α ζ`. Over a time τ = ½ dt in which they hold still that is exactly
//!
//! ```text
//! ζ(τ) = e^(−ατ) ζ(0) + S (1 − e^(−ατ)) / α,     α = α₀ + A √max(|u|, u₀) / h                        (F2)
//! ```

use glam::DVec3;

#[cfg(doc)]
use crate::physics::film::properties::air_drag;

/// Length of each of the two stages of the viscous rule, over the step's: 1 − 1/√2.
pub const VISCOUS_STAGE: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// ν dt beyond which nothing is left but solid rotation, in rad²: more would only magnify the discretisation's error in that.
const MAX_VISCOUS_STEP: f64 = 2.0;

/// [`FlowForces::air_drag`] of air at 25 °C: α = ρ_a √(ν_a U/R) / (ρ h/2) is `AIR_DRAG √|u| / h` with |u| = U/R in rad/s and h in nm,
/// whatever the radius. See [`air_drag`].
pub const AIR_DRAG: f64 = 9359.0;
/// Slowest speed against the air that drag is reckoned with, rad/s: air is never quite at rest.
pub const MIN_AIR_SPEED: f64 = 0.02;

/// What acts on the film during a step, on the unit sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlowForces {
    /// Gravity, less the bubble's acceleration, over the radius: 1/s².
    pub gravity: DVec3,
    /// Drag that is the same everywhere, 1/s.
    pub drag: f64,
    /// Drag of air over the root of the speed, times the thickness: nm/√s. See [`AIR_DRAG`]; 0 for none. If it is not 0, ln h must be
    /// the logarithm of the thickness in nm.
    pub air_drag: f64,
    /// Kinematic viscosity over R², 1/s.
    pub viscosity: f64,
}

impl FlowForces {
    /// ν dt γ of one viscous stage; `None` without viscosity.
    #[must_use]
    pub fn viscous_stage(&self, dt: f64) -> Option<f64> {
        let step = (self.viscosity * dt).min(MAX_VISCOUS_STEP);
        (step > 0.0).then_some(VISCOUS_STAGE * step)
    }
}

/// What drag and buoyancy do to a cell's vorticity in half a step: exactly what they do under forces that hold still, however strong.
pub(super) struct HalfStep {
    /// What drag leaves.
    pub(super) decay: f64,
    /// What is added, 1/s.
    pub(super) push: f64,
}

impl HalfStep {
    /// For a cell's velocity, its ln h with `n × ∇ ln h`, and what stirs it besides. The air slows thin film down more than thick, which
    /// makes vorticity where liquid flows along an edge: of `−n·curl(αu)` that is `n·(u × ∇α) = α_h u·(n × ∇ ln h)`, for α_h goes as
    /// 1/h.
    pub(super) fn new(
        forces: &FlowForces,
        dt: f64,
        u: DVec3,
        (log_thickness, turned): (f64, DVec3),
        forcing: f64,
    ) -> Self {
        let of_air = forces.air_drag * u.length().max(MIN_AIR_SPEED).sqrt() * (-log_thickness).exp();
        let drag = forces.drag + of_air;
        let source = (forces.gravity + of_air * u).dot(turned) + forcing;
        let x = 0.5 * dt * drag;
        let decayed = if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 };
        Self { decay: (-x).exp(), push: 0.5 * dt * decayed * source }
    }

    pub(super) fn applied(&self, zeta: f64) -> f64 {
        self.decay * zeta + self.push
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::film::properties;

    #[test]
    fn air_drags_as_a_boundary_layer_does() {
        let (radius, speed, thickness) = (0.03, 0.2_f64, 4e-7);
        let ours = AIR_DRAG * (speed / radius).sqrt() / (1e9 * thickness);
        assert!((ours / properties::air_drag(thickness, speed, radius) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn strong_drag_leaves_the_speed_at_which_forces_balance() {
        let forces = FlowForces { gravity: DVec3::NEG_Z, drag: 500.0, ..FlowForces::default() };
        let step = HalfStep::new(&forces, 1.0, DVec3::X, (6.0, DVec3::new(0.0, 3.0, -4.0)), 1.0);
        assert!((step.applied(7.0) - 5.0 / 500.0).abs() < 1e-12);
        let none = HalfStep::new(&FlowForces { drag: 0.0, ..forces }, 0.1, DVec3::X, (6.0, DVec3::NEG_Z), 0.0);
        assert_eq!(none.applied(7.0), 7.05);
    }
}
