//! A bath of water that bubbles stand on: a level mirror at the height of their centers.
//!
//! What a level mirror shows is the world mirrored in it, dimmed. A ray that meets the bath goes on straight into the mirrored world, where the
//! other half of the bubble is, and each time that it crosses the level, `r(cos θ)` is left of its light. Directions down are then those up.
//! The bath's own light is none: deep water is dark. The meniscus at the bubble's foot is a wedge that turns light away; it is drawn as a
//! band that darkens towards the bath, as high as water climbs. Left out: what the meniscus shows instead, the dimple under the bubble (0.2 mm for a radius of
//! 5 cm), and that water polarises, which r, the mean of s and p light, does not know.

use glam::DVec3;

use crate::physics::optics::amplitudes;

/// Refractive index of the water.
const WATER_INDEX: f64 = 1.333;

/// What is left of light that goes from one height to another, both counted from the bath's level, along a unit vector.
#[must_use]
pub fn crossing(from_z: f64, to_z: f64, direction: DVec3) -> f64 {
    if from_z * to_z >= 0.0 {
        return 1.0;
    }
    let r = amplitudes(WATER_INDEX, direction.z.abs());
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

/// The direction of the world that one of the mirrored world is.
#[must_use]
pub fn upward(direction: DVec3) -> DVec3 {
    direction.with_z(direction.z.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn water_mirrors_2_percent_straight_down_and_all_at_grazing() {
        assert!((crossing(1.0, -1.0, DVec3::NEG_Z) - 0.0204).abs() < 1e-4);
        assert!(crossing(1.0, -1.0, DVec3::new(1.0, 0.0, -1e-6).normalize()) > 0.999);
        assert_eq!(crossing(1.0, 0.5, DVec3::NEG_Z), 1.0);
        assert_eq!(crossing(-1.0, -0.5, DVec3::NEG_Z), 1.0);
    }

    #[test]
    fn the_meniscus_is_as_high_as_water_climbs() {
        use crate::physics::film::properties::{DENSITY, GRAVITY, SURFACE_TENSION};
        let climbs_m = (2.0 * SURFACE_TENSION / (DENSITY * GRAVITY)).sqrt();
        assert!((MENISCUS_M / climbs_m - 1.0).abs() < 2e-3, "{climbs_m}");
        assert_eq!((past_meniscus(0.0, 0.05), past_meniscus(-0.1, 0.05)), (MENISCUS_LEFT, 1.0));
    }
}
