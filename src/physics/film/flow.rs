//! Prescribed flow (model T1): a divergence-free velocity in closed form, with the same value at every evaluation.

use std::f64::consts::TAU;

use bytemuck::{Pod, Zeroable};
use glam::{DQuat, DVec3};
use thiserror::Error;

/// Waves that one flow can have.
pub const MAX_WAVES: usize = 32;
/// Vortices that one flow can have.
pub const MAX_VORTICES: usize = 64;

/// Why a flow could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "a flow of {waves} waves and {vortices} vortices is too large: use at most {MAX_WAVES} waves and {MAX_VORTICES} vortices"
)]
pub struct FlowError {
    waves: usize,
    vortices: usize,
}

/// A wave of the stream function, `A cos(ωt + φ) sin(k·x + p + σt)`, on the unit sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Wave vector k, in radians per radius.
    pub k: DVec3,
    /// Phase p, radians.
    pub phase: f64,
    /// Amplitude A, rad/s of flow for |k| = 1.
    pub amplitude: f64,
    /// Rate σ at which the pattern runs along k, rad/s.
    pub drift_rad_s: f64,
    /// Angular frequency ω of its oscillation, rad/s; 0 for a steady one.
    pub swing_rad_s: f64,
    /// Phase φ of the swing, radians.
    pub swing_phase: f64,
}

/// A vortex of the stream function, `G cos(ωt + φ) exp(κ (c(t)·x − 1))`; its fastest ring has an angular radius near 1/√κ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vortex {
    /// Its center c at time 0, a unit vector.
    pub center: DVec3,
    /// The unit vector about which the center turns.
    pub turn_axis: DVec3,
    /// How fast it turns, rad/s.
    pub turn_rad_s: f64,
    /// Strength G: the value of the stream function at the center, rad/s.
    pub strength: f64,
    /// Sharpness κ.
    pub sharpness: f64,
    /// Angular frequency ω of its oscillation, rad/s; 0 for a steady one.
    pub swing_rad_s: f64,
    /// Phase φ of the swing, radians.
    pub swing_phase: f64,
}

/// A wave at one moment, as shaders read it: `amplitude · sin(k·x + phase)`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FrozenWave {
    /// Wave vector.
    pub k: [f32; 3],
    /// Phase, within 0 to 2π.
    pub phase: f32,
    /// Amplitude with its swing.
    pub amplitude: f32,
    /// Fills 32 bytes.
    pub padding: [f32; 3],
}

/// A vortex at one moment, as shaders read it: `strength · exp(sharpness · (center·x − 1))`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FrozenVortex {
    /// Center, a unit vector.
    pub center: [f32; 3],
    /// Sharpness κ.
    pub sharpness: f32,
    /// Strength with its swing.
    pub strength: f32,
    /// Fills 32 bytes.
    pub padding: [f32; 3],
}

/// A flow at one moment: at most [`MAX_WAVES`] waves and [`MAX_VORTICES`] vortices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrozenFlow {
    /// The waves.
    pub waves: Vec<FrozenWave>,
    /// The vortices.
    pub vortices: Vec<FrozenVortex>,
}

/// A flow given by its stream function ψ, a sum of waves and vortices: `u = x × ∇ψ`. The default one is at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrescribedFlow {
    pub(super) waves: Vec<Wave>,
    pub(super) vortices: Vec<Vortex>,
}

impl PrescribedFlow {
    /// The flow of these waves and vortices. Fails if there are more than [`MAX_WAVES`] or [`MAX_VORTICES`].
    pub fn new(waves: Vec<Wave>, vortices: Vec<Vortex>) -> Result<Self, FlowError> {
        if waves.len() > MAX_WAVES || vortices.len() > MAX_VORTICES {
            return Err(FlowError { waves: waves.len(), vortices: vortices.len() });
        }
        Ok(Self { waves, vortices })
    }

    /// Its waves.
    pub fn waves(&self) -> &[Wave] {
        &self.waves
    }

    /// Its vortices.
    pub fn vortices(&self) -> &[Vortex] {
        &self.vortices
    }

    /// The stream function at unit vector `x` and time `t` in seconds, rad/s.
    pub fn stream_function(&self, x: DVec3, t: f64) -> f64 {
        let waves = self.waves.iter().map(|wave| wave.amplitude_at(t) * wave.angle(x, t).sin());
        let vortices = self.vortices.iter().map(|vortex| vortex.value(x, vortex.center_at(t), t));
        waves.sum::<f64>() + vortices.sum::<f64>()
    }

