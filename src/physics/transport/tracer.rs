//! The initial fields of the transport tests.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DQuat, DVec3};

use super::{CaseError, unit};
use crate::words::words;

words! {
    /// The five initial fields.
    pub enum TracerKind: "tracer" {
        GaussianHills = "gh", "Gaussian hills, smooth";
        CosineBells = "cb", "Cosine bells on a floor of 0.1, once differentiable";
        CorrelatedCosineBells = "ccb", "0.9 − 0.8 CB², non-linearly correlated with the cosine bells";
        SlottedCylinders = "sc", "Slotted cylinders, discontinuous";
        Bell = "tc1", "The single bell of Williamson's test case 1, of radius 1/3 and height 1 on 0";
    }
}

/// An initial field: a floor and one or two features on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracer {
    kind: TracerKind,
    features: Vec<Feature>,
}

impl Tracer {
    /// The field with its features where the literature puts them, turned by `rotation`
    /// (see [`Wind::tracer_rotation`](super::Wind::tracer_rotation)).
    pub fn new(kind: TracerKind, rotation: DMat3) -> Self {
        let longitudes: &[f64] = if kind == TracerKind::Bell { &[1.5 * PI] } else { &[5.0 / 6.0 * PI, 7.0 / 6.0 * PI] };
        let features = longitudes.iter().zip([-1.0, 1.0]).map(|(&longitude, slot)| Feature {
            from_world: (rotation * DMat3::from_rotation_z(longitude)).transpose(),
            slot,
        });
        Self { kind, features: features.collect() }
    }

    /// The field with a single feature about `center`, whatever the wind's axis; a slot keeps its direction under the shortest
    /// rotation of the first feature to there. Fails for a center without direction.
    pub fn at(kind: TracerKind, center: DVec3) -> Result<Self, CaseError> {
        let center = unit(center, "tracer's place")?;
        let mut tracer = Self::new(kind, DMat3::IDENTITY);
        tracer.features.truncate(1);
        let home = tracer.features[0].center();
        tracer.features[0].from_world *= DMat3::from_quat(DQuat::from_rotation_arc(center, home));
        Ok(tracer)
    }

    /// The centers of the features, unit vectors.
    pub fn centers(&self) -> impl Iterator<Item = DVec3> {
        self.features.iter().map(Feature::center)
    }

    /// The value in the direction of unit vector `x`.
    pub fn value(&self, x: DVec3) -> f64 {
        let sum =
            |shape: fn(&Feature, DVec3) -> f64| self.features.iter().map(|feature| shape(feature, x)).sum::<f64>();
        let bells = || 0.1 + 0.9 * sum(|feature, x| feature.cosine_bell(x, 0.5));
        match self.kind {
            TracerKind::GaussianHills => 0.95 * sum(Feature::gaussian),
            TracerKind::CosineBells => bells(),
            TracerKind::CorrelatedCosineBells => 0.9 - 0.8 * bells().powi(2),
            TracerKind::SlottedCylinders => 0.1 + 0.9 * sum(Feature::slotted_cylinder),
            TracerKind::Bell => sum(|feature, x| feature.cosine_bell(x, 1.0 / 3.0)),
        }
    }
}

/// A feature in its own frame, in which its center is at +x and longitudes and latitudes count from there.
#[derive(Clone, Debug, PartialEq)]
struct Feature {
    from_world: DMat3,
    /// Which end of the cylinder's slot is closed: −1 the southern, +1 the northern.
    slot: f64,
}

impl Feature {
    fn center(&self) -> DVec3 {
        self.from_world.transpose() * DVec3::X
    }

    /// exp(−5 |x − center|²).
    fn gaussian(&self, x: DVec3) -> f64 {
        (-5.0 * x.distance_squared(self.center())).exp()
    }

