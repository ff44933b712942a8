//! Slow gusts that carry bubbles to and fro.

use std::f64::consts::TAU;

use glam::DVec3;

use super::unit;
use crate::physics::film::pcg3d;

/// How many waves gusts are made of.
pub(super) const GUSTS: usize = 3;
/// The longest wave of the gusts over their amplitude, so that bubbles do not pass each other, and the shortest over the longest.
const GUST_WAVES: [f64; 2] = [16.0, 0.5];
/// The longest period of the gusts, s, and the shortest over the longest.
const GUST_PERIODS: [f64; 2] = [9.0, 0.5];

/// A transverse wave of air.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gust {
    /// What it displaces by at its crest, m.
    crest_m: DVec3,
    /// Wave vector, 1/m.
    wave_1_m: DVec3,
    /// Angular frequency, 1/s.
    frequency_1_s: f64,
    phase: f64,
}

impl Gust {
    /// Wave number `number` of a seed.
    pub fn new(seed: u32, number: u32, wander_m: f64) -> Self {
        let random = |k: u32| unit(pcg3d([seed, number, 0xf000_0000 | k]));
        let [height, around, phase] = random(0);
        let [turn, length, period] = random(1);
        let z = 2.0 * height - 1.0;
        let (y, x) = (TAU * around).sin_cos();
        let along = DVec3::new((1.0 - z * z).sqrt() * x, (1.0 - z * z).sqrt() * y, z);
        let (sin, cos) = (TAU * turn).sin_cos();
        let right = along.any_orthonormal_vector();
        let across = cos * right + sin * along.cross(right);
        let wavelength_m = GUST_WAVES[0] * wander_m.max(1e-6) * (1.0 - GUST_WAVES[1] * length);
        let period_s = GUST_PERIODS[0] * (1.0 - GUST_PERIODS[1] * period);
        Self {
            crest_m: across * wander_m / (GUSTS as f64).sqrt(),
            wave_1_m: along * TAU / wavelength_m,
            frequency_1_s: TAU / period_s,
            phase: TAU * phase,
        }
    }

    /// How far it displaces a bubble at a place and a time.
    pub fn at(&self, place_m: DVec3, time_s: f64) -> DVec3 {
        if self.crest_m == DVec3::ZERO {
            return DVec3::ZERO;
        }
        self.crest_m * (self.wave_1_m.dot(place_m) - self.frequency_1_s * time_s + self.phase).sin()
    }
}
