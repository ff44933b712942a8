//! A bath of water that bubbles stand on: a level mirror at the height of their centres.
//!
//! What a level mirror shows is the world mirrored in it, dimmed. A ray that meets the bath goes on straight into the mirrored world, where the
//! other half of the bubble is, and each time that it crosses the level, `r(cos θ)` is left of its light. Directions down are then those up.
//! The bath's own light is none: deep water is dark. Left out: the meniscus at the bubble's foot, the dimple under it (0.2 mm for a radius of
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
}
