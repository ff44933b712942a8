//! Softboxes: lamps behind rectangles of cloth.

use glam::{DVec2, DVec3};

use super::shape::{bell, rounded_box_distance, smoothstep};

/// How the cloth of a softbox spreads its light; lengths are seen from 1 away.
pub(super) struct Look {
    /// Radius of its corners.
    pub corner: f64,
    /// Distances from the rectangle's outline, positive outside, at which light begins, and at which it is whole.
    pub edge: [f64; 2],
    /// Radiance far from the middle, relative to the middle's.
    pub rim: f64,
    /// Width of the bright middle, relative to the half size.
    pub middle: f64,
}

/// A bright rounded rectangle, brightest in the middle.
pub(super) struct Softbox {
    towards: DVec3,
    right: DVec3,
    up: DVec3,
    half_size: DVec2,
    radiance: DVec3,
    look: &'static Look,
}

impl Softbox {
    /// A softbox by azimuth and elevation in degrees, half width and height seen from 1 away, and radiance in the middle.
    pub fn new(
        (azimuth_deg, elevation_deg, half_size, radiance): (f64, f64, DVec2, DVec3),
        look: &'static Look,
    ) -> Self {
        let level = DVec2::from_angle(azimuth_deg.to_radians());
        let (sin_elevation, cos_elevation) = elevation_deg.to_radians().sin_cos();
        let towards = (cos_elevation * level).extend(sin_elevation);
        let right = level.perp().extend(0.0);
        Self { towards, right, up: towards.cross(right), half_size, radiance, look }
    }

    /// Radiance from a unit `direction`.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let facing = direction.dot(self.towards);
        if facing < 0.2 {
            return DVec3::ZERO;
        }
        let Look { corner, edge, rim, middle } = *self.look;
        let position = DVec2::new(direction.dot(self.right), direction.dot(self.up)) / facing;
        let outline = rounded_box_distance(position, self.half_size, corner);
        if outline >= edge[0] {
            return DVec3::ZERO;
        }
        let hot_middle = rim + (1.0 - rim) * bell((position / self.half_size).length(), middle);
        smoothstep(edge[0], edge[1], outline) * hot_middle * self.radiance
    }
}
