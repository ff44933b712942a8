//! The path of a bubble's center, which follows a target that jumps from place to place.

use glam::DVec3;

use crate::physics::timeline::Prefix;

/// Time constant τ of the critically damped motion `c″ = (target − c)/τ² − 2c′/τ`, s: a hand's. The center comes within 4 % in 5 τ, and a jump
/// of the target by d accelerates it by up to d/τ², which for a radius of 5 cm is half of gravity.
pub const SETTLING_S: f64 = 0.1;

/// The path of a center: in closed form between the jumps of its target.
#[derive(Clone, Debug, PartialEq)]
pub struct CenterPath {
    /// From when on, in seconds, each target holds, and where the center is and how fast at that time.
    legs: Prefix<Leg>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Leg {
    from_s: f64,
    target_m: DVec3,
    start: State,
}

/// How a center moves on a leg: with `(start + slope s) e^(−s)` m/s, s the time since `from_s` over `settling_s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LegMotion {
    pub from_s: f64,
    pub start: DVec3,
    pub slope: DVec3,
    pub settling_s: f64,
}

/// Where a center is and how fast it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Place, m.
    pub place_m: DVec3,
    /// Velocity, m/s.
    pub velocity_m_s: DVec3,
}

impl Default for CenterPath {
    /// Rest at the origin.
    fn default() -> Self {
        Self::new(DVec3::ZERO, [])
    }
}

impl CenterPath {
    /// The path of a center that rests at a place until its target jumps, at times in seconds in their order.
    #[must_use]
    pub fn new(rest_m: DVec3, jumps: impl IntoIterator<Item = (f64, DVec3)>) -> Self {
        let start = State { place_m: rest_m, velocity_m_s: DVec3::ZERO };
        let mut leg = Leg { from_s: 0.0, target_m: rest_m, start };
        let mut legs = vec![leg];
        for (from_s, target_m) in jumps {
            leg = Leg { from_s, target_m, start: leg.at(from_s) };
            legs.push(leg);
        }
        Self { legs: legs.into_iter().collect() }
    }

    /// Where the center is and how fast it moves at a time in seconds.
    #[must_use]
    pub fn at(&self, time_s: f64) -> State {
        let begun = self.legs.partition_point(|leg| leg.from_s <= time_s);
        self.legs[begun.saturating_sub(1)].at(time_s)
    }

    /// What of the path was decided before a time in seconds.
    #[must_use]
    pub fn until(&self, end_s: f64) -> Self {
        Self { legs: self.legs.cut(|leg| leg.from_s < end_s || leg.from_s == 0.0) }
    }

    /// Whether both are parts of one path, which takes no look at its legs.
    #[must_use]
    pub fn shares(&self, other: &Self) -> bool {
        self.legs.shares(&other.legs)
    }

    /// Whether the center never moves.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.legs.iter().all(|leg| leg.target_m == leg.start.place_m)
    }

    /// How the center moves from each jump on.
    pub(super) fn motions(&self) -> impl Iterator<Item = LegMotion> {
        self.legs.iter().map(|leg| {
            let a = leg.start.place_m - leg.target_m;
            let b = a + SETTLING_S * leg.start.velocity_m_s;
            let [start, slope] = [b - a, -b].map(|part| part / SETTLING_S);
            LegMotion { from_s: leg.from_s, start, slope, settling_s: SETTLING_S }
        })
    }

    /// Mean acceleration between two times in seconds, m/s².
    #[must_use]
    pub fn mean_acceleration(&self, from_s: f64, to_s: f64) -> DVec3 {
        (self.at(to_s).velocity_m_s - self.at(from_s).velocity_m_s) / (to_s - from_s)
    }
}

impl Leg {
    /// The solution `target + (A + B s) e^(−s)` in s, the time since the jump over τ.
    fn at(&self, time_s: f64) -> State {
        let s = (time_s - self.from_s).max(0.0) / SETTLING_S;
        let a = self.start.place_m - self.target_m;
        let b = a + SETTLING_S * self.start.velocity_m_s;
        let decay = (-s).exp();
        State { place_m: self.target_m + decay * (a + s * b), velocity_m_s: decay / SETTLING_S * (b - a - s * b) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path() -> CenterPath {
        CenterPath::new(DVec3::Y, [(0.5, DVec3::X), (0.6, DVec3::new(1.0, 2.0, 3.0)), (0.63, DVec3::ZERO)])
    }

    #[test]
    fn it_obeys_its_law_and_is_smooth_at_jumps() {
        let (path, d) = (path(), 1e-5);
        for (time, target) in [(0.55, DVec3::X), (0.62, DVec3::new(1.0, 2.0, 3.0)), (0.8, DVec3::ZERO)] {
            let [before, now, after] = [time - d, time, time + d].map(|time| path.at(time));
            let velocity = (after.place_m - before.place_m) / (2.0 * d);
            assert!(velocity.distance(now.velocity_m_s) < 1e-6);
            let law = (target - now.place_m) / SETTLING_S.powi(2) - 2.0 * now.velocity_m_s / SETTLING_S;
            assert!(path.mean_acceleration(time - d, time + d).distance(law) < 1e-4 * law.length());
        }
        for jump in [0.5, 0.6, 0.63] {
            let [before, after] = [jump - 1e-9, jump].map(|time| path.at(time));
            assert!(before.place_m.distance(after.place_m) < 1e-6);
            assert!(before.velocity_m_s.distance(after.velocity_m_s) < 1e-4);
        }
    }

    #[test]
    fn it_rests_before_and_arrives_without_passing() {
        let path = CenterPath::new(DVec3::Y, [(0.5, DVec3::X)]);
        assert_eq!(path.at(0.4), State { place_m: DVec3::Y, velocity_m_s: DVec3::ZERO });
        let way = |time: f64| (path.at(time).place_m - DVec3::Y).dot(DVec3::X - DVec3::Y) / 2.0;
        let ways: Vec<f64> = (0..200).map(|k| way(0.5 + 0.01 * f64::from(k))).collect();
        assert!(ways.is_sorted() && ways[50] > 0.95 && ways[199] <= 1.0);
        assert!((path.at(5.0).place_m - DVec3::X).length() < 1e-15);
    }
}
