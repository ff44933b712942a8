//! The camera's lens: what makes a picture a photograph.

use super::{Camera, section::section};

section! {
    /// The camera's lens: `[lens]`.
    pub struct Lens, LensKeys:
    aperture_mm: f64 = 0.0, [0.0 ..= 200.0], "Aperture", " mm", "diameter of the aperture, mm (focal length over f-number: 85 mm at f/2.8 has 30 mm); what is nearer than the distance in focus or farther is out of focus, and each of its points becomes a disc; 0: all is sharp";
    blades: u32 = 0, [0 ..= 16], "Blades", "", "blades of the aperture, whose polygon bright points have in pictures of several samples per pixel; below 3, it is round";
    focus_m: Option<f64> = None, [0.01 ..= 1000.0], "Focus", " m", "distance from the eye that is in focus, m; without it, the distance of the camera's target";
    shutter_s: f64 = 0.0, [0.0 ..= 10.0], "Shutter", " s", "time that the shutter is open from the moment of the picture on, s: in pictures of several samples per pixel, what moves is blurred; a film camera has 1/48";
    glare: f64 = 0.0, [0.0 ..= 0.5], "Glare", "", "part of light that the lens scatters around bright points, in 8-bit pictures; 0.03 is a good lens, 0.1 a dusty one";
    vignetting_ev: f64 = 0.0, [0.0 ..= 4.0], "Vignetting", " EV", "stops by which the corners of 8-bit pictures are darker";
    grain: f64 = 0.0, [0.0 ..= 0.5], "Grain", "", "grain of 8-bit pictures: relative deviation of a pixel that is exposed as white; darker ones have more";
}

/// Largest half angle of the disc that a far point is blurred to, in radians.
const MAX_DEFOCUS_RAD: f64 = 0.5;

impl Lens {
    /// Distance from the eye that is in focus, m.
    #[must_use]
    pub fn in_focus_m(&self, camera: &Camera) -> f64 {
        self.focus_m.unwrap_or(camera.distance_m).max(1e-3)
    }

    /// Half angle of the cone of directions that an infinitely far background is averaged over, in radians, 0 to 0.5: the lens as
    /// it is seen from the point in focus.
    #[must_use]
    pub fn defocus_rad(&self, camera: &Camera) -> f64 {
        (0.5e-3 * self.aperture_mm / self.in_focus_m(camera)).atan().min(MAX_DEFOCUS_RAD)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_far_point_is_blurred_to_the_lens_as_seen_from_the_focus() {
        let camera = Camera { distance_m: 0.5, ..Camera::default() };
        let blur = |aperture_mm, focus_m| Lens { aperture_mm, focus_m, ..Lens::default() }.defocus_rad(&camera);
        assert_eq!(blur(0.0, None), 0.0);
        assert!((blur(30.0, None) - 0.03f64.atan()).abs() < 1e-15);
        assert_eq!(blur(30.0, Some(0.5)), blur(30.0, None));
        assert!((blur(30.0, Some(1.0)) - 0.015f64.atan()).abs() < 1e-15);
        assert_eq!(blur(200.0, Some(0.01)), MAX_DEFOCUS_RAD);
    }
}
