//! The gizmo: arrows at a bubble's center that move it along one axis, and a ring that moves it across the view.

use glam::{DVec2, DVec3};

use super::sight;
use crate::scene::{Boundary, Camera};

/// The axes of the world, each with its name.
pub const AXES: [(DVec3, &str); 3] = [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")];

/// An arrow shorter than this part of the full length points at the eye or away from it, and is hidden: a pixel would be a long way.
const SHORTEST: f64 = 0.25;
/// Steps of a tenth of a millimetre, which bubbles go in: a saved scene shows short numbers.
const FINE_PER_M: f64 = 1e4;

/// A part of the gizmo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Handle {
    /// The arrow along an axis of [`AXES`].
    Axis(usize),
    /// The ring: in the plane across the view, on a bath in that of the bath.
    Plane,
}

/// Where a gizmo is in the picture, in its places.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The center.
    pub center: DVec2,
    /// The arrows that are seen, with their tips.
    pub arrows: Vec<(usize, DVec2)>,
}

/// The gizmo at a center, its arrows of a length in heights of the picture, whatever the distance; `None` behind the eye. A bubble on a bath stays at its
/// height and has no arrow upwards.
#[must_use]
pub fn shape(camera: &Camera, center_m: DVec3, boundary: Boundary, length: f64) -> Option<Shape> {
    let center = sight::place(camera, center_m)?;
    let length_m = length * sight::height(camera) * sight::depth_m(camera, center_m);
    let free = if boundary == Boundary::Bath { &AXES[..2] } else { &AXES[..] };
    let arrows = free.iter().enumerate().filter_map(|(index, (axis, _))| {
        let tip = sight::place(camera, center_m + length_m * *axis)?;
        (tip.distance(center) >= SHORTEST * length).then_some((index, tip))
    });
    Some(Shape { center, arrows: arrows.collect() })
}

/// A handle that the pointer holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Which one.
    pub handle: Handle,
    /// Where the center was when it was taken, m.
    from_m: DVec3,
    /// Whether the bubble stays at its height.
    is_level: bool,
    /// From there to where the line of sight met the handle's line or plane, m.
    offset_m: DVec3,
    /// How far the center has been moved since, m.
    moved_m: DVec3,
}

impl Grip {
    /// Takes a handle at a place in the picture; `None` if the line of sight does not meet its line or plane.
    #[must_use]
    pub fn new(handle: Handle, camera: &Camera, center_m: DVec3, boundary: Boundary, at: DVec2) -> Option<Self> {
        let is_level = boundary == Boundary::Bath;
        let start = Self { handle, from_m: center_m, is_level, offset_m: DVec3::ZERO, moved_m: DVec3::ZERO };
        let met_m = start.met_m(camera, at)?;
        Some(Self { offset_m: met_m - center_m, ..start })
    }

    /// Follows the pointer to a place in the picture; returns how far the center goes, m. Where the line of sight does not meet the handle's line or
    /// plane, the center stays.
    pub fn follow(&mut self, camera: &Camera, at: DVec2) -> DVec3 {
        let Some(met_m) = self.met_m(camera, at) else { return DVec3::ZERO };
        let moved_m = ((met_m - self.offset_m - self.from_m) * FINE_PER_M).round() / FINE_PER_M;
        moved_m - std::mem::replace(&mut self.moved_m, moved_m)
    }

