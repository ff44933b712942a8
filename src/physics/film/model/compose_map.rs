//! The flow map with one more step: the twin of `shaders/pass/compose_map.wgsl`.
//!
//! ```text
//! M(x) ← M(X(x)),     X(x) where a step leads from x back to                                         (M1)
//! ```

use glam::DVec3;

use crate::physics::sphere::PaddedField;

/// Where the liquid of each cell was at the last remap, unit vectors, after a step (M1); without a map before it, that is the step. The map is
/// interpolated by 4 × 4 cells.
#[must_use]
pub fn compose_map(step: PaddedField<DVec3>, before: Option<&PaddedField<DVec3>>) -> PaddedField<DVec3> {
    let Some(before) = before else { return step };
    PaddedField::from_places(step.grid(), 0, |place| lookup(before, step.padded()[place]))
}

/// A map at a unit vector.
#[must_use]
pub fn lookup(map: &PaddedField<DVec3>, x: DVec3) -> DVec3 {
    map.bicubic(x).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;
    use glam::DMat3;

    #[test]
    fn turns_add_up() {
        let grid = CubedSphere::new(24).unwrap();
        let turn = |angle| DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle);
        let map = |angle| PaddedField::sample(grid, move |x| turn(angle) * x);
        let both = compose_map(map(0.3), Some(&map(0.5)));
        let error = both.padded().iter().zip(map(0.8).padded()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(error < 1e-5, "cubic interpolation of directions 3.75° apart: {error:e}");
        assert_eq!(compose_map(map(0.3), None), map(0.3));
    }
}
