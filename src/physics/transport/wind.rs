//! The winds of the transport tests, in a form without poles.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3};

use super::{CaseError, unit};
use crate::words::words;

/// The period T of all winds, in time units.
pub const PERIOD: f64 = 5.0;

words! {
    /// The three winds.
    pub enum WindKind: "wind" {
        SolidBody = "sb", "Solid-body rotation, one turn in T";
        NonDivergent = "nd", "Non-divergent deformation on top of a rotation; the deformation undoes itself within T";
        Divergent = "dv", "Divergent deformation on top of a rotation; it undoes itself within T";
    }
}

/// A wind about an axis. Velocities are in radians per time unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    kind: WindKind,
    frame: DMat3,
}

impl Wind {
    /// The wind whose rotation is about `axis`, by default +x for SB (over the poles) and +z for ND and DV. ND and DV are turned
    /// by the shortest rotation that takes +z to the axis; for −z, where there is no single one, by half a turn about +x or
    /// another horizontal axis. Fails for an axis without direction.
    pub fn new(kind: WindKind, axis: Option<DVec3>) -> Result<Self, CaseError> {
        let default = if kind == WindKind::SolidBody { DVec3::X } else { DVec3::Z };
        let axis = unit(axis.unwrap_or(default), "axis")?;
        Ok(Self { kind, frame: DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis)) })
    }

    /// Which of the winds it is.
    pub fn kind(&self) -> WindKind {
        self.kind
    }

    /// The rotation from the frame in which the formulas stand (axis +z) to the world.
    pub fn frame(&self) -> DMat3 {
        self.frame
    }

    /// The rotation of the tracers that belong to this wind: they turn with ND and DV and stay where they are in SB.
    pub fn tracer_rotation(&self) -> DMat3 {
        if self.kind == WindKind::SolidBody { DMat3::IDENTITY } else { self.frame }
    }

    /// Velocity at unit vector `x` and time `t`.
    ///
    /// In the frame that turns with the background rotation (λ' = λ − 2πt/T) ND is `x × ∇ψ` with `ψ = (10/T) y² cos(πt/T)`, and DV's
    /// components are divided by cos θ by hand, so that nothing is singular at the poles.
    pub fn velocity(&self, x: DVec3, t: f64) -> DVec3 {
        let p = self.turning_frame(t).transpose() * x;
        let amplitude = (PI * t / PERIOD).cos() / PERIOD;
        let deformation = match self.kind {
            WindKind::SolidBody => DVec3::ZERO,
            WindKind::NonDivergent => 20.0 * amplitude * p.y * DVec3::new(-p.z, 0.0, p.x),
            WindKind::Divergent => {
                let cos_theta = p.x.hypot(p.y);
                let east = -5.0 * p.z * cos_theta * (cos_theta - p.x);
                let north = 2.5 * p.y * cos_theta;
                let directions =
                    [DVec3::new(-p.y, p.x, 0.0), DVec3::new(-p.z * p.x, -p.z * p.y, cos_theta * cos_theta)];
                amplitude * (east * directions[0] + north * directions[1])
            }
        };
        self.turning_frame(t) * (deformation + 2.0 * PI / PERIOD * DVec3::new(-p.y, p.x, 0.0))
    }

    /// Divergence of the velocity on the sphere at unit vector `x` and time `t`: for DV −(15/T) sin λ' sin θ cos² θ cos(πt/T).
    pub fn divergence(&self, x: DVec3, t: f64) -> f64 {
        if self.kind != WindKind::Divergent {
            return 0.0;
        }
        let p = self.turning_frame(t).transpose() * x;
        -15.0 / PERIOD * p.y * p.z * p.x.hypot(p.y) * (PI * t / PERIOD).cos()
    }

    /// Rotation from the frame that turns with the background wind to the world.
    fn turning_frame(&self, t: f64) -> DMat3 {
        self.frame * DMat3::from_rotation_z(2.0 * PI * t / PERIOD)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [WindKind; 3] = [WindKind::SolidBody, WindKind::NonDivergent, WindKind::Divergent];

    fn points() -> impl Iterator<Item = DVec3> {
        (0..200).map(|k| {
            let z: f64 = -0.985 + 0.0099 * f64::from(k);
            let longitude = 2.4 * f64::from(k);
            let cos_theta = (1.0 - z * z).sqrt();
            DVec3::new(cos_theta * longitude.cos(), cos_theta * longitude.sin(), z)
        })
    }

    /// Velocity (u east, v north) as the literature writes it.
    fn published(kind: WindKind, lambda: f64, theta: f64, t: f64) -> (f64, f64) {
        let turned = lambda - 2.0 * PI * t / PERIOD;
        let c = (PI * t / PERIOD).cos();
        let background = 2.0 * PI / PERIOD * theta.cos();
        match kind {
            WindKind::SolidBody => (background, 0.0),
            WindKind::NonDivergent => (
                10.0 / PERIOD * turned.sin().powi(2) * (2.0 * theta).sin() * c + background,
                10.0 / PERIOD * (2.0 * turned).sin() * theta.cos() * c,
            ),
            WindKind::Divergent => (
                -5.0 / PERIOD * (turned / 2.0).sin().powi(2) * (2.0 * theta).sin() * theta.cos().powi(2) * c
                    + background,
                2.5 / PERIOD * turned.sin() * theta.cos().powi(3) * c,
            ),
        }
    }

    #[test]
    fn velocities_are_the_published_ones() {
        for kind in KINDS {
            let wind = Wind::new(kind, Some(DVec3::Z)).unwrap();
            for (x, t) in points().zip((0..).map(|k| 0.05 * f64::from(k))) {
                let (lambda, theta) = (x.y.atan2(x.x), x.z.asin());
                let (u, v) = published(kind, lambda, theta, t);
                let east = DVec3::new(-lambda.sin(), lambda.cos(), 0.0);
                let north = x.cross(east);
                assert!(wind.velocity(x, t).distance(u * east + v * north) < 1e-12, "{kind:?}");
            }
        }
    }

    #[test]
    fn divergence_is_that_of_the_velocity() {
        let d = 1e-5;
        for kind in KINDS {
            let wind = Wind::new(kind, Some(DVec3::new(1.0, 2.0, -1.0))).unwrap();
            for x in points() {
                let (e1, e2) = x.any_orthonormal_pair();
                let slope = |e: DVec3| {
                    let speed = |s: f64| wind.velocity((x + s * e).normalize(), 0.9).dot(e);
                    (speed(d) - speed(-d)) / (2.0 * d)
                };
                // Central differences: truncation and rounding are both near 1e-10.
                assert!((slope(e1) + slope(e2) - wind.divergence(x, 0.9)).abs() < 1e-8, "{kind:?}");
            }
        }
    }

    #[test]
    fn the_axis_turns_the_wind() {
        let axis = DVec3::new(-0.3, 0.5, 0.2).normalize();
        let upright = Wind::new(WindKind::NonDivergent, None).unwrap();
        let tilted = Wind::new(WindKind::NonDivergent, Some(7.0 * axis)).unwrap();
        assert!((tilted.frame() * DVec3::Z).distance(axis) < 1e-15);
        assert!(tilted.frame().determinant() > 0.0);
        for x in points() {
            let turned = tilted.frame() * upright.velocity(x, 1.2);
            assert!(tilted.velocity(tilted.frame() * x, 1.2).distance(turned) < 1e-14);
        }
    }
}
