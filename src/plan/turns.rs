//! How films turn as a whole.

use glam::{DQuat, DVec3};

use crate::{physics::timeline::Timeline, scene::Motion};

/// How all films turn as a whole under each motion.
#[derive(Clone, Debug)]
pub(super) struct Turns {
    tick_s: f64,
    motions: Timeline<Turn>,
}

/// What films have turned by when a motion comes into force, and how fast they turn from then on, radians per second.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turn {
    before: DQuat,
    speed: DVec3,
}

impl Turns {
    /// Turns under motions, for ticks of a length in seconds.
    pub fn new(motions: &Timeline<Motion>, tick_s: f64) -> Self {
        let mut last = (0, Turn { before: DQuat::IDENTITY, speed: DVec3::ZERO });
        let turns = motions.iter().map(|(tick, motion)| {
            let speed = DVec3::from(motion.spin_deg_s) * (std::f64::consts::PI / 180.0);
            last = (tick, Turn { before: last.1.at(last.0, tick as f64, tick_s), speed });
            last
        });
        Self { motions: turns.collect(), tick_s }
    }

    /// Length of a tick, s.
    pub fn tick_s(&self) -> f64 {
        self.tick_s
    }

    /// What films have turned by until a time in ticks.
    pub fn at(&self, ticks: f64) -> DQuat {
        self.motions.in_force(ticks).map_or(DQuat::IDENTITY, |(from, turn)| turn.at(from, ticks, self.tick_s))
    }
}

impl Turn {
    /// What films have turned by until a time in ticks, where they turn so from a tick on.
    fn at(&self, from: u64, ticks: f64, tick_s: f64) -> DQuat {
        DQuat::from_scaled_axis(self.speed * ((ticks - from as f64) * tick_s)) * self.before
    }
}
