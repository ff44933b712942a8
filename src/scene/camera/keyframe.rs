//! How the camera moves: its keyframes, and where it is between them.

use super::Camera;
use crate::{
    physics::curve::{Ease, Knot, value_at, value_by},
    scene::{
        check::{self, Checked, Fault},
        section::section,
    },
};

section! {
    /// What some numbers of the camera are at a time: one `[[camera.keyframe]]`. Each number is interpolated between the keyframes that give it:
    /// before the first of them and after the last it stands, and a number that no keyframe gives is that of `[camera]`.
    pub struct Keyframe, KeyframeKeys:
    time_s: f64 = 0.0, [0.0 ..= 1000000.0], "Time", " s", "time of the keyframe, s; a microsecond or more after the keyframe above it";
    target_m: Option<[f64; 3]> = None, [-1000.0 ..= 1000.0], "Target", " m", "`target_m` at that time, m";
    azimuth_deg: Option<f64> = None, [-1000000.0 ..= 1000000.0], "Azimuth", "°", "`azimuth_deg` at that time; it is not wrapped: from 0 to 360 is one turn";
    elevation_deg: Option<f64> = None, [-90.0 ..= 90.0], "Elevation", "°", "`elevation_deg` at that time";
    distance_m: Option<f64> = None, [0.0 ..= 1000.0], "Distance", " m", "`distance_m` at that time, m; its logarithm is interpolated";
    fov_y_deg: Option<f64> = None, [1.0 ..= 170.0], "Field of view", "°", "`fov_y_deg` at that time; only where nothing gives a `focal_mm`";
    focal_mm: Option<f64> = None, [1.0 ..= 5000.0], "Focal length", " mm", "`focal_mm` at that time, mm; its logarithm is interpolated";
    ease: Ease = Ease::Smooth, [word], "Ease", "", "how the camera goes on from there to the next keyframe";
}

/// The largest number of keyframes of one camera.
pub const MAX_KEYFRAMES: usize = 1000;

/// Shortest time between two keyframes, s.
const SHORTEST_S: f64 = 1e-6;

/// What is added to a distance before its logarithm is interpolated, m: a camera can go to its target, and come from there.
const NEAR_M: f64 = 1e-3;

impl Camera {
    /// The camera at a time in s: where its keyframes have it then, itself if there are none. It has no keyframes itself.
    #[must_use]
    pub fn at(&self, time_s: f64) -> Self {
        if self.keyframes.is_empty() {
            return self.clone();
        }
        let number = |of: &dyn Fn(&Keyframe) -> Option<f64>| value_at(&self.knots(of), time_s);
        let target_m = |axis: usize| number(&|keyframe| keyframe.target_m.map(|target_m| target_m[axis]));
        let distances = self.knots(&|keyframe| keyframe.distance_m);
        let distance_m =
            value_by(&distances, time_s, |distance_m| (distance_m + NEAR_M).ln(), |log| log.exp() - NEAR_M);
        let focal_mm = value_by(&self.knots(&|keyframe| keyframe.focal_mm), time_s, f64::ln, f64::exp);
        Self {
            target_m: std::array::from_fn(|axis| target_m(axis).unwrap_or(self.target_m[axis])),
            azimuth_deg: number(&|keyframe| keyframe.azimuth_deg).unwrap_or(self.azimuth_deg),
            elevation_deg: number(&|keyframe| keyframe.elevation_deg).unwrap_or(self.elevation_deg),
            distance_m: distance_m.unwrap_or(self.distance_m),
            fov_y_deg: number(&|keyframe| keyframe.fov_y_deg).unwrap_or(self.fov_y_deg),
            focal_mm: focal_mm.or(self.focal_mm),
            sensor_mm: self.sensor_mm,
            follow_deg: self.follow_deg,
            keyframes: Vec::new(),
        }
    }

    /// A keyframe at a time in s that gives every number of this camera.
    #[must_use]
    pub fn keyframe(&self, time_s: f64) -> Keyframe {
        Keyframe {
            time_s,
            target_m: Some(self.target_m),
            azimuth_deg: Some(self.azimuth_deg),
            elevation_deg: Some(self.elevation_deg),
            distance_m: Some(self.distance_m),
            fov_y_deg: self.focal_mm.is_none().then_some(self.fov_y_deg),
            focal_mm: self.focal_mm,
            ease: Ease::default(),
        }
    }

    /// The keyframes that give a number.
    fn knots(&self, number: &dyn Fn(&Keyframe) -> Option<f64>) -> Vec<Knot> {
        let knot = |keyframe: &Keyframe| {
            let Keyframe { time_s, ease, .. } = *keyframe;
            number(keyframe).map(|value| Knot { time_s, value, ease })
        };
        self.keyframes.iter().filter_map(knot).collect()
    }

    pub(in crate::scene) fn check(&self) -> Checked {
        self.check_ranges()?;
        check::at_most("keyframe", self.keyframes.len(), MAX_KEYFRAMES)?;
        check::each("keyframe", &self.keyframes, Keyframe::check_ranges)?;
        self.check_order()?;
        self.check_lens()
    }

