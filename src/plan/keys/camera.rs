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
    /// Radius of the lens that bubbles are out of focus by, in metres; 0 where they are sharp.
    pub lens_radius_m: f64,
    /// Depth along the line of sight that is in focus, in metres.
    pub focus_m: f64,
}

/// Radius in pixels of the smallest circle of confusion that is drawn.
const LEAST_CONFUSION_PIXELS: f64 = 0.75;
/// Largest radius of a circle of confusion, over the radius of the bubble in the picture: more would leave too few samples on the bubble.
const MOST_CONFUSION_RADII: f64 = 2.0;
/// How far from the depth in focus a bubble's center may be for the bubble to be sharp, in radii: what is seen of a bubble lies up to a radius before
/// its center and behind it.
const SHARP_DEPTH_RADII: f64 = 0.25;
/// Distance of the eye from a bubble's center, in radii, below which the bubble is sharp: its walls have no one depth.
const NEAREST_CONFUSED_RADII: f64 = 1.5;

impl CameraKey {
    /// Where the line of sight meets a picture of that size, in pixels from the top left.
    #[must_use]
    pub fn axis(&self, size: [u32; 2]) -> DVec2 {
        0.5 * DVec2::from(size.map(f64::from)) + self.shift
    }

    /// Radius of the circle of confusion that the lens makes of each point of a bubble, in pixels; 0 if the bubble is sharp. By the thin lens, for a point
    /// about as deep as the bubble's center: the lens as it is seen from that depth, less the lens as it is seen from the depth in focus.
    #[must_use]
    pub fn confusion_pixels(&self, center_m: DVec3, radius_m: f64) -> f64 {
        let offset_m = center_m - self.eye_m;
        let distance_m = offset_m.length();
        if self.lens_radius_m == 0.0 || distance_m < NEAREST_CONFUSED_RADII * radius_m {
            return 0.0;
        }
        let beyond_m = offset_m.dot(self.forward).max(radius_m) - self.focus_m;
        let slack_m = SHARP_DEPTH_RADII * radius_m;
        let depth_m = self.focus_m + beyond_m - beyond_m.clamp(-slack_m, slack_m);
        let pixels = self.lens_radius_m * (self.focus_m.recip() - depth_m.recip()).abs() / self.pixel_height_m;
        let most = MOST_CONFUSION_RADII * radius_m / distance_m / self.pixel_height_m;
        if pixels < LEAST_CONFUSION_PIXELS { 0.0 } else { pixels.min(most) }
    }

    /// Whether a bubble is sharp.
    #[must_use]
    pub fn is_in_focus(&self, center_m: DVec3, radius_m: f64) -> bool {
        self.confusion_pixels(center_m, radius_m) == 0.0
    }

    /// The power of the eye with respect to a sphere, in m²: it orders all spheres that do not intersect as the eye sees them.
    #[must_use]
    pub fn power(&self, center_m: DVec3, radius_m: f64) -> f64 {
        center_m.distance_squared(self.eye_m) - radius_m.powi(2)
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
