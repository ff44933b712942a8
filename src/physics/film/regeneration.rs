//! Marginal regeneration: along its rim a film is sucked into the meniscus and pulled out again thinner, in patches that rise to their level
//! (Mysels, Shinoda & Frankel 1959). Patches have 0.8 to 0.9 of the thickness around, rise as their weight and the viscosity of the film's
//! surfaces let them, and are as wide as an instability of the Rayleigh–Taylor kind makes them, some millimetres (Miguet et al. 2021,
//! Phys. Rev. Fluids 6, L101601, arXiv 2109.07966, after Seiwert et al. 2017 and Shabalina et al. 2019).

use std::f64::consts::TAU;

use glam::DVec3;

use super::random::Random;

/// Thickness of patches over the thickness of the film around.
pub const PATCH_THICKNESS: [f64; 2] = [0.8, 0.9];

/// Where and of what size a film regenerates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regeneration {
    /// Colatitude of the rim, radians.
    pub rim: f64,
    /// Radius of a patch, radians.
    pub radius: f64,
    /// Factor on how many there are; 1 where half of the rim is taken up by patches.
    pub amount: f64,
    /// Seed: each gives another sequence.
    pub seed: u32,
}

/// A thin patch that leaves the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Its middle, a unit vector.
    pub middle: DVec3,
    /// Its thickness over the thickness of the film around.
    pub thickness: f64,
    /// When, seconds.
    pub time_s: f64,
}

impl Regeneration {
    /// Patches that leave the rim per second when they rise at a speed in rad/s: a patch every two diameters, each with its next behind it at
    /// the same distance.
    #[must_use]
    pub fn rate_1_s(&self, speed: f64) -> f64 {
        let spacing = 4.0 * self.radius;
        self.amount * TAU * self.rim.sin() / spacing * speed.abs() / spacing
    }

    /// Patches that leave within a span of seconds, at a rate per second.
    pub fn patches(&self, rate_1_s: f64, from_s: f64, to_s: f64) -> impl Iterator<Item = Patch> {
        let slots = (from_s * rate_1_s).floor().max(0.0) as u64..(to_s * rate_1_s).ceil().max(0.0) as u64;
        let patches = slots.map(move |slot| self.patch(slot, rate_1_s));
        patches.filter(move |patch| patch.time_s >= from_s && patch.time_s < to_s)
    }

    /// The one patch of a slot of time.
    fn patch(&self, slot: u64, rate_1_s: f64) -> Patch {
        let mut random = Random::new(self.seed ^ (slot >> 32) as u32, PATCH_STREAM.wrapping_add(slot as u32));
        let colatitude = self.rim - self.radius;
        let (sin, cos) = random.between(0.0, TAU).sin_cos();
        Patch {
            middle: DVec3::new(colatitude.sin() * cos, colatitude.sin() * sin, colatitude.cos()),
            thickness: random.between(PATCH_THICKNESS[0], PATCH_THICKNESS[1]),
            time_s: (slot as f64 + random.between(0.0, 1.0)) / rate_1_s,
        }
    }
}

/// First of the streams of random numbers that patches have, one each.
const PATCH_STREAM: u32 = 0x5000_0000;

/// How fast a round patch rises in a film of its own viscosity, m/s: the mean over the patch of the steady flow that its buoyancy drives
/// against viscosity and drag, `(g δ/α) (½ − I₁(x) K₁(x))` with `x = r √(α/ν)`. For weak drag it is `(g δ r²/4ν) (ln(2/x) − γ + ¼)`, the
/// balance of weight and surface viscosity.
///
/// From the flow's equation in two dimensions, `(ν k² + α) u = g δ (1 − k_z²/k²)` for each wave of the patch, whose transform is `2πr J₁(kr)/k`.
/// `lack` is δ, one less the patch's thickness over that around; `slope_m_s2` gravity along the film, `viscosity_m2_s` ν, `drag_1_s` α.
#[must_use]
pub fn patch_speed(lack: f64, radius_m: f64, slope_m_s2: f64, viscosity_m2_s: f64, drag_1_s: f64) -> f64 {
    // Something always drags: in vacuum, and without walls, a patch would never stop to gain speed.
    let drag = drag_1_s.max(1e-3);
    let x = radius_m * (drag / viscosity_m2_s.max(1e-9)).sqrt();
    slope_m_s2 * lack / drag * (0.5 - bessel_product(x))
}

