//! The tracer looked up through the flow map: the twin of `shaders/pass/sample_tracer.wgsl`, and of the lookup in
//! `shaders/pass/flow_thickness.wgsl`.
//!
//! What is at x now was at M(x) at the last remap, and beyond a rim stands what is at the image x* of a place (see [`Cap`]):
//!
//! ```text
//! φ(x) = φ₀(M(x)),     φ(x) = φ(x*) beyond the rim                                                   (M2)
//! ```

use glam::DVec3;

use super::compose_map::lookup;
use crate::physics::sphere::{Cap, PaddedField};

/// Where the liquid at unit vector `x`, the place in padded storage, or at its image was at the last remap. `None` if it is where it was, at the
/// same place of storage.
fn origin(x: DVec3, place: usize, map: Option<&PaddedField<DVec3>>, cap: Option<Cap>) -> Option<DVec3> {
    match (cap.filter(|cap| !cap.contains(x)), map) {
        (None, map) => map.map(|map| map.padded()[place]),
        (Some(cap), None) => Some(cap.image(x)),
        (Some(cap), Some(map)) => Some(lookup(map, cap.image(x))),
    }
}

/// The tracer as it is now at each cell and each cell of the halo (M2), interpolated by 6 × 6 cells and within the range of the four around.
#[must_use]
pub fn sample_tracer(
    tracer: &PaddedField<f64>,
    map: Option<&PaddedField<DVec3>>,
    cap: Option<Cap>,
) -> PaddedField<f64> {
    let grid = tracer.grid();
    PaddedField::from_places(grid, 0, |place| {
        let origin = origin(grid.padded_direction(place), place, map, cap);
        origin.map_or(tracer.padded()[place], |origin| tracer.biquintic_limited(origin))
    })
}

/// The tracer as its flow feels it, at each cell in the grid's order: by 4 × 4 cells, for the flow needs no more.
#[must_use]
pub fn felt_tracer(tracer: &PaddedField<f64>, map: Option<&PaddedField<DVec3>>, cap: Option<Cap>) -> Vec<f64> {
    let grid = tracer.grid();
    let felt = PaddedField::from_places(grid, 0, |place| {
        let origin = origin(grid.padded_direction(place), place, map, cap);
        origin.map_or(tracer.padded()[place], |origin| tracer.bicubic_limited(origin))
    });
    felt.cells()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;

    fn tracer() -> PaddedField<f64> {
        PaddedField::sample(CubedSphere::new(16).unwrap(), |x| x.x + (3.0 * x.y).sin() * x.z)
    }

    #[test]
    fn a_tracer_without_a_map_is_equal_to_the_bit() {
        let tracer = tracer();
        assert_eq!(sample_tracer(&tracer, None, None), tracer);
        assert_eq!(felt_tracer(&tracer, None, None), tracer.cells());
    }

    #[test]
    fn vorticity_beyond_a_rim_mirrors_the_vorticity_within() {
        let (cap, tracer) = (Cap::HEMISPHERE, tracer());
        let sampled = sample_tracer(&tracer, None, Some(cap));
        let grid = tracer.grid();
        for x in (0..grid.cells()).map(|cell| grid.cell_direction(cell)) {
            assert!((sampled.bilinear(x) - sampled.bilinear(cap.image(x))).abs() < 1e-9, "{x}");
        }
    }
}
