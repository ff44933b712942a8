//! The steps of a film's history, and what histories have in common.

use std::ops::Range;

use super::{FieldKey, FlowLaw, Moment};

impl FieldKey {
    /// The last tick until the moment at which a step ends: where the film's state stands. What the moment is beyond it, the shown
    /// thickness alone is ahead of the state, so that steps are the same however a history is cut into frames.
    #[must_use]
    pub fn state_tick(&self) -> u64 {
        self.step_at(self.moment.tick).start
    }

    /// The last moment until this one at which the film is seen to have moved: while it rests, or has moved by less than a thousandth of a
    /// cell since its state, time changes nothing.
    #[must_use]
    pub fn last_moved(&self) -> Moment {
        let state = self.state_tick();
        let ahead_s = ((self.moment.tick - state) as f64 + self.moment.fraction) * self.tick_s;
        if ahead_s < self.law(state).still_s(self.cell_angle()) { Moment::tick(state) } else { self.moment }
    }

    /// Ticks of the whole steps from the end of one until the moment, in order.
    pub fn steps_from(&self, tick: u64) -> impl Iterator<Item = Range<u64>> {
        let mut next = tick;
        std::iter::from_fn(move || {
            let step = self.step_at(next);
            next = step.end;
            (step.end <= self.moment.tick).then_some(step)
        })
    }

    /// The step that a tick lies in. Steps begin with each law and are cut where the next one comes into force; a law of rest is one step.
    fn step_at(&self, tick: u64) -> Range<u64> {
        let end = self.flows.next_change(tick).unwrap_or(u64::MAX);
        let Some((from, law)) = self.flows.in_force(tick as f64) else { return 0..end };
        if *law == FlowLaw::Rest {
            return from..end;
        }
        let length = law.ticks_per_step(self.tick_s, self.cell_angle());
        let start = tick - (tick - from) % length;
        start..start.saturating_add(length).min(end)
    }

    /// Whether this film's past, up to the other's moment, is the other's: then it can go on from there.
    #[must_use]
    pub fn continues(&self, past: &Self) -> bool {
        past.moment.tick <= self.moment.tick
            && !self.law_differs_until(past)
            && self.step_at(past.moment.tick).start == past.moment.tick
    }

    /// Whether one film's past is the other's, as far as the earlier of their moments.
    #[must_use]
    pub fn shares_past(&self, other: &Self) -> bool {
        let [earlier, later] = if self.moment.tick <= other.moment.tick { [self, other] } else { [other, self] };
        !later.law_differs_until(earlier)
    }

    /// Whether both began alike and are moved in the same way: then they differ only in their moments and in the laws and pushes that drove them.
    #[must_use]
    pub fn is_same_film(&self, other: &Self) -> bool {
        (self.cells, self.flow_cells) == (other.cells, other.flow_cells)
            && (self.initial, &self.boundary) == (other.initial, &other.boundary)
            && (self.tick_s, self.scheme, self.remap_ticks) == (other.tick_s, other.scheme, other.remap_ticks)
    }

    /// Whether anything that shaped the other film up to its moment is different in this one.
    #[must_use]
    pub fn law_differs_until(&self, other: &Self) -> bool {
        let end = other.moment.end_tick();
        let end_s = end as f64 * self.tick_s;
        !self.is_same_film(other)
            || self.flows.until(end) != other.flows.until(end)
            || self.evaporation.until(end) != other.evaporation.until(end)
            || self.pushes.until(end) != other.pushes.until(end)
            || self.path.until(end_s) != other.path.until(end_s)
    }
}
