//! Films that come to rest, and what keeps them there.

use std::ops::Range;

use super::{FieldKey, FlowLaw, FreeFlow};
use crate::physics::film::{ASKING_S, STEADY, resting_speed};

/// A film that moved by itself and has come to rest: it stays at rest until anything but this law acts on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestingFilm {
    /// The tick since which it rests.
    pub since_tick: u64,
    /// The law under which it came to rest.
    pub law: FreeFlow,
}

impl FieldKey {
    /// The law of a step in which nothing but gravity acts on the film, so that it may come to rest and stays there. It may thin, for that
    /// moves nothing, but not turn black, drain or regenerate. What spreads thickness stands for motions smaller than cells, and ends with
    /// the flow.
    #[must_use]
    pub fn undisturbed(&self, step: &Range<u64>) -> Option<FreeFlow> {
        let FlowLaw::Free(free) = self.law(step.start) else { return None };
        let (from, to) = (step.start as f64, step.end as f64);
        let is_left_alone = free.draught == 0.0
            && free.drainage == 0.0
            && self.regeneration().is_none()
            && !self.has_black_film(to)
            && self.pushes_during(from, to).is_empty()
            && self.acceleration_during(from, to).length() < STEADY;
        is_left_alone.then_some(free)
    }

    /// Whether the film's speed is asked for at the end of a step.
    #[must_use]
    pub fn asks_for_speed(&self, step: &Range<u64>) -> bool {
        let ticks = (ASKING_S / self.tick_s).max(1.0) as u64;
        step.start / ticks < step.end / ticks
    }

    /// Speed in rad/s below which the film rests.
    #[must_use]
    pub fn resting_speed(&self) -> f64 {
        resting_speed(self.cell_angle())
    }
}
