//! The dark shape of whoever takes the picture.

use glam::{DVec2, DVec3};

use super::shape::{rounded_box_distance, smoothstep};

/// Where the default camera stands, and with it the photographer: azimuth in degrees.
pub const PHOTOGRAPHER_DEG: f64 = 20.0;

/// The photographer, from the front, as a dark shape: all in tangents, as of somebody a metre away.
pub struct Photographer {
    towards: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Photographer {
    /// Where the default camera stands.
    pub fn new() -> Self {
        let level = DVec2::from_angle(PHOTOGRAPHER_DEG.to_radians());
        Self { towards: level.extend(0.0), right: level.perp().extend(0.0), up: DVec3::Z }
    }

    /// What is seen in a direction, with the photographer before what is behind.
    pub fn over(&self, behind: DVec3, direction: DVec3) -> DVec3 {
        let facing = direction.dot(self.towards);
        if facing < 0.5 {
            return behind;
        }
        let place = DVec2::new(direction.dot(self.right), direction.dot(self.up)) / facing;
        if place.x.abs() > 0.32 || place.y > 0.17 || place.y < -1.3 {
            return behind;
        }
        let side = DVec2::new(place.x.abs(), place.y);
        let head = ((place - DVec2::new(0.0, 0.055)) * DVec2::new(1.0, 0.8)).length() - 0.07;
        let camera = rounded_box_distance(place - DVec2::new(0.0, -0.005), DVec2::new(0.075, 0.05), 0.015);
        let trunk = rounded_box_distance(place - DVec2::new(0.0, -0.34), DVec2::new(0.17, 0.28), 0.11);
        let upper_arm = limb(side, DVec2::new(0.155, -0.13), DVec2::new(0.24, -0.30), 0.045);
        let forearm = limb(side, DVec2::new(0.24, -0.30), DVec2::new(0.07, -0.02), 0.034);
        let leg = limb(side, DVec2::new(0.085, -0.55), DVec2::new(0.12, -1.15), 0.075);
        let distance = head.min(camera).min(trunk).min(upper_arm).min(forearm).min(leg);
        let cover = smoothstep(0.006, -0.006, distance);
        let cloth = DVec3::new(0.0070, 0.0075, 0.0090) * (0.8 + 1.5 * smoothstep(-0.6, 0.1, place.y));
        let dark = smoothstep(0.006, -0.006, camera);
        behind.lerp(cloth * (1.0 - 0.75 * dark), cover)
    }
}

/// Signed distance from `place` to a straight limb of round ends.
fn limb(place: DVec2, from: DVec2, to: DVec2, radius: f64) -> f64 {
    let along = to - from;
    let share = ((place - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (place - from - share * along).length() - radius
}
