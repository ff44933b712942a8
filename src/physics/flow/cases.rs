//! Flows whose answer is known in closed form, on the unit sphere.

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};
use thiserror::Error;

use super::FlowForces;
use crate::words::words;

/// Why a case could not be set up.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FlowCaseError {
    /// A degree and order that no harmonic has, or none that moves.
    #[error(
        "there is no mode of degree {degree} and order {order}: use degrees 1 to 32 and orders {lowest} to the degree"
    )]
    Mode {
        /// The degree asked for.
        degree: u32,
        /// The order asked for.
        order: u32,
        /// The lowest order that the case knows.
        lowest: u32,
    },
    /// A number that makes nothing happen.
    #[error("{0} must be a finite number other than 0")]
    Zero(&'static str),
}

words! {
    /// The kinds of cases.
    pub enum FlowCaseKind: "flow case" {
        RossbyHaurwitz = "rossby-haurwitz", "A wave of degree 5 and order 4 on a solid rotation: it turns rigidly at 28/30 of it (Williamson et al. 1992, test 6)";
        Stationary = "stationary", "A jet that stands still";
        Sloshing = "sloshing", "A small standing wave of a stratified film";
        Decay = "decay", "A harmonic that viscosity wears down";
        Poisson = "poisson", "ψ from ζ, nothing more";
    }
}

/// A real spherical harmonic of degree l and order m: `P cos(mλ)` or `P sin(mλ)` with P the associated Legendre function, scaled so
/// that neither grows with l and m.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mode {
    degree: u32,
    order: u32,
}

impl Mode {
    /// The mode, if there is one; degrees run from 1 to 32, orders from `lowest` to the degree.
    pub fn new(degree: u32, order: u32, lowest: u32) -> Result<Self, FlowCaseError> {
        if (1..=32).contains(&degree) && (lowest..=degree).contains(&order) {
            Ok(Self { degree, order })
        } else {
            Err(FlowCaseError::Mode { degree, order, lowest })
        }
    }

    /// −Δ of it over itself: l (l + 1).
    #[must_use]
    pub fn eigenvalue(self) -> f64 {
        f64::from(self.degree * (self.degree + 1))
    }

    /// The cosine and the sine mode at unit vector `x`: `P_lm(z)/sinᵐϑ · Re, Im (x + iy)ᵐ`, which needs no angles.
    #[must_use]
    pub fn values(self, x: DVec3) -> [f64; 2] {
        let m = f64::from(self.order);
        // The recurrence in l of fully normalised functions, from P_mm without its sine: (2m + 1)(2m − 1)!!² / (2m)! times 2.
        let start =
            (1..=self.order).map(f64::from).fold(1.0, |product, k| product * (2.0 * k + 1.0) / (2.0 * k)).sqrt();
        let (mut below, mut now) = (0.0, start);
        for l in (self.order + 1..=self.degree).map(f64::from) {
            let a = ((4.0 * l * l - 1.0) / (l * l - m * m)).sqrt();
            let b = (((l - 1.0).powi(2) - m * m) / (4.0 * (l - 1.0).powi(2) - 1.0)).sqrt();
            (below, now) = (now, a * (x.z * now - b * below));
        }
        let (mut re, mut im) = (now, 0.0);
        for _ in 0..self.order {
            (re, im) = (re * x.x - im * x.y, re * x.y + im * x.x);
        }
        [re, im]
    }
}

/// One case: what it starts from, what acts on it, and what it must be at any time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowCase {
    kind: FlowCaseKind,
    /// From the world to the frame in which the formulas stand, axis +z.
    from_world: DMat3,
    mode: Mode,
    /// ω: rad/s of the solid rotation.
    omega: f64,
    /// K: strength of the wave or of the jet, rad/s.
    k: f64,
    /// a of the stratification ln h = −a z; negative is upside down.
    stratification: f64,
    drag: f64,
}

/// Amplitude of ln h in sloshing, small enough that modes do not meet.
const SLOSH_AMPLITUDE: f64 = 1e-3;

