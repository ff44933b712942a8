//! The camera: rays through pixels.

use glam::{DVec2, DVec3};

/// A pinhole camera. `forward`, `right` and `up` are orthogonal unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureCamera {
    /// The eye, in metres.
    pub eye_m: DVec3,
    /// Along the line of sight.
    pub forward: DVec3,
    /// To the right of the picture.
    pub right: DVec3,
    /// To its top.
    pub up: DVec3,
    /// Height of a pixel on the plane one metre before the eye, in metres.
    pub pixel_height_m: f64,
}

impl PictureCamera {
    /// The unit vector along which a position in a picture of that size looks: pixels from the top left, y down.
    #[must_use]
    pub fn ray(&self, [width, height]: [u32; 2], position: DVec2) -> DVec3 {
        let middle = 0.5 * DVec2::new(f64::from(width), f64::from(height));
        let offset = (position - middle) * self.pixel_height_m;
        (self.forward + offset.x * self.right - offset.y * self.up).normalize()
    }

    /// The position in a picture of that size at which a direction is seen; `None` for a direction behind the eye: the inverse of
    /// [`Self::ray`].
    #[must_use]
    pub fn position(&self, [width, height]: [u32; 2], direction: DVec3) -> Option<DVec2> {
        let depth = direction.dot(self.forward);
        let middle = 0.5 * DVec2::new(f64::from(width), f64::from(height));
        let offset = DVec2::new(direction.dot(self.right), -direction.dot(self.up)) / (depth * self.pixel_height_m);
        (depth > 0.0).then_some(middle + offset)
    }
}