    /// Velocity at unit vector `x` and time `t` in seconds, rad/s, tangent to the sphere and free of divergence.
    pub fn velocity(&self, x: DVec3, t: f64) -> DVec3 {
        let waves = self.waves.iter().map(|wave| wave.amplitude_at(t) * wave.angle(x, t).cos() * wave.k);
        let vortices = self.vortices.iter().map(|vortex| {
            let center = vortex.center_at(t);
            vortex.sharpness * vortex.value(x, center, t) * center
        });
        x.cross(waves.sum::<DVec3>() + vortices.sum::<DVec3>())
    }

    /// Vorticity at unit vector `x` and time `t` in seconds, 1/s: the Laplacian on the sphere of the stream function, which is that in space less
    /// the second derivative along x and twice the first.
    pub fn vorticity(&self, x: DVec3, t: f64) -> f64 {
        let waves = self.waves.iter().map(|wave| {
            let (along, angle) = (wave.k.dot(x), wave.angle(x, t));
            -wave.amplitude_at(t)
                * ((wave.k.length_squared() - along * along) * angle.sin() + 2.0 * along * angle.cos())
        });
        let vortices = self.vortices.iter().map(|vortex| {
            let (center, kappa) = (vortex.center_at(t), vortex.sharpness);
            let along = center.dot(x);
            vortex.value(x, center, t) * kappa * (kappa * (1.0 - along * along) - 2.0 * along)
        });
        waves.sum::<f64>() + vortices.sum::<f64>()
    }

    /// The flow at time `t` in seconds for upload; phases are reduced first, so that f32 serves at any time.
    pub fn frozen_at(&self, t: f64) -> FrozenFlow {
        FrozenFlow {
            waves: self.waves.iter().map(|wave| wave.frozen_at(t)).collect(),
            vortices: self.vortices.iter().map(|vortex| vortex.frozen_at(t)).collect(),
        }
    }

    /// A speed in rad/s that the flow exceeds nowhere and never. It adds up all peaks, so a flow of many vortices stays far below.
    pub fn max_speed_bound(&self) -> f64 {
        let waves = self.waves.iter().map(|wave| wave.amplitude.abs() * wave.k.length());
        waves.sum::<f64>() + self.vortices.iter().map(Vortex::peak_speed).sum::<f64>()
    }

    /// Root mean square and largest speed in rad/s at time `t` in seconds, over 512 directions spread evenly.
    pub fn speeds_at(&self, t: f64) -> (f64, f64) {
        const DIRECTIONS: u32 = 512;
        let squares = (0..DIRECTIONS).map(|k| self.velocity(fibonacci_direction(k, DIRECTIONS), t).length_squared());
        let (sum, max) = squares.fold((0.0, 0.0), |(sum, max): (f64, f64), square| (sum + square, max.max(square)));
        ((sum / f64::from(DIRECTIONS)).sqrt(), max.sqrt())
    }
}

impl Wave {
    fn amplitude_at(&self, t: f64) -> f64 {
        self.amplitude * (self.swing_rad_s * t + self.swing_phase).cos()
    }

    fn angle(&self, x: DVec3, t: f64) -> f64 {
        self.k.dot(x) + self.phase + self.drift_rad_s * t
    }

    fn frozen_at(&self, t: f64) -> FrozenWave {
        FrozenWave {
            k: self.k.as_vec3().to_array(),
            phase: (self.phase + self.drift_rad_s * t).rem_euclid(TAU) as f32,
            amplitude: self.amplitude_at(t) as f32,
            padding: [0.0; 3],
        }
    }
}

impl Vortex {
    fn center_at(&self, t: f64) -> DVec3 {
        DQuat::from_axis_angle(self.turn_axis, self.turn_rad_s * t) * self.center
    }

    fn strength_at(&self, t: f64) -> f64 {
        self.strength * (self.swing_rad_s * t + self.swing_phase).cos()
    }

    fn value(&self, x: DVec3, center: DVec3, t: f64) -> f64 {
        self.strength_at(t) * (self.sharpness * (center.dot(x) - 1.0)).exp()
    }

    /// The largest speed of its own, at full swing: κ G sin ϑ exp(κ (cos ϑ − 1)) peaks where κ cos² ϑ + cos ϑ = κ.
    pub(super) fn peak_speed(&self) -> f64 {
        let kappa = self.sharpness;
        let cos = 2.0 * kappa / (1.0 + (1.0 + 4.0 * kappa * kappa).sqrt());
        (kappa * self.strength).abs() * (1.0 - cos * cos).sqrt() * (kappa * (cos - 1.0)).exp()
    }

    fn frozen_at(&self, t: f64) -> FrozenVortex {
        FrozenVortex {
            center: self.center_at(t).as_vec3().to_array(),
            sharpness: self.sharpness as f32,
            strength: self.strength_at(t) as f32,
            padding: [0.0; 3],
        }
    }
}