    fn check_order(&self) -> Checked {
        let is_early = |pair: &[Keyframe]| pair[1].time_s - pair[0].time_s < SHORTEST_S;
        let early = self.keyframes.windows(2).position(is_early);
        early.map_or(Ok(()), |first| {
            let [before, time_s] = [first, first + 1].map(|index| self.keyframes[index].time_s);
            let reason = format!(
                "is {time_s} after a keyframe at {before} s; sort the keyframes, and give each a time of its own"
            );
            Err(Fault::new("time_s", reason).inside_item("keyframe", first + 1))
        })
    }

    /// A field of view that a focal length takes the place of would do nothing.
    fn check_lens(&self) -> Checked {
        if self.focal_mm.is_none() && self.keyframes.iter().all(|keyframe| keyframe.focal_mm.is_none()) {
            return Ok(());
        }
        let idle = self.keyframes.iter().position(|keyframe| keyframe.fov_y_deg.is_some());
        idle.map_or(Ok(()), |index| {
            let reason = "has no effect, because `focal_mm` takes its place; give `focal_mm` in each of them";
            Err(Fault::new("fov_y_deg", reason).inside_item("keyframe", index))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keyframe(time_s: f64) -> Keyframe {
        Keyframe { time_s, ..Keyframe::default() }
    }

    fn moved(keyframes: Vec<Keyframe>) -> Camera {
        Camera { keyframes, ..Camera::default() }
    }

    #[test]
    fn a_number_is_interpolated_between_the_keyframes_that_give_it() {
        let camera = moved(vec![
            Keyframe { azimuth_deg: Some(10.0), ease: Ease::Linear, ..keyframe(1.0) },
            Keyframe { elevation_deg: Some(45.0), target_m: Some([0.1, 0.2, 0.3]), ..keyframe(2.0) },
            Keyframe { azimuth_deg: Some(30.0), ..keyframe(5.0) },
        ]);
        assert_eq!(
            [0.0, 1.0, 2.0, 5.0, 99.0].map(|time_s| camera.at(time_s).azimuth_deg),
            [10.0, 10.0, 15.0, 30.0, 30.0]
        );
        for time_s in [0.0, 3.0, 9.0] {
            let at = camera.at(time_s);
            assert_eq!((at.elevation_deg, at.target_m), (45.0, [0.1, 0.2, 0.3]), "one keyframe holds for all times");
            assert_eq!((at.distance_m, at.fov_y_deg, at.keyframes.len()), (camera.distance_m, camera.fov_y_deg, 0));
        }
        assert_eq!(Camera::default().at(3.0), Camera::default());
    }

    #[test]
    fn every_number_can_move() {
        let key = |time_s, factor: f64| Keyframe {
            target_m: Some([factor, 2.0 * factor, 3.0 * factor]),
            azimuth_deg: Some(4.0 * factor),
            elevation_deg: Some(5.0 * factor),
            distance_m: Some(6.0 * factor),
            fov_y_deg: Some(7.0 * factor),
            ..keyframe(time_s)
        };
        let camera = moved(vec![key(0.0, 1.0), key(2.0, 3.0)]);
        for (time_s, factor) in [(0.0, 1.0), (2.0, 3.0)] {
            assert_eq!(camera.at(time_s).keyframe(time_s), key(time_s, factor));
        }
        let middle = camera.at(1.0);
        assert_eq!((middle.target_m, middle.azimuth_deg, middle.elevation_deg), ([2.0, 4.0, 6.0], 8.0, 10.0));
        // The mean of the logarithms, but for the millimetre.
        assert!((middle.distance_m - (6.0f64 * 18.0).sqrt()).abs() < 1e-3 && middle.fov_y_deg == 14.0, "{middle:?}");
    }

    #[test]
    fn a_turntable_of_two_keyframes_turns_at_constant_speed() {
        let key =
            |time_s, azimuth_deg| Keyframe { azimuth_deg: Some(azimuth_deg), ease: Ease::Linear, ..keyframe(time_s) };
        let camera = moved(vec![key(0.0, 20.0), key(8.0, 740.0)]);
        for tick in 0..480 {
            let expected = 20.0 + 1.5 * f64::from(tick);
            assert!((camera.at(f64::from(tick) / 60.0).azimuth_deg - expected).abs() < 1e-10);
        }
    }

    #[test]
    fn a_camera_goes_to_its_target_and_back() {
        let key = |time_s, distance_m| Keyframe { distance_m: Some(distance_m), ..keyframe(time_s) };
        let camera = moved(vec![key(0.0, 1.0), key(1.0, 0.0), key(2.0, 5.0)]);
        assert_eq!([0.0, 1.0, 2.0].map(|time_s| camera.at(time_s).distance_m), [1.0, 0.0, 5.0]);
        let all = (0..=2000).map(|k| camera.at(1e-3 * f64::from(k)).distance_m);
        assert!(all.clone().all(|distance_m| (0.0..=5.0).contains(&distance_m)));
        assert!(all.take(1000).is_sorted_by(|a, b| a >= b));
    }

    #[test]
    fn a_lens_zooms_by_equal_factors() {
        let key = |time_s, focal_mm| Keyframe { focal_mm: Some(focal_mm), ease: Ease::Linear, ..keyframe(time_s) };
        let camera = moved(vec![key(0.0, 25.0), key(2.0, 100.0)]);
        assert!((camera.at(1.0).focal_mm.unwrap() - 50.0).abs() < 1e-12);
    }
}