    fn met_m(&self, camera: &Camera, at: DVec2) -> Option<DVec3> {
        let (eye_m, ray) = (camera.eye(), sight::ray(camera, at));
        match self.handle {
            Handle::Axis(index) => {
                let axis = AXES[index].0;
                sight::nearest_on_line(eye_m, ray, self.from_m, axis).map(|along_m| self.from_m + along_m * axis)
            }
            Handle::Plane => {
                let normal = if self.is_level { DVec3::Z } else { camera.forward() };
                sight::on_plane(eye_m, ray, self.from_m, normal)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: f64 = 0.1;

    fn from(azimuth_deg: f64, elevation_deg: f64) -> Camera {
        Camera { azimuth_deg, elevation_deg, ..Camera::default() }
    }

    #[test]
    fn arrows_are_as_long_at_every_distance_and_hidden_along_the_view() {
        for distance_m in [0.1, 1.0, 100.0] {
            let camera = Camera { distance_m, ..from(0.0, 0.0) };
            let shape = shape(&camera, DVec3::ZERO, Boundary::Free, LENGTH).unwrap();
            assert_eq!(shape.arrows.iter().map(|(axis, _)| *axis).collect::<Vec<_>>(), [1, 2], "x points at the eye");
            let [(_, right), (_, up)] = shape.arrows[..] else { panic!("two arrows") };
            assert!(right.distance(DVec2::new(LENGTH, 0.0)) < 1e-12 && up.distance(DVec2::new(0.0, LENGTH)) < 1e-12);
        }
        let arrows = |camera: &Camera, boundary| shape(camera, DVec3::ZERO, boundary, LENGTH).unwrap().arrows.len();
        assert_eq!((arrows(&from(35.0, 25.0), Boundary::Free), arrows(&from(0.0, 90.0), Boundary::Free)), (3, 2));
        assert_eq!(arrows(&from(35.0, 25.0), Boundary::Bath), 2, "a bubble on a bath stays at its height");
        let behind = Camera { target_m: [10.0, 0.0, 0.0], ..from(180.0, 0.0) };
        assert_eq!(shape(&Camera { azimuth_deg: 0.0, ..behind }, DVec3::X * 20.0, Boundary::Free, LENGTH), None);
    }

    /// Pulls a handle from its tip to a place, over places between, and returns how far the center goes.
    fn pulled(handle: Handle, camera: &Camera, boundary: Boundary, to: DVec2) -> DVec3 {
        let center_m = DVec3::new(0.01, 0.02, 0.03);
        let shape = shape(camera, center_m, boundary, LENGTH).unwrap();
        let tip = |index| shape.arrows.iter().find(|(axis, _)| *axis == index).unwrap().1;
        let at = match handle {
            Handle::Axis(index) => tip(index),
            Handle::Plane => shape.center,
        };
        let mut grip = Grip::new(handle, camera, center_m, boundary, at).unwrap();
        (1..=5).map(|step| grip.follow(camera, at + f64::from(step) / 5.0 * to)).sum()
    }

    #[test]
    fn an_arrow_moves_along_its_axis_alone_and_stays_under_the_pointer() {
        let camera = from(35.0, 25.0);
        for (index, (axis, _)) in AXES.iter().enumerate() {
            let moved_m = pulled(Handle::Axis(index), &camera, Boundary::Free, DVec2::new(0.05, 0.04));
            assert!(moved_m.dot(*axis).abs() > 1e-3, "{moved_m}");
            assert!((moved_m - moved_m.dot(*axis) * *axis).length() < 1e-12, "{moved_m}");
        }
        let level = from(0.0, 0.0);
        let moved_m = pulled(Handle::Axis(1), &level, Boundary::Free, DVec2::new(0.1, 0.0));
        let depth_m = sight::depth_m(&level, DVec3::new(0.01, 0.02, 0.03));
        assert!((moved_m.y - 0.1 * sight::height(&level) * depth_m).abs() < 1e-4, "{moved_m}");
    }

    #[test]
    fn the_ring_moves_across_the_view_and_on_a_bath_along_it() {
        let camera = from(35.0, 25.0);
        let moved_m = pulled(Handle::Plane, &camera, Boundary::Free, DVec2::new(0.1, -0.05));
        assert!(moved_m.dot(camera.forward()).abs() < 1e-4 && moved_m.dot(camera.right()) > 1e-3, "{moved_m}");
        let moved_m = pulled(Handle::Plane, &camera, Boundary::Bath, DVec2::new(0.1, -0.05));
        assert!(moved_m.z.abs() < 1e-12 && moved_m.length() > 1e-3, "{moved_m}");
    }

    #[test]
    fn beyond_the_horizon_nothing_moves() {
        let camera = from(0.0, 10.0);
        let mut grip = Grip::new(Handle::Plane, &camera, DVec3::ZERO, Boundary::Bath, DVec2::ZERO).unwrap();
        assert_eq!(grip.follow(&camera, DVec2::new(0.0, 0.9)), DVec3::ZERO);
        assert_ne!(grip.follow(&camera, DVec2::new(0.1, 0.0)), DVec3::ZERO);
    }
}
