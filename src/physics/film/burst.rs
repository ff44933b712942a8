//! How a film bursts: a hole opens at the Taylor–Culick speed of the film at its rim, which gathers the liquid that it sweeps.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::properties::{DENSITY, SURFACE_TENSION};

/// Meridians about its middle along which a hole's rim is followed, evenly spaced.
pub const HOLE_MERIDIANS: usize = 256;
/// Parts of a meridian from the middle of a hole to the point opposite.
pub const HOLE_PARTS: usize = 512;

/// A hole in the film of a sphere. Its rim moves straight away from the middle, on each meridian as fast as the film there lets it.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// Its middle, a unit vector.
    pub middle: DVec3,
    /// The unit vector from which meridians are counted, and that a quarter turn on.
    pub axes: [DVec3; 2],
    /// The rim on each of [`HOLE_MERIDIANS`], the first on the first axis.
    pub rim: Vec<Rim>,
}

/// The rim of a hole on a meridian.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rim {
    /// Angle from the middle of the hole to the film that is still at rest, radians.
    pub outer_rad: f64,
    /// Angle to where the hole ends and the rim begins.
    pub inner_rad: f64,
    /// Mean thickness of the rim, which is a round thread of the liquid that was swept, nm.
    pub thickness_nm: f64,
}

/// Seconds that a rim takes for a radian of a sphere of a radius in m, over the root of the film's thickness in nm: `R √(ρ h / 2γ)`.
#[must_use]
pub fn rim_delay(radius_m: f64) -> f64 {
    radius_m * (1e-9 * DENSITY / (2.0 * SURFACE_TENSION)).sqrt()
}

/// Seconds from the first hole until a film nowhere thicker than `thickest_nm` is gone.
#[must_use]
pub fn burst_s(thickest_nm: f64, radius_m: f64) -> f64 {
    PI * rim_delay(radius_m) * thickest_nm.max(0.0).sqrt()
}

impl Hole {
    /// The hole a number of seconds after it opened, in film of a thickness in nm on a sphere of a radius in m.
    #[must_use]
    pub fn open(thickness_nm: impl Fn(DVec3) -> f64, middle: DVec3, seconds: f64, radius_m: f64) -> Self {
        let axes = meridian_axes(middle);
        let meridian = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / HOLE_MERIDIANS as f64).sin_cos();
            let along = cos * axes[0] + sin * axes[1];
            rim(|angle| thickness_nm(angle.cos() * middle + angle.sin() * along), seconds, radius_m)
        };
        Self { middle, axes, rim: (0..HOLE_MERIDIANS).map(meridian).collect() }
    }

    /// The film's thickness with the hole in it, for its thickness without at a unit vector, nm.
    #[must_use]
    pub fn pierced(&self, direction: DVec3, thickness_nm: f64) -> f64 {
        let turn = direction.dot(self.axes[1]).atan2(direction.dot(self.axes[0])) / TAU;
        let at = turn.rem_euclid(1.0) * HOLE_MERIDIANS as f64;
        let [low, high] = [at as usize, at as usize + 1].map(|k| self.rim[k % HOLE_MERIDIANS]);
        let mix = |of: fn(&Rim) -> f64| of(&low) + at.fract() * (of(&high) - of(&low));
        let angle = direction.dot(self.middle).clamp(-1.0, 1.0).acos();
        if angle >= mix(|rim| rim.outer_rad) {
            thickness_nm
        } else if angle >= mix(|rim| rim.inner_rad) {
            mix(|rim| rim.thickness_nm)
        } else {
            0.0
        }
    }
}

/// Two unit vectors across a third, as `shaders/film/hole.wgsl` has them.
fn meridian_axes(middle: DVec3) -> [DVec3; 2] {
    let helper = if middle.x.abs() > 0.7 { DVec3::Y } else { DVec3::X };
    let first = middle.cross(helper).normalize();
    [first, middle.cross(first)]
}

