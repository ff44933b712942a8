//! Back along a steady flow: the twin of `shaders/flow/backtrace.wgsl` and `shaders/pass/flow_trace.wgsl`.
//!
//! The liquid that is at x was a time dt ago at X, by the implicit midpoint rule on the sphere, which is symmetric in time:
//!
//! ```text
//! X = 2 (x·m) m − x,     m = (x − ½ dt u(m)) / |x − ½ dt u(m)|                                       (F3)
//! ```

use glam::{DVec2, DVec3};

use crate::physics::sphere::{FieldValue, HaloTable, PaddedField};

/// A field carried for a time `dt` by a steady velocity: its values where the liquid of each cell came from.
pub fn advected<T: FieldValue>(
    halo: &HaloTable,
    field: &PaddedField<T>,
    velocity: &PaddedField<DVec3>,
    dt: f64,
) -> PaddedField<T> {
    let at = velocity.cells();
    PaddedField::from_cells(field.grid(), halo, |cell| {
        field.bicubic(origin(velocity, field.grid().cell_direction(cell), at[cell], dt))
    })
}

/// Where the liquid at unit vector `x` was a time `dt` ago, in a steady velocity field whose value at x is given (F3). The origin is x
/// reflected at the middle: a symmetric step along a great circle, so that circles stay circles.
#[must_use]
pub fn origin(velocity: &PaddedField<DVec3>, x: DVec3, at_x: DVec3, dt: f64) -> DVec3 {
    let middle = |u: DVec3| (x - 0.5 * dt * u).normalize();
    let next = |u: DVec3| velocity.bicubic(middle(u));
    let (once, twice) = (next(at_x), next(next(at_x)));
    let middle = middle(next(extrapolated(x, [at_x, once, twice])));
    2.0 * x.dot(middle) * middle - x
}

/// Where three iterates lead to in the end, in the tangent plane at `x`: Aitken's extrapolation, with vectors for complex numbers. It is
/// exact within an eddy, whose turn by more than a radian in a step the iteration alone would not follow: it would spiral outwards.
fn extrapolated(x: DVec3, [first, second, third]: [DVec3; 3]) -> DVec3 {
    let (before, last) = (second - first, third - second);
    let ratio = DVec2::new(before.dot(last), x.dot(before.cross(last))) / before.length_squared().max(1e-30);
    // Next to 1 it says nothing.
    let rest = (DVec2::X - ratio).length_squared().max(0.25);
    third + ((ratio.x - ratio.length_squared()) * last + ratio.y * x.cross(last)) / rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;

    #[test]
    fn in_solid_rotation_the_origin_stays_on_its_circle_and_the_way_back_leads_back() {
        let grid = CubedSphere::new(24).unwrap();
        let axis = DVec3::new(0.3, -0.2, 0.9).normalize();
        let turn = |sign: f64| PaddedField::sample_cells(grid, &HaloTable::new(grid), |x| sign * axis.cross(x));
        let (forth, back) = (turn(1.0), turn(-1.0));
        for x in (0..grid.cells()).step_by(37).map(|cell| grid.cell_direction(cell)) {
            let foot = origin(&forth, x, axis.cross(x), 0.3);
            // What three iterates leave of a turn by 0.3 radians; it goes as the fourth power.
            assert!((foot.dot(axis) - x.dot(axis)).abs() < 1e-4, "{x}");
            assert!(origin(&back, foot, -axis.cross(foot), 0.3).distance(x) < 1e-4, "{x}");
        }
    }
}