impl FlowCase {
    /// The case about an axis, a unit vector, with ω and K as in [`FlowCaseKind`], all default where they do not matter. Fails for a mode
    /// that does not exist, or numbers with which nothing moves.
    pub fn new(kind: FlowCaseKind, axis: DVec3, mode: Mode, omega: f64, k: f64) -> Result<Self, FlowCaseError> {
        let moves = matches!(kind, FlowCaseKind::RossbyHaurwitz | FlowCaseKind::Stationary);
        if moves && !(omega.is_finite() && omega != 0.0) {
            return Err(FlowCaseError::Zero("omega"));
        }
        if !k.is_finite() {
            return Err(FlowCaseError::Zero("k"));
        }
        if kind == FlowCaseKind::Sloshing && mode.order == 0 {
            return Err(FlowCaseError::Mode { degree: mode.degree, order: mode.order, lowest: 1 });
        }
        if kind == FlowCaseKind::Decay && mode.degree < 2 {
            // A solid rotation has no shear: viscosity does nothing to it.
            return Err(FlowCaseError::Mode { degree: mode.degree, order: mode.order, lowest: 0 });
        }
        let from_world = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis)).transpose();
        Ok(Self { kind, from_world, mode, omega, k, stratification: 1.0, drag: 0.0 })
    }

    /// The same with another stratification and with drag: sloshing alone feels them.
    #[must_use]
    pub fn with_film(self, stratification: f64, drag: f64) -> Self {
        Self { stratification, drag, ..self }
    }

    /// Which case it is.
    #[must_use]
    pub fn kind(&self) -> FlowCaseKind {
        self.kind
    }

    /// The time that M steps take, in seconds: a wavelength, a turn, a period (or e-folding, upside down), an e-folding; 0 for Poisson.
    #[must_use]
    pub fn span_s(&self) -> f64 {
        match self.kind {
            FlowCaseKind::RossbyHaurwitz => TAU / (4.0 * self.wave_rad_s().abs()),
            FlowCaseKind::Stationary => TAU / self.omega.abs(),
            FlowCaseKind::Sloshing if self.stratification < 0.0 => 1.0 / self.growth(),
            FlowCaseKind::Sloshing => TAU / self.frequency(),
            FlowCaseKind::Decay => 1.0 / (self.mode.eigenvalue() - 2.0),
            FlowCaseKind::Poisson => 0.0,
        }
    }

    /// What acts on the film.
    #[must_use]
    pub fn forces(&self) -> FlowForces {
        match self.kind {
            FlowCaseKind::Sloshing => FlowForces {
                gravity: self.from_world.transpose() * DVec3::NEG_Z,
                drag: self.drag,
                ..FlowForces::default()
            },
            FlowCaseKind::Decay => FlowForces { viscosity: 1.0, ..FlowForces::default() },
            _ => FlowForces::default(),
        }
    }

    /// Vorticity at unit vector `x` and time `t`, 1/s.
    #[must_use]
    pub fn zeta(&self, x: DVec3, t: f64) -> f64 {
        let p = self.from_world * x;
        match self.kind {
            FlowCaseKind::RossbyHaurwitz => {
                let turned = DMat3::from_rotation_z(-self.wave_rad_s() * t) * p;
                2.0 * self.omega * p.z - 30.0 * self.k * rossby_haurwitz(turned)
            }
            FlowCaseKind::Stationary => 2.0 * self.omega * p.z + 12.0 * self.k * legendre_3(p.z),
            FlowCaseKind::Sloshing => self.slosh_zeta(p, t),
            FlowCaseKind::Decay => self.mode.values(p)[0] * (-(self.mode.eigenvalue() - 2.0) * t).exp(),
            FlowCaseKind::Poisson => -self.mode.eigenvalue() * self.mode.values(p)[0],
        }
    }

    /// Stream function at unit vector `x` at the start, rad²/s.
    #[must_use]
    pub fn psi(&self, x: DVec3) -> f64 {
        let p = self.from_world * x;
        match self.kind {
            FlowCaseKind::RossbyHaurwitz => -self.omega * p.z + self.k * rossby_haurwitz(p),
            FlowCaseKind::Stationary => -self.omega * p.z - self.k * legendre_3(p.z),
            FlowCaseKind::Sloshing => 0.0,
            FlowCaseKind::Decay => -self.mode.values(p)[0] / self.mode.eigenvalue(),
            FlowCaseKind::Poisson => self.mode.values(p)[0],
        }
    }

    /// ln h at unit vector `x` at the start.
    #[must_use]
    pub fn log_thickness(&self, x: DVec3) -> f64 {
        if self.kind != FlowCaseKind::Sloshing {
            return 0.0;
        }
        let p = self.from_world * x;
        SLOSH_AMPLITUDE * self.mode.values(p)[0] - self.stratification * p.z
    }

    /// The mode that swings, decays or is solved for, at unit vector `x`: for sloshing, the mode of vorticity.
    #[must_use]
    pub fn mode_at(&self, x: DVec3) -> f64 {
        self.mode.values(self.from_world * x)[usize::from(self.kind == FlowCaseKind::Sloshing)]
    }

    /// Frequency of sloshing, √(σ² − α²/4) with σ = √(ga/R) m / √(l (l + 1)), g = R = 1, in rad/s; 0 if overdamped or upside down.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.sigma2() - 0.25 * self.drag * self.drag).max(0.0).sqrt()
    }

    /// The fastest growth of sloshing, 1/s: −α/2 for a wave, √(−σ² + α²/4) − α/2 upside down (Rayleigh-Taylor) or overdamped.
    #[must_use]
    pub fn growth(&self) -> f64 {
        (0.25 * self.drag * self.drag - self.sigma2()).max(0.0).sqrt() - 0.5 * self.drag
    }

    fn sigma2(&self) -> f64 {
        self.stratification * f64::from(self.mode.order).powi(2) / self.mode.eigenvalue()
    }

    /// The linear wave that starts at rest: from ζ_t = −f_λ − αζ and f_t = a ψ_λ for the disturbance f of ln h.
    fn slosh_zeta(&self, p: DVec3, t: f64) -> f64 {
        let squared = self.sigma2() - 0.25 * self.drag * self.drag;
        let w = squared.abs().sqrt();
        let swing = if squared > 0.0 { (w * t).sin() / w } else { (w * t).sinh() / w };
        SLOSH_AMPLITUDE * f64::from(self.mode.order) * swing * (-0.5 * self.drag * t).exp() * self.mode.values(p)[1]
    }

    /// How fast the wave of degree 5 turns in a solid rotation: ω (1 − 2/30).
    fn wave_rad_s(&self) -> f64 {
        self.omega * 28.0 / 30.0
    }
}

