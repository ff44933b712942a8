//! The key of the camera.

use glam::{DVec2, DVec3};

/// Where the picture is taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    /// The eye, in metres.
    pub eye_m: DVec3,
    /// Unit vector along the line of sight.
    pub forward: DVec3,
    /// Unit vector to the right of the picture.
    pub right: DVec3,
    /// Unit vector to its top.
    pub up: DVec3,
    /// Height of a pixel on the plane one metre before the eye, in metres.
    pub pixel_height_m: f64,
    /// Where the line of sight meets the picture, in pixels to the right of its middle and below: zero but for a part of a larger picture, or a place beside the middle of the lens.
    pub shift: DVec2,
}

impl CameraKey {
    /// Where the line of sight meets a picture of that size, in pixels from the top left.
    #[must_use]
    pub fn axis(&self, size: [u32; 2]) -> DVec2 {
        0.5 * DVec2::from(size.map(f64::from)) + self.shift
    }

    /// Directions through the corners of a picture of that size and of a margin around it, in order around it. The margin is in pixels.
    #[must_use]
    pub fn corners(&self, size: [u32; 2], margin: f64) -> [DVec3; 4] {
        let (low, high) = (DVec2::splat(-margin), DVec2::from(size.map(f64::from)) + margin);
        [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|corner| {
            let offset = self.pixel_height_m * (corner - self.axis(size));
            self.forward + offset.x * self.right - offset.y * self.up
        })
    }
}