/// `I₁(x) K₁(x)`, by its series (Abramowitz & Stegun 9.6.10 and 9.6.11) and for large arguments by its expansion.
fn bessel_product(x: f64) -> f64 {
    if x > 8.0 {
        return (1.0 - 0.375 / (x * x)) / (2.0 * x);
    }
    const EULER: f64 = 0.577_215_664_901_532_9;
    let (quarter, mut term) = (0.25 * x * x, 0.5 * x);
    let (mut i1, mut rest, mut harmonic) = (0.0, 0.0, 0.0);
    for k in 0..40 {
        let k = f64::from(k);
        // ψ(k + 1) + ψ(k + 2)
        let digammas = 2.0 * (harmonic - EULER) + 1.0 / (k + 1.0);
        i1 += term;
        rest += 0.5 * digammas * term;
        harmonic += 1.0 / (k + 1.0);
        term *= quarter / ((k + 1.0) * (k + 2.0));
    }
    i1 * (1.0 / x + (0.5 * x).ln() * i1 - rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILM: Regeneration = Regeneration { rim: 1.5, radius: 0.06, amount: 1.0, seed: 3 };

    #[test]
    fn the_product_of_bessel_functions_is_tabulated() {
        // Abramowitz & Stegun, table 9.8: I₁ and K₁ at 0.5, 1, 2, 5.
        let table = [(0.5, 0.257_894 * 1.656_441), (1.0, 0.565_159 * 0.601_907), (2.0, 1.590_637 * 0.139_866)];
        for (x, product) in table {
            assert!((bessel_product(x) / product - 1.0).abs() < 1e-5, "{x}");
        }
        assert!((bessel_product(7.99) / bessel_product(8.01) - 1.0).abs() < 4e-3, "both ways agree where they meet");
    }

    #[test]
    fn patches_rise_by_weight_against_surface_viscosity() {
        let speed = |radius, drag| patch_speed(0.15, radius, 9.81, 1e-3, drag);
        let (x, euler) = (1e-3 * (0.1f64 / 1e-3).sqrt(), 0.577_216);
        let weak = 9.81 * 0.15 * 1e-6 / 4e-3 * ((2.0 / x).ln() - euler + 0.25);
        assert!((speed(1e-3, 0.1) / weak - 1.0).abs() < 1e-3, "{} {weak}", speed(1e-3, 0.1));
        assert!((5e-4..0.05).contains(&speed(3e-3, 2.0)), "millimetres to centimetres a second: {}", speed(3e-3, 2.0));
        assert!(speed(4e-3, 2.0) > 2.0 * speed(2e-3, 2.0), "wider ones are faster");
    }

    #[test]
    fn the_same_patches_leave_however_time_is_cut() {
        let whole: Vec<Patch> = FILM.patches(20.0, 0.0, 3.0).collect();
        let cuts = [0.0, 0.4, 0.41, 1.7, 3.0];
        let cut: Vec<Patch> = cuts.windows(2).flat_map(|span| FILM.patches(20.0, span[0], span[1])).collect();
        assert_eq!(whole.len(), 60);
        assert_eq!(whole, cut);
        for patch in whole {
            assert!((0.8..0.9).contains(&patch.thickness) && (patch.middle.z - 1.44f64.cos()).abs() < 1e-12);
        }
    }

    #[test]
    fn half_of_the_rim_is_taken_up_at_amount_1() {
        let speed = 0.2;
        // Each takes its diameter of the rim for as long as it rises by two.
        let taken = FILM.rate_1_s(speed) * 2.0 * FILM.radius * 4.0 * FILM.radius / speed / (TAU * FILM.rim.sin());
        assert!((taken - 0.5).abs() < 1e-12, "{taken}");
    }
}
