//! The window's clock: film time in whole ticks, driven by wall time.

use crate::{plan::Moment, scene::Motion};

/// Largest wall time that one frame may add, s: after a pause of the whole machine the film goes on where it was.
const MAX_WALL_S: f64 = 0.5;

/// A tick that lasts longer than this on the wall is shown in between too, s: slow motion would stutter otherwise.
const SMOOTH_TICK_S: f64 = 1.0 / 45.0;

/// Longest time between two pictures in slow motion, s.
const FRAME_S: f64 = 1.0 / 60.0;

/// Film time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Whole ticks since the films began.
    pub tick: u64,
    /// Whether wall time moves it.
    pub running: bool,
    /// Part of the next tick that has passed, in [0, 1).
    fraction: f64,
}

impl Default for Clock {
    fn default() -> Self {
        Self { tick: 0, running: true, fraction: 0.0 }
    }
}

impl Clock {
    /// Lets wall time pass.
    pub fn advance(&mut self, wall_s: f64, motion: &Motion) {
        if self.running {
            let ticks = self.fraction + wall_s.clamp(0.0, MAX_WALL_S) * motion.speed / motion.tick_s;
            self.tick = self.tick.saturating_add(ticks as u64);
            self.fraction = ticks.fract();
        }
    }

    /// Takes back the ticks that the films could not keep up with, but none before `earliest`.
    pub fn hold(&mut self, reached: u64, earliest: u64) {
        let tick = reached.max(earliest);
        if tick < self.tick {
            *self = Self { tick, fraction: 0.0, ..*self };
        }
    }

    /// Goes on by one tick, and stands.
    pub fn step(&mut self) {
        *self = Self { tick: self.tick.saturating_add(1), fraction: 0.0, running: false };
    }

    /// Goes to a tick, running as before.
    pub fn seek(&mut self, tick: u64) {
        *self = Self { tick, fraction: 0.0, ..*self };
    }

    /// Goes back to the films' beginning, running as before.
    pub fn reset(&mut self) {
        self.seek(0);
    }

    /// The moment to show.
    #[must_use]
    pub fn moment(&self, motion: &Motion) -> Moment {
        let fraction = if self.is_slow(motion) { self.fraction } else { 0.0 };
        Moment { tick: self.tick, fraction }
    }

    /// Film time, s.
    #[must_use]
    pub fn time_s(&self, motion: &Motion) -> f64 {
        self.tick as f64 * motion.tick_s
    }

    /// Wall time until there is another moment to show, s; `None` while the clock is paused.
    #[must_use]
    pub fn until_next_s(&self, motion: &Motion) -> Option<f64> {
        let tick_s = (1.0 - self.fraction) * motion.tick_s / motion.speed;
        self.running.then(|| if self.is_slow(motion) { tick_s.min(FRAME_S) } else { tick_s })
    }

    fn is_slow(&self, motion: &Motion) -> bool {
        motion.tick_s / motion.speed > SMOOTH_TICK_S
    }
}

/// How fast film time passes, measured over a second of wall time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rate {
    wall_s: f64,
    since_s: f64,
    latest: Option<f64>,
}

impl Rate {
    /// Notes the film's time, a wall time after the last note.
    pub fn note(&mut self, wall_s: f64, film_s: f64) {
        self.wall_s += wall_s;
        if film_s < self.since_s {
            // It was set back.
            *self = Self { since_s: film_s, ..Self::default() };
        } else if self.wall_s >= 1.0 {
            *self = Self { wall_s: 0.0, since_s: film_s, latest: Some((film_s - self.since_s) / self.wall_s) };
        }
    }

    /// Begins anew, because time stands or was moved.
    pub fn restart(&mut self, film_s: f64) {
        *self = Self { since_s: film_s, ..Self::default() };
    }

    /// Film time over wall time, once it is known.
    #[must_use]
    pub fn latest(&self) -> Option<f64> {
        self.latest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_is_that_of_the_last_second() {
        let mut rate = Rate::default();
        (1..=20).for_each(|k| rate.note(0.1, 0.03 * f64::from(k)));
        assert!(rate.latest().is_some_and(|rate| (rate - 0.3).abs() < 0.02), "{rate:?}");
        rate.note(0.1, 0.0);
        assert_eq!(rate.latest(), None, "time was set back");
    }

    fn motion(tick_s: f64, speed: f64) -> Motion {
        Motion { tick_s, speed, ..Motion::default() }
    }

    #[test]
    fn wall_time_becomes_whole_ticks_and_loses_nothing() {
        let (mut clock, motion) = (Clock::default(), motion(0.01, 1.0));
        for _ in 0..1000 {
            clock.advance(0.003, &motion);
        }
        // 3 s are 300 ticks; a thousand roundings of 1e-16 each may keep the last one from being whole.
        assert!((299..=300).contains(&clock.tick), "{}", clock.tick);
        assert_eq!(clock.moment(&motion).fraction, 0.0, "at full speed only whole ticks are shown");
    }

    #[test]
    fn time_that_cannot_be_kept_up_with_creates_no_ticks() {
        let (mut clock, motion) = (Clock::default(), motion(0.01, 1.0));
        clock.advance(3600.0, &motion);
        assert_eq!(clock.tick, 50);
        clock.hold(4, 0);
        assert_eq!((clock.tick, clock.time_s(&motion)), (4, 0.04));
        clock.hold(2, 4);
        assert_eq!(clock.tick, 4, "what was shown is not taken back");
        clock.hold(9, 0);
        assert_eq!(clock.tick, 4, "holding never goes forward");
    }

    #[test]
    fn a_standing_clock_stands_until_it_is_stepped() {
        let (mut clock, motion) = (Clock { running: false, ..Clock::default() }, motion(0.01, 1.0));
        clock.advance(0.1, &motion);
        assert_eq!((clock.tick, clock.until_next_s(&motion)), (0, None));
        clock.step();
        assert_eq!(clock.moment(&motion), Moment::tick(1));
        clock.reset();
        assert_eq!(clock, Clock { running: false, ..Clock::default() });
    }

    #[test]
    fn slow_motion_shows_moments_between_ticks() {
        let (mut clock, slow) = (Clock::default(), motion(0.01, 0.1));
        clock.advance(0.025, &slow);
        let moment = clock.moment(&slow);
        assert_eq!(moment.tick, 0);
        assert!((moment.fraction - 0.25).abs() < 1e-12, "{moment}");
        assert!(clock.until_next_s(&slow).is_some_and(|wait| wait <= FRAME_S));
    }
}