/// The rim on a meridian whose thickness in nm is a function of the angle from the middle.
fn rim(thickness_nm: impl Fn(f64) -> f64, seconds: f64, radius_m: f64) -> Rim {
    let (step, delay) = (PI / HOLE_PARTS as f64, rim_delay(radius_m));
    let (mut angle, mut left, mut swept) = (0.0, seconds, 0.0);
    for part in 0..HOLE_PARTS {
        let middle = (part as f64 + 0.5) * step;
        let nm = thickness_nm(middle).max(0.0);
        let takes = (delay * nm.sqrt() * step).max(f64::MIN_POSITIVE);
        let share = (left / takes).clamp(0.0, 1.0);
        angle += share * step;
        swept += share * step * nm * middle.sin();
        left -= takes;
        if share < 1.0 {
            break;
        }
    }
    // A thread of circular cross-section: its area, over the squared radius of the sphere, is what was swept over the rim's length.
    let area = 1e-9 * swept / (radius_m * angle.sin().max(1e-3));
    let width = 2.0 * (area / PI).sqrt();
    Rim {
        outer_rad: angle,
        inner_rad: (angle - width).max(0.0),
        thickness_nm: if width > 0.0 { 1e9 * radius_m * area / width } else { 0.0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::film::properties::taylor_culick_speed;

    const RADIUS_M: f64 = 0.05;

    #[test]
    fn a_rim_moves_at_the_speed_of_taylor_and_culick() {
        let hole = Hole::open(|_| 1000.0, DVec3::new(0.6, 0.0, 0.8), 5e-3, RADIUS_M);
        let expected = taylor_culick_speed(SURFACE_TENSION, 1e-6) * 5e-3 / RADIUS_M;
        assert!(hole.rim.iter().all(|rim| (rim.outer_rad / expected - 1.0).abs() < 1e-9), "{:?}", hole.rim[0]);
        // A bubble of 5 cm is gone in 22 ms.
        assert!((burst_s(1000.0, RADIUS_M) - 0.0222).abs() < 1e-4, "{}", burst_s(1000.0, RADIUS_M));
        let gone = Hole::open(|_| 1000.0, DVec3::Z, 0.0223, RADIUS_M);
        assert!(gone.rim.iter().all(|rim| rim.outer_rad > PI - 1e-9));
    }

    #[test]
    fn thin_film_goes_first() {
        let hole = Hole::open(|x| if x.y > 0.0 { 100.0 } else { 900.0 }, DVec3::X, 3e-3, RADIUS_M);
        let angles: Vec<f64> = hole.rim.iter().map(|rim| rim.outer_rad).collect();
        let (min, max) =
            angles.iter().fold((f64::MAX, 0.0_f64), |(low, high), angle| (low.min(*angle), high.max(*angle)));
        assert!((max / min - 3.0).abs() < 1e-6, "{min} {max}");
    }

    #[test]
    fn the_rim_has_what_was_swept() {
        let film = |x: DVec3| 600.0 + 300.0 * x.z;
        let hole = Hole::open(film, DVec3::new(0.0, 0.6, 0.8), 8e-3, RADIUS_M);
        let [left, rim] = hole_liquid(&hole, film);
        // The mean thickness of the film is 600 nm; the midpoint rule over 512 parts, and the rim's curvature across its width.
        assert!(((left + rim) / (4.0 * PI * 600.0) - 1.0).abs() < 2e-3, "{left} {rim}");
        assert!(rim > 0.2 * left, "much of it is in the rim: {left} {rim}");
    }

    /// Liquid of the film at rest and of the rim, nm times the sphere's solid angle.
    fn hole_liquid(hole: &Hole, film: impl Fn(DVec3) -> f64) -> [f64; 2] {
        let parts = 4000;
        let (mut at_rest, mut in_rim) = (0.0, 0.0);
        for (k, rim) in hole.rim.iter().enumerate() {
            let (sin, cos) = (TAU * k as f64 / HOLE_MERIDIANS as f64).sin_cos();
            let along = cos * hole.axes[0] + sin * hole.axes[1];
            let part = TAU / HOLE_MERIDIANS as f64;
            let step = (PI - rim.outer_rad) / f64::from(parts);
            at_rest += (0..parts)
                .map(|n| rim.outer_rad + (f64::from(n) + 0.5) * step)
                .map(|angle| film(angle.cos() * hole.middle + angle.sin() * along) * angle.sin() * step * part)
                .sum::<f64>();
            in_rim += rim.thickness_nm * (rim.inner_rad.cos() - rim.outer_rad.cos()) * part;
        }
        [at_rest, in_rim]
    }

    #[test]
    fn the_film_is_whole_outside_and_gone_inside() {
        let hole = Hole::open(|_| 400.0, DVec3::Z, 2e-3, RADIUS_M);
        let rim = hole.rim[0];
        let at = |angle: f64| hole.pierced(DVec3::new(angle.sin(), 0.0, angle.cos()), 400.0);
        assert_eq!((at(0.0), at(rim.inner_rad - 1e-6), at(rim.outer_rad + 1e-6)), (0.0, 0.0, 400.0));
        assert!(at(0.5 * (rim.inner_rad + rim.outer_rad)) > 1e4, "a thread of many micrometres");
        let none = Hole::open(|_| 400.0, DVec3::Z, 0.0, RADIUS_M);
        assert_eq!(none.pierced(DVec3::Z, 400.0), 400.0);
    }

    #[test]
    fn a_hole_without_film_has_no_rim() {
        let hole = Hole::open(|_| 0.0, DVec3::X, 1e-3, RADIUS_M);
        assert!(hole.rim.iter().all(|rim| rim.thickness_nm == 0.0 && rim.outer_rad.is_finite()));
    }
}