/// The k-th of `count` directions on a spiral of equal areas (Swinbank & Purser 2006, Q. J. R. Meteorol. Soc. 132).
fn fibonacci_direction(k: u32, count: u32) -> DVec3 {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
    let (sin, cos) = (GOLDEN_ANGLE * f64::from(k)).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cos, radius * sin, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn directions() -> impl Iterator<Item = DVec3> {
        (0..100).map(|k| fibonacci_direction(k, 100))
    }

    #[test]
    fn velocity_is_tangent_and_divergence_free() {
        let flow = PrescribedFlow::stirred(3, 1.0);
        let d = 1e-4;
        for x in directions() {
            let (e1, e2) = x.any_orthonormal_pair();
            let slope = |e: DVec3| {
                let speed = |s: f64| flow.velocity((x + s * e).normalize(), 1.7).dot(e);
                (speed(d) - speed(-d)) / (2.0 * d)
            };
            assert!(flow.velocity(x, 1.7).dot(x).abs() < 1e-14);
            // Truncation d²/6 times third derivatives near 1e3 for vortices of 5°.
            assert!((slope(e1) + slope(e2)).abs() < 2e-5, "{x}: {}", slope(e1) + slope(e2));
        }
    }

    #[test]
    fn velocity_is_the_turned_gradient_of_the_stream_function() {
        let flow = PrescribedFlow::stirred(4, 1.0);
        let d = 1e-5;
        for x in directions() {
            let (e1, e2) = x.any_orthonormal_pair();
            let psi = |v: DVec3| flow.stream_function(v.normalize(), 0.6);
            let gradient = |e: DVec3| (psi(x + d * e) - psi(x - d * e)) / (2.0 * d);
            let turned = x.cross(gradient(e1) * e1 + gradient(e2) * e2);
            assert!(turned.distance(flow.velocity(x, 0.6)) < 1e-6);
        }
    }

    #[test]
    fn vorticity_is_the_curl_of_the_velocity() {
        let flow = PrescribedFlow::stirred(4, 1.0);
        let d = 1e-4;
        for x in directions() {
            let (e1, e2) = x.any_orthonormal_pair();
            let across = |e: DVec3, along: DVec3| {
                let at = |s: f64| flow.velocity((x + s * e).normalize(), 0.6).dot(along);
                (at(d) - at(-d)) / (2.0 * d)
            };
            let curl = (across(e1, e2) - across(e2, e1)) * x.dot(e1.cross(e2));
            // Truncation d²/6 times third derivatives near 1e3 for vortices of 5°.
            assert!((curl - flow.vorticity(x, 0.6)).abs() < 2e-5, "{x}");
        }
    }

    #[test]
    fn a_frozen_flow_is_the_flow_of_its_moment() {
        let flow = PrescribedFlow::stirred(5, 1.0);
        for t in [0.0, 2.5, 1e5] {
            let frozen = flow.frozen_at(t);
            for x in directions() {
                let waves = frozen.waves.iter().map(|w| {
                    let k = DVec3::from_array(w.k.map(f64::from));
                    f64::from(w.amplitude) * (k.dot(x) + f64::from(w.phase)).cos() * k
                });
                let vortices = frozen.vortices.iter().map(|v| {
                    let [center, kappa] =
                        [DVec3::from_array(v.center.map(f64::from)), DVec3::splat(v.sharpness.into())];
                    kappa * f64::from(v.strength) * (kappa.x * (center.dot(x) - 1.0)).exp() * center
                });
                let velocity = x.cross(waves.sum::<DVec3>() + vortices.sum::<DVec3>());
                assert!(velocity.distance(flow.velocity(x, t)) < 1e-5, "f32 rounding times κ ≤ 130, t = {t}");
            }
        }
    }

    #[test]
    fn the_bound_bounds_and_is_reached_by_a_lone_vortex() {
        let flow = PrescribedFlow::stirred(6, 1.0);
        for t in [0.0, 3.0, 11.0] {
            assert!(flow.speeds_at(t).1 <= flow.max_speed_bound());
        }
        for sharpness in [0.1, 5.0, 130.0] {
            let vortex = Vortex { sharpness, swing_rad_s: 0.0, swing_phase: 0.0, ..flow.vortices()[0] };
            let alone = PrescribedFlow::new(vec![], vec![vortex]).unwrap();
            let (e, _) = vortex.center.any_orthonormal_pair();
            let speed = |angle: f64| alone.velocity(vortex.center * angle.cos() + e * angle.sin(), 0.0).length();
            let peak = (0..3142).map(|k| speed(1e-3 * f64::from(k))).fold(0.0, f64::max);
            assert!((peak / alone.max_speed_bound() - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn flows_too_large_for_the_shader_are_refused() {
        let wave = PrescribedFlow::draught(0, 1.0).waves()[0];
        let error = PrescribedFlow::new(vec![wave; 33], vec![]).unwrap_err().to_string();
        assert!(error.contains("33 waves") && error.contains("at most 32"), "{error}");
    }
}