    /// ½ (1 + cos(π r / radius)) within the radius, an angle, and 0 outside.
    fn cosine_bell(&self, x: DVec3, radius: f64) -> f64 {
        let r = great_circle(self.from_world * x);
        if r < radius { 0.5 * (1.0 + (PI * r / radius).cos()) } else { 0.0 }
    }

    /// 1 in the cylinder of radius ½ and 0 outside and in its slot, which is r/3 wide and ends 5r/12 beyond the middle.
    fn slotted_cylinder(&self, x: DVec3) -> f64 {
        const RADIUS: f64 = 0.5;
        let local = self.from_world * x;
        let longitude = local.y.atan2(local.x);
        let latitude = FRAC_PI_2 - local.z.clamp(-1.0, 1.0).acos();
        let beside_slot = longitude.abs() >= RADIUS / 6.0;
        let past_slot = self.slot * latitude > 5.0 / 12.0 * RADIUS;
        f64::from(u8::from(great_circle(local) <= RADIUS && (beside_slot || past_slot)))
    }
}

/// Angle from +x of a unit vector, accurate at all angles.
fn great_circle(local: DVec3) -> f64 {
    local.y.hypot(local.z).atan2(local.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(lambda: f64, theta: f64) -> DVec3 {
        DVec3::new(theta.cos() * lambda.cos(), theta.cos() * lambda.sin(), theta.sin())
    }

    fn value(kind: TracerKind, lambda: f64, theta: f64) -> f64 {
        Tracer::new(kind, DMat3::IDENTITY).value(at(lambda, theta))
    }

    #[test]
    fn values_at_the_centers_and_far_away() {
        let center = 5.0 / 6.0 * PI;
        for (kind, top, floor) in [
            (TracerKind::CosineBells, 1.0, 0.1),
            (TracerKind::CorrelatedCosineBells, 0.1, 0.892),
            (TracerKind::SlottedCylinders, 0.1, 0.1),
        ] {
            assert!((value(kind, center, 0.0) - top).abs() < 1e-12, "{kind:?}");
            assert!((value(kind, 0.0, 0.0) - floor).abs() < 1e-12, "{kind:?}");
        }
        // The other hill is 60° away: |x − x2|² = 1.
        assert!((value(TracerKind::GaussianHills, center, 0.0) - 0.95 * (1.0 + (-5.0_f64).exp())).abs() < 1e-12);
        assert!((value(TracerKind::Bell, 1.5 * PI, 1.0 / 6.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn slots_open_to_opposite_sides() {
        let [first, second] = [5.0 / 6.0 * PI, 7.0 / 6.0 * PI];
        let sc = |lambda, theta| value(TracerKind::SlottedCylinders, lambda, theta);
        assert_eq!([sc(first, -0.3), sc(first, 0.3), sc(second, 0.3), sc(second, -0.3)], [1.0, 0.1, 1.0, 0.1]);
        assert_eq!([sc(first + 0.1, 0.3), sc(first + 0.05, 0.3)], [1.0, 0.1]);
    }

    #[test]
    fn one_feature_moves_where_it_is_asked_to() {
        for kind in [TracerKind::CosineBells, TracerKind::Bell, TracerKind::GaussianHills] {
            for corner in [DVec3::ONE, DVec3::NEG_Z, DVec3::new(-1.0, 1.0, -1.0)] {
                let tracer = Tracer::at(kind, corner).unwrap();
                assert_eq!(tracer.centers().count(), 1);
                assert!(tracer.centers().all(|c| c.distance(corner.normalize()) < 1e-14));
                let top = if kind == TracerKind::GaussianHills { 0.95 } else { 1.0 };
                assert!((tracer.value(corner.normalize()) - top).abs() < 1e-12);
            }
        }
        let home = Tracer::at(TracerKind::SlottedCylinders, at(5.0 / 6.0 * PI, 0.0)).unwrap();
        assert_eq!(home.value(at(5.0 / 6.0 * PI, -0.3)), 1.0);
        assert!(Tracer::at(TracerKind::Bell, DVec3::ZERO).is_err());
    }
}
