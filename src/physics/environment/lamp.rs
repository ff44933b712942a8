//! Small bright sources before an environment, which stay exact: no texel blurs them.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::shape::{rounded_box_distance, smoothstep};

/// A flat lamp that faces the scene: a disc, a softbox or a strip, as a rectangle with round corners. Lengths are as of a lamp one away, so they
/// are tangents of angles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lamp {
    /// Direction of its middle, a unit vector.
    pub towards: DVec3,
    /// Unit vector along its width, across [`Self::towards`].
    pub right: DVec3,
    /// Half of its width and height.
    pub half_size: DVec2,
    /// Radius of its corners; of a disc, its own.
    pub corner: f64,
    /// Half the width of its soft edge.
    pub edge: f64,
    /// Radiance, linear BT.2020.
    pub radiance: DVec3,
}

/// Half width of the soft edge that is as blurred as a picture of pixels, for pixels of width 1: a box has the variance 1/12 along each axis, the
/// slope of an edge of half width e (Hermite's cubic) e²/5.
const EDGE_PER_FOOTPRINT: f64 = 0.645_497;

impl Lamp {
    /// A lamp whose height runs upwards but for a turn, by azimuth, elevation and turn in radians.
    #[must_use]
    pub fn new([azimuth, elevation, turn]: [f64; 3], half_size: DVec2, corner: f64, radiance: DVec3) -> Self {
        let level = DVec2::from_angle(azimuth);
        let towards = (elevation.cos() * level).extend(elevation.sin());
        let right = level.perp().extend(0.0);
        let right = turn.cos() * right + turn.sin() * towards.cross(right);
        Self { towards, right, half_size, corner: corner.min(half_size.min_element()), edge: 0.0, radiance }
    }

    /// A round lamp by its direction (of any length) and its radius.
    #[must_use]
    pub fn disc(towards: DVec3, radius: f64, radiance: DVec3) -> Self {
        let towards = towards.normalize();
        let right = towards.any_orthonormal_vector();
        Self { towards, right, half_size: DVec2::splat(radius), corner: radius, edge: 0.0, radiance }
    }

    /// Its area, with that of its edge.
    #[must_use]
    pub fn area(&self) -> f64 {
        area(self.half_size, self.corner, self.edge)
    }

    /// Radiance from a unit `direction`, spread over cones of half angle `defocus` (its tangent) and filtered over `footprint`. The light that it
    /// sends is the same whatever it is spread over: it grows into the larger of lamp and cone, with the smaller as soft edge.
    #[must_use]
    pub fn radiance_from(&self, direction: DVec3, defocus: f64, footprint: f64) -> DVec3 {
        let facing = direction.dot(self.towards);
        if facing <= 0.0 {
            return DVec3::ZERO;
        }
        let up = self.towards.cross(self.right);
        let place = DVec2::new(direction.dot(self.right), direction.dot(up)) / facing;
        let from_lens = defocus.min(self.half_size.min_element());
        let edge = DVec3::new(self.edge, from_lens, EDGE_PER_FOOTPRINT * footprint).length().max(1e-9);
        let corner = self.corner.max(defocus).max(edge);
        let half_size = self.half_size.max(DVec2::splat(corner));
        let cover = smoothstep(edge, -edge, rounded_box_distance(place, half_size, corner));
        cover * self.area() / area(half_size, corner, edge) * self.radiance
    }
}

/// Area of a rectangle with round corners and a soft edge, which adds a fifth of its half width squared around a convex shape.
fn area(half_size: DVec2, corner: f64, edge: f64) -> f64 {
    4.0 * half_size.x * half_size.y - (4.0 - PI) * corner * corner + PI * edge * edge / 5.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Its light on a plane that faces it, by a grid of directions.
    fn irradiance(lamp: &Lamp, defocus: f64, footprint: f64) -> f64 {
        const SIDE: i32 = 800;
        let (reach, up) = (0.6, lamp.towards.cross(lamp.right));
        let step = 2.0 * reach / f64::from(SIDE);
        let place = |k: i32| (f64::from(k) + 0.5) * step - reach;
        let direction = |x: i32, y: i32| (lamp.towards + place(x) * lamp.right + place(y) * up).normalize();
        let seen =
            |x: i32| (0..SIDE).map(move |y| lamp.radiance_from(direction(x, y), defocus, footprint).y).sum::<f64>();
        (0..SIDE).map(seen).sum::<f64>() * step * step
    }

    #[test]
    fn a_lamp_sends_the_same_light_however_it_is_spread() {
        let softbox = Lamp::new([0.3, 0.5, 0.2], DVec2::new(0.2, 0.3), 0.02, DVec3::splat(3.0));
        let strip = Lamp::new([2.0, -0.5, 1.0], DVec2::new(0.01, 0.3), 0.0, DVec3::splat(3.0));
        for lamp in [softbox, strip, Lamp::disc(DVec3::new(1.0, 2.0, -0.5), 0.01, DVec3::splat(50.0))] {
            let truth = lamp.area() * lamp.radiance.y;
            for (defocus, footprint) in [(0.0, 0.004), (0.0, 0.1), (0.03, 0.0), (0.1, 0.0), (0.1, 0.05)] {
                let found = irradiance(&lamp, defocus, footprint);
                // The grid's steps are 0.0015 wide.
                assert!((found / truth - 1.0).abs() < 0.02, "{lamp:?} over {defocus}, {footprint}: {found} of {truth}");
            }
        }
    }

    #[test]
    fn a_small_lamp_out_of_focus_is_an_even_disc() {
        let sun = Lamp::disc(DVec3::X, 0.005, DVec3::ONE);
        let at = |angle: f64| sun.radiance_from(DVec3::new(angle.cos(), 0.0, angle.sin()), 0.05, 0.0).y;
        assert!((at(0.0) / 0.01 - 1.0).abs() < 0.01 && at(0.044) == at(0.0));
        assert!((at(0.05) / at(0.0) - 0.5).abs() < 0.02 && at(0.056) == 0.0);
        // None behind the scene.
        assert_eq!(sun.radiance_from(DVec3::NEG_X, 0.05, 0.0), DVec3::ZERO);
    }

    #[test]
    fn lamps_stand_where_their_angles_say() {
        let lamp = Lamp::new([90f64.to_radians(), 30f64.to_radians(), 0.0], DVec2::new(0.1, 0.2), 0.3, DVec3::ONE);
        assert!((lamp.towards.z - 0.5).abs() < 1e-12 && lamp.towards.y > 0.8 && lamp.right.z == 0.0);
        assert_eq!(lamp.corner, 0.1);
        let seen = |along: DVec3| lamp.radiance_from((lamp.towards + along).normalize(), 0.0, 0.0).y;
        let up = lamp.towards.cross(lamp.right);
        assert!(up.z > 0.0);
        assert_eq!([0.15 * up, 0.25 * up, 0.05 * lamp.right, 0.15 * lamp.right].map(seen), [1.0, 0.0, 1.0, 0.0]);
    }
}
