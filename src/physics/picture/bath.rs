//! A bath of water that bubbles stand on: a level mirror at the height of their centers.
//!
//! A ray that meets the bath is reflected, with `r(cos θ)` of its light. The shaders let it go on straight into the mirrored world instead, where
//! the other half of each bubble is; both are the same.
//! The bath's own light is none: deep water is dark. The meniscus at a bubble's foot is a wedge that turns light away; it is drawn as a
//! band that darkens towards the bath, as high as water climbs. Left out: what the meniscus shows instead, the dimple under the bubble (0.2 mm for a radius of
//! 5 cm), and that water polarises, which r, the mean of s and p light, does not know.

use crate::physics::optics::amplitudes;

/// Refractive index of the water.
const WATER_INDEX: f64 = 1.333;

/// What the bath reflects of unpolarised light, by the height of a unit vector along the ray.
#[must_use]
pub fn mirrored_part(direction_z: f64) -> f64 {
    let r = amplitudes(WATER_INDEX, direction_z.abs());
    0.5 * (r.s.powi(2) + r.p.powi(2))
}

/// Height that water climbs at a wall, `√(2γ/ρg)`, m.
const MENISCUS_M: f64 = 0.002_26;
/// What is left of light that passes the meniscus at its foot.
const MENISCUS_LEFT: f64 = 0.2;

/// What the meniscus leaves of light that passes the wall at a height over the radius, for a radius in m.
#[must_use]
pub fn past_meniscus(z: f64, radius_m: f64) -> f64 {
    let t = (z.abs() * radius_m / MENISCUS_M).min(1.0);
    MENISCUS_LEFT + (1.0 - MENISCUS_LEFT) * t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn water_mirrors_2_percent_straight_down_and_all_at_grazing() {
        assert!((mirrored_part(-1.0) - 0.0204).abs() < 1e-4);
        assert!(mirrored_part(-1e-6) > 0.999);
    }

    #[test]
    fn the_meniscus_is_as_high_as_water_climbs() {
        use crate::physics::film::properties::{DENSITY, GRAVITY, SURFACE_TENSION};
        let climbs_m = (2.0 * SURFACE_TENSION / (DENSITY * GRAVITY)).sqrt();
        assert!((MENISCUS_M / climbs_m - 1.0).abs() < 2e-3, "{climbs_m}");
        assert_eq!((past_meniscus(0.0, 0.05), past_meniscus(-0.1, 0.05)), (MENISCUS_LEFT, 1.0));
    }
}
