//! Round parts of an environment.

use glam::DVec3;

/// A round part of the sphere of directions, with a soft edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Direction of its middle, a unit vector.
    pub towards: DVec3,
    /// Angle from there to where half of it is left, in radians.
    pub radius_rad: f64,
    /// Width of its edge, in radians; 0 or more.
    pub edge_rad: f64,
}

impl Patch {
    /// How much of the patch a direction (of any length but zero) sees: 1 inside, 0 outside, smoothly between (Hermite's cubic).
    #[must_use]
    pub fn coverage(&self, direction: DVec3) -> f64 {
        let inward = self.radius_rad - direction.angle_between(self.towards);
        if self.edge_rad == 0.0 {
            return if inward >= 0.0 { 1.0 } else { 0.0 };
        }
        let t = (0.5 + inward / self.edge_rad).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// How much each of some patches shows in a direction, and at the end what shows beside them: together 1. Later ones cover earlier
    /// ones.
    #[must_use]
    pub fn shares(patches: &[Self], direction: DVec3) -> Vec<f64> {
        let mut shares = vec![0.0; patches.len() + 1];
        let mut rest = 1.0;
        for (patch, share) in patches.iter().zip(&mut shares).rev() {
            *share = rest * patch.coverage(direction);
            rest -= *share;
        }
        shares[patches.len()] = rest;
        shares
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATCH: Patch = Patch { towards: DVec3::X, radius_rad: 0.5, edge_rad: 0.2 };

    fn at(angle: f64) -> DVec3 {
        3.0 * DVec3::new(angle.cos(), angle.sin(), 0.0)
    }

    #[test]
    fn a_patch_ends_softly_around_its_radius() {
        assert_eq!([0.0, 0.39, 0.61, 3.0].map(|angle| PATCH.coverage(at(angle))), [1.0, 1.0, 0.0, 0.0]);
        assert!((PATCH.coverage(at(0.5)) - 0.5).abs() < 1e-12);
        let sharp = Patch { edge_rad: 0.0, ..PATCH };
        assert_eq!([0.49, 0.51].map(|angle| sharp.coverage(at(angle))), [1.0, 0.0]);
    }

    #[test]
    fn later_patches_cover_earlier_ones_and_all_is_shared_out() {
        let other = Patch { towards: DVec3::Y, radius_rad: 1.3, edge_rad: 0.4 };
        for angle in [0.0, 0.3, 0.45, 0.52, 0.6, 2.0, 3.0] {
            let shares = Patch::shares(&[PATCH, other], at(angle));
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{angle}: {shares:?}");
            assert_eq!(shares[1], other.coverage(at(angle)));
        }
        assert_eq!(Patch::shares(&[], DVec3::Z), [1.0]);
    }
}
