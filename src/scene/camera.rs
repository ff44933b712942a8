//! The camera: an orbit around a target, and the keyframes that move it.

mod keyframe;

pub use keyframe::{Keyframe, KeyframeKeys, MAX_KEYFRAMES};

use super::section::section;
use glam::DVec3;

section! {
    /// A camera on an orbit around its target, +z up: `[camera]`. [`Camera::at`] is where its keyframes move it.
    pub struct Camera, CameraKeys: [
        #[serde(rename = "keyframe", skip_serializing_if = "Vec::is_empty")]
        keyframes: Vec<Keyframe> = Vec::new(), "How it moves, in the order of the times, at most [`MAX_KEYFRAMES`]";
    ]
    target_m: [f64; 3] = [0.0; 3], [-1000.0 ..= 1000.0], "Target", " m", "the point in the middle of the picture, m";
    azimuth_deg: f64 = 20.0, [finite], "Azimuth", "°", "azimuth of the eye, from +x towards +y";
    elevation_deg: f64 = 8.0, [-90.0 ..= 90.0], "Elevation", "°", "elevation of the eye above the horizon";
    distance_m: f64 = 0.24, [0.0 ..= 1000.0], "Distance", " m", "distance from the target to the eye, m; at 0 the eye is at the target";
    fov_y_deg: f64 = 30.0, [1.0 ..= 170.0], "Field of view", "°", "full vertical field of view";
    focal_mm: Option<f64> = None, [1.0 ..= 5000.0], "Focal length", " mm", "focal length of the lens, mm: it takes the place of `fov_y_deg`";
    sensor_mm: f64 = 24.0, [1.0 ..= 500.0], "Sensor height", " mm", "height of the sensor that a picture fills, mm, where `focal_mm` is given: 24 for a full frame of 3:2, and 20.25 for the same sensor cropped to 16:9";
    follow_deg: f64 = 0.0, [0.0 ..= 180.0], "Follow", "°", "angle by which the eye goes around the target in a window while the pointer moves over as much as the picture's height; 0: it stays";
}

impl Camera {
    /// Position of the eye, m.
    pub fn eye(&self) -> DVec3 {
        DVec3::from(self.target_m) - self.distance_m * self.forward()
    }

    /// Full vertical field of view, radians: that of the lens, if there is one.
    pub fn fov_y_rad(&self) -> f64 {
        let of_lens = |focal_mm: f64| 2.0 * (0.5 * self.sensor_mm / focal_mm).atan();
        // What `fov_y_deg` may be.
        self.focal_mm.map_or(self.fov_y_deg.to_radians(), |focal_mm| of_lens(focal_mm).min(170f64.to_radians()))
    }

    /// Unit vector along the view, from the eye to the target; defined at distance 0 too.
    pub fn forward(&self) -> DVec3 {
        let (sin_az, cos_az) = self.azimuth_deg.to_radians().sin_cos();
        let (sin_el, cos_el) = self.elevation_deg.to_radians().sin_cos();
        -DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
    }

    /// Unit vector to the right in the picture: horizontal, and defined straight above the target too.
    pub fn right(&self) -> DVec3 {
        let (sin_az, cos_az) = self.azimuth_deg.to_radians().sin_cos();
        DVec3::new(-sin_az, cos_az, 0.0)
    }

    /// Unit vector upwards in the picture.
    pub fn up(&self) -> DVec3 {
        self.right().cross(self.forward())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Bubble;
    use super::*;

    #[test]
    fn default_bubble_fills_80_percent_of_the_height() {
        let (camera, bubble) = (Camera::default(), Bubble::default());
        // The cone that touches a sphere of radius r from the distance d has the half angle asin(r / d).
        let half_angle = (bubble.radius_mm * 1e-3 / camera.distance_m).asin();
        let filled = half_angle.tan() / (camera.fov_y_deg / 2.0).to_radians().tan();
        assert!((filled - 0.8).abs() < 0.01, "the bubble fills {filled} of the height");
    }

    #[test]
    fn a_lens_sees_what_its_sensor_holds() {
        let of = |focal_mm| Camera { focal_mm, ..Camera::default() }.fov_y_rad().to_degrees();
        assert!((of(None) - 30.0).abs() < 1e-12);
        // A normal lens of full frame: 26.99 degrees vertically.
        assert!((of(Some(50.0)) - 26.9915).abs() < 1e-4 && (of(Some(12.0)) - 90.0).abs() < 1e-9);
    }

    #[test]
    fn eye_stands_where_the_angles_say() {
        let at = |azimuth_deg, elevation_deg| {
            Camera { target_m: [1.0, 2.0, 3.0], azimuth_deg, elevation_deg, distance_m: 2.0, ..Camera::default() }.eye()
        };
        let target = DVec3::new(1.0, 2.0, 3.0);
        // Positions of order 1 computed in f64: a few ulp.
        assert!(at(0.0, 0.0).abs_diff_eq(target + 2.0 * DVec3::X, 1e-14));
        assert!(at(90.0, 0.0).abs_diff_eq(target + 2.0 * DVec3::Y, 1e-14));
        assert!(at(123.0, 90.0).abs_diff_eq(target + 2.0 * DVec3::Z, 1e-14));
        assert!(at(180.0, -30.0).abs_diff_eq(target + DVec3::new(-(3f64.sqrt()), 0.0, -1.0), 1e-14));
    }

    #[test]
    fn axes_are_right_handed_and_unmirrored() {
        for (azimuth_deg, elevation_deg) in [(0.0, 0.0), (20.0, 8.0), (200.0, -60.0), (77.0, 90.0), (77.0, -90.0)] {
            let camera = Camera { azimuth_deg, elevation_deg, distance_m: 0.0, ..Camera::default() };
            let (forward, right, up) = (camera.forward(), camera.right(), camera.up());
            assert!(right.cross(up).abs_diff_eq(-forward, 1e-14), "{azimuth_deg}, {elevation_deg}");
            assert!(forward.dot(right).abs() < 1e-15 && (up.length() - 1.0).abs() < 1e-14);
            assert!(up.z >= -1e-15, "+z must never point downwards in the picture");
        }
        // From +x one looks along -x, and +y is to the right.
        let camera = Camera { azimuth_deg: 0.0, elevation_deg: 0.0, ..Camera::default() };
        assert!(camera.right().abs_diff_eq(DVec3::Y, 1e-15) && camera.up().abs_diff_eq(DVec3::Z, 1e-15));
    }
}
