//! What pushes a film from outside: something that moves over it, or a jet of air.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use crate::physics::flow::FlowForces;

/// A pull of the film's velocity u towards a given one around a point: the force `rate g (V − u)` a mass, `g = exp(κ (c·x − 1))`.
///
/// The film is incompressible, so only the force's curl moves it. V is constant in space, and `n·curl(g V) = n·(∇g × V)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// The point c, a unit vector.
    pub center: DVec3,
    /// Sharpness κ; see [`Push::sharpness_of`].
    pub sharpness: f64,
    /// The velocity V, rad/s. Its part along the center pushes nothing.
    pub velocity: DVec3,
    /// Rate in the middle, 1/s.
    pub rate: f64,
}

/// A push as shaders read it: see `shaders/pass/flow_push.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FrozenPush {
    /// Center.
    pub center: [f32; 3],
    /// Sharpness.
    pub sharpness: f32,
    /// Velocity, rad/s.
    pub velocity: [f32; 3],
    /// Rate, 1/s.
    pub rate: f32,
}

impl Push {
    /// The κ of a push that is half as strong at an angle in radians from its center.
    #[must_use]
    pub fn sharpness_of(half_angle: f64) -> f64 {
        std::f64::consts::LN_2 / (1.0 - half_angle.cos())
    }

    /// The source of vorticity that it is at unit vector `x`, 1/s², where the film moves with `u` in rad/s and has vorticity `zeta` in 1/s:
    /// `n·curl` of the force, `rate g (κ x·(c × (V − u)) − ζ)`.
    #[must_use]
    pub fn source(&self, x: DVec3, u: DVec3, zeta: f64) -> f64 {
        let strength = self.rate * (self.sharpness * (self.center.dot(x) - 1.0)).exp();
        strength * (self.sharpness * x.dot(self.center.cross(self.velocity - u)) - zeta)
    }

    /// This push for a step of `dt_s` seconds in which it acts for `acting_s`: the rate that an explicit step must have for a push alone
    /// to do exactly what it does. It never exceeds 1/`dt_s`, so that no push is too strong for any step.
    #[must_use]
    pub fn in_step(&self, acting_s: f64, dt_s: f64) -> Self {
        Self { rate: -(-self.rate * acting_s).exp_m1() / dt_s, ..*self }
    }

    /// How fast a film shears and turns after the push has acted for a number of seconds, 1/s: V over the length 1/√κ, as far as it has
    /// come. The largest vorticity of a film that was pushed from rest is 0.4 to 1 times this.
    #[must_use]
    pub fn strain(&self, acting_s: f64) -> f64 {
        let along = self.velocity.reject_from(self.center).length();
        along * self.sharpness.sqrt() * -(-self.rate * acting_s).exp_m1()
    }

    /// Fraction of the strain that drag and viscosity leave after a number of seconds: a vortex pair keeps its impulse in the plane but for drag, and
    /// spreads as heat does, from a width of 1/√κ to √(1/κ + 2νt).
    #[must_use]
    pub fn remaining_strain(&self, seconds: f64, forces: &FlowForces) -> f64 {
        (-forces.drag * seconds).exp() * (1.0 + 2.0 * forces.viscosity * self.sharpness * seconds).powf(-1.5)
    }

    /// The push for upload.
    #[must_use]
    pub fn frozen(&self) -> FrozenPush {
        FrozenPush {
            center: self.center.as_vec3().to_array(),
            sharpness: self.sharpness as f32,
            velocity: self.velocity.as_vec3().to_array(),
            rate: self.rate as f32,
        }
    }
}