/// cos⁴θ sin θ cos 4λ: a harmonic of degree 5.
fn rossby_haurwitz(p: DVec3) -> f64 {
    (p.x.powi(4) - 6.0 * (p.x * p.y).powi(2) + p.y.powi(4)) * p.z
}

/// P₃(s), a harmonic of degree 3.
fn legendre_3(s: f64) -> f64 {
    0.5 * (5.0 * s * s - 3.0) * s
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{
        flow::{Order, laplacian},
        sphere::{CubedSphere, HaloTable, PaddedField},
    };

    fn case(kind: FlowCaseKind, mode: (u32, u32)) -> FlowCase {
        let axis = DVec3::new(1.0, -2.0, 0.5).normalize();
        FlowCase::new(kind, axis, Mode::new(mode.0, mode.1, 0).unwrap(), 1.3, 0.7).unwrap()
    }

    #[test]
    fn vorticity_is_the_laplacian_of_the_stream_function() {
        let grid = CubedSphere::new(48).unwrap();
        let halo = HaloTable::new(grid);
        for kind in [FlowCaseKind::RossbyHaurwitz, FlowCaseKind::Stationary, FlowCaseKind::Decay, FlowCaseKind::Poisson]
        {
            let case = case(kind, (5, 3));
            let psi = PaddedField::sample_cells(grid, &halo, |x| case.psi(x));
            for cell in 0..grid.cells() {
                let error = laplacian(&psi, cell, Order::Fourth).0 - case.zeta(grid.cell_direction(cell), 0.0);
                // The operator's own error beside the halo: see its tests.
                assert!(error.abs() < 0.1, "{kind:?}: {error}");
            }
        }
    }

    #[test]
    fn modes_are_normalised_harmonics() {
        let grid = CubedSphere::new(64).unwrap();
        for (degree, order) in [(1, 0), (1, 1), (2, 1), (3, 2), (4, 4), (9, 5)] {
            let mode = Mode::new(degree, order, 0).unwrap();
            let mean: f64 = grid
                .areas()
                .iter()
                .enumerate()
                .map(|(cell, area)| {
                    let [c, s] = mode.values(grid.cell_direction(cell));
                    area * (c * c + s * s) / (4.0 * std::f64::consts::PI)
                })
                .sum();
            assert!((mean - 1.0).abs() < 2e-3, "midpoint rule: {degree}, {order}: {mean}");
        }
        assert!(Mode::new(0, 0, 0).is_err() && Mode::new(3, 4, 0).is_err() && Mode::new(3, 0, 1).is_err());
    }

    #[test]
    fn the_slosh_obeys_its_equation() {
        for (stratification, drag) in [(1.0, 0.0), (1.0, 0.3), (-0.5, 0.0), (-0.5, 0.2)] {
            let case = case(FlowCaseKind::Sloshing, (3, 2)).with_film(stratification, drag);
            let (x, d) = (DVec3::new(0.3, -0.5, 0.8).normalize(), 1e-3);
            let z = |t: f64| case.zeta(x, t);
            let [second, first] =
                [(z(1.0 + d) - 2.0 * z(1.0) + z(1.0 - d)) / (d * d), (z(1.0 + d) - z(1.0 - d)) / (2.0 * d)];
            // ζ_tt + α ζ_t + σ² ζ = 0 with σ² = a m² / (l (l + 1)).
            let left = second + drag * first + stratification * 4.0 / 12.0 * z(1.0);
            assert!(left.abs() < 1e-8, "{left:e}");
        }
    }

    #[test]
    fn names_are_read_and_nonsense_is_refused() {
        assert_eq!("sloshing".parse(), Ok(FlowCaseKind::Sloshing));
        assert!("slosh".parse::<FlowCaseKind>().unwrap_err().to_string().contains("rossby-haurwitz"));
        let mode = Mode::new(1, 1, 0).unwrap();
        for (kind, omega, k) in [(FlowCaseKind::Stationary, 0.0, 1.0), (FlowCaseKind::RossbyHaurwitz, 1.0, f64::NAN)] {
            assert!(FlowCase::new(kind, DVec3::Z, mode, omega, k).is_err());
        }
        assert!(FlowCase::new(FlowCaseKind::Decay, DVec3::Z, mode, 1.0, 1.0).is_err());
    }
}