/// Part of the velocity of a short push that a film at rest gains in the middle, of what a film without pressure would:
/// `1/2 − (1 − e^(−2κ)) / 4κ`.
///
/// The other half is a gradient, which the film's tension takes up. From ψ(x) = ∫ ln(1 − x·y) ζ(y) dy / 4π, whose gradient at c is
/// −∫ ζ y / (1 − c·y) dy / 4π, with the source of [`Push::source`] for ζ.
#[must_use]
pub fn gained(sharpness: f64) -> f64 {
    0.5 + (-2.0 * sharpness).exp_m1() / (4.0 * sharpness)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{
        flow::FlowSolver,
        sphere::{CubedSphere, PaddedField},
    };

    fn push(half_angle_deg: f64, rate: f64) -> Push {
        let center = DVec3::new(0.2, 0.7, 0.5).normalize();
        let velocity = center.cross(DVec3::X).normalize();
        Push { center, sharpness: Push::sharpness_of(half_angle_deg.to_radians()), velocity, rate }
    }

    #[test]
    fn it_is_half_as_strong_at_its_radius() {
        let kappa = Push::sharpness_of(0.4);
        assert!(((kappa * (0.4f64.cos() - 1.0)).exp() - 0.5).abs() < 1e-14);
    }

    #[test]
    fn the_source_is_the_curl_of_the_force() {
        let push = push(20.0, 3.0);
        // A solid rotation about an axis: its vorticity is twice its part along n.
        let turn = DVec3::new(0.4, -0.3, 0.8);
        let force = |x: DVec3| {
            let strength = push.rate * (push.sharpness * (push.center.dot(x) - 1.0)).exp();
            strength * (push.velocity - turn.cross(x))
        };
        let d = 1e-5;
        for x in [push.center, DVec3::X, DVec3::new(0.1, 0.8, 0.3).normalize(), -push.center] {
            let (e1, e2) = x.any_orthonormal_pair();
            let across = |e: DVec3, along: DVec3| {
                let at = |s: f64| force((x + s * e).normalize()).dot(along);
                (at(d) - at(-d)) / (2.0 * d)
            };
            let curl = across(e1, e2) - across(e2, e1);
            let source = push.source(x, turn.cross(x), 2.0 * turn.dot(x));
            assert!((source - curl * x.dot(e1.cross(e2))).abs() < 1e-7, "{source} {curl}");
        }
    }

    /// Speed in the middle of a film at rest after a push that lasts 0.1 s, in steps of 1/60 s.
    fn speed_after(push: &Push, viscosity: f64) -> DVec3 {
        let grid = CubedSphere::new(48).unwrap();
        let mut solver = FlowSolver::new(grid, |_| 0.0);
        let still = PaddedField::from_cells(grid, solver.halo(), |_| 0.0);
        let dt = 1.0 / 60.0;
        for _ in 0..6 {
            let (u, zeta) = (solver.velocity().cells(), solver.zeta().cells());
            let push = push.in_step(dt, dt);
            let source = |cell: usize| push.source(grid.cell_direction(cell), u[cell], zeta[cell]);
            let forcing = PaddedField::from_cells(grid, solver.halo(), source);
            solver.stir(forcing);
            solver.step(dt, &FlowForces { viscosity, ..FlowForces::default() }, &still);
        }
        solver.velocity().bicubic(push.center)
    }

    /// The largest vorticity of a film that was pushed from rest for `pushed` steps of 1/60 s, and went on for `left_alone` more.
    fn vorticity_after(push: &Push, pushed: usize, left_alone: usize, forces: &FlowForces) -> f64 {
        let grid = CubedSphere::new(24).unwrap();
        let mut solver = FlowSolver::new(grid, |_| 0.0);
        let still = PaddedField::from_cells(grid, solver.halo(), |_| 0.0);
        let dt = 1.0 / 60.0;
        for step in 0..pushed + left_alone {
            let (u, zeta) = (solver.velocity().cells(), solver.zeta().cells());
            let push = push.in_step(if step < pushed { dt } else { 0.0 }, dt);
            let source = |cell: usize| push.source(grid.cell_direction(cell), u[cell], zeta[cell]);
            solver.stir(PaddedField::from_cells(grid, solver.halo(), source));
            solver.step(dt, forces, &still);
        }
        solver.zeta().cells().into_iter().fold(0.0, |max: f64, zeta| max.max(zeta.abs()))
    }

    #[test]
    fn a_film_turns_about_as_fast_as_its_strain_says() {
        let forces = FlowForces { drag: 2.0, viscosity: 0.04, ..FlowForces::default() };
        for (half_angle, rate) in [(20.0, 1.0), (20.0, 30.0), (45.0, 30.0)] {
            let push = push(half_angle, rate);
            for (pushed, left_alone) in [(6, 0), (12, 0), (12, 30)] {
                let strain =
                    push.strain(pushed as f64 / 60.0) * push.remaining_strain(left_alone as f64 / 60.0, &forces);
                let part = vorticity_after(&push, pushed, left_alone, &forces) / strain;
                assert!((0.4..1.1).contains(&part), "{half_angle}° at {rate}/s, {pushed} + {left_alone} steps: {part}");
            }
        }
    }

    #[test]
    fn a_short_push_leaves_the_dipole_that_it_should() {
        for half_angle in [10.0, 15.0, 40.0] {
            let push = push(half_angle, 1e-3);
            let expected = gained(push.sharpness) * push.rate * 0.1 * push.velocity;
            let found = speed_after(&push, 0.0);
            // Second differences of a bump three cells wide.
            assert!(found.distance(expected) < 0.01 * expected.length(), "{found} {expected}");
        }
    }

    #[test]
    fn a_strong_push_brings_the_film_to_its_velocity_and_no_further() {
        for (rate, min, max) in [(60.0, 0.75, 0.85), (1e4, 0.8, 1.0)] {
            let push = push(15.0, rate);
            let part = speed_after(&push, 0.0).dot(push.velocity);
            assert!((min..max).contains(&part), "rate {rate}: {part}");
        }
    }
}
