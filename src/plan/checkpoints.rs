//! Which states of a film are kept on the device, so that going back in time does not move the film anew from its beginning.
//!
//! Checkpoints lie about a second of 60 ticks apart where the film is, and ever wider apart the further away: going back by some ticks then
//! costs about as many steps as going forward by as many, however long the history, and a few slots are enough for hours.

use std::ops::Range;

use super::FieldKey;

/// Minimum ticks between two checkpoints.
const SPACING_TICKS: u64 = 60;
/// Checkpoints of a film at most.
const MAX_CHECKPOINTS: u64 = 8;
/// Cells in all checkpoints of a film: eight of 256 cells per edge. Finer films have fewer, but at least two.
const CELLS_KEPT: u64 = MAX_CHECKPOINTS * 6 * 256 * 256;

/// Checkpoints of one film by their slots on the device: the film's key at the tick of each. Those of another past may be among them;
/// they are the first to be overwritten.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoints(Vec<FieldKey>);

impl Checkpoints {
    /// The latest one that a film can go on from, and its slot.
    #[must_use]
    pub fn latest(&self, requested: &FieldKey) -> Option<(usize, &FieldKey)> {
        let usable = self.0.iter().enumerate().filter(|(_, kept)| requested.continues(kept));
        usable.max_by_key(|(_, kept)| kept.moment.tick)
    }

    /// These checkpoints, where each one that a film can go on from shares the film's histories: then they are compared at once.
    pub(super) fn sharing(mut self, requested: &FieldKey) -> Self {
        self.0.iter_mut().filter(|kept| requested.continues(kept)).for_each(|kept| *kept = requested.at(kept.moment));
        self
    }

    /// Enters the film's state at the end of a step, and returns the slot that it goes to; `None` if it need not be kept.
    pub(super) fn keep(&mut self, state: &FieldKey, step: &Range<u64>) -> Option<usize> {
        let is_due = step.start / SPACING_TICKS < step.end / SPACING_TICKS;
        if !is_due || self.0.iter().any(|kept| kept.moment == state.moment && kept.shares_past(state)) {
            return None;
        }
        if (self.0.len() as u64) < (CELLS_KEPT / state.cell_count()).clamp(2, MAX_CHECKPOINTS) {
            self.0.push(state.clone());
            return Some(self.0.len() - 1);
        }
        let slot = self.most_dispensable(state)?;
        self.0[slot] = state.clone();
        Some(slot)
    }

    /// The slot of another past if there is one, else the one whose neighbours are the nearest to one another, measured by their distance
    /// from where the film is.
    fn most_dispensable(&self, state: &FieldKey) -> Option<usize> {
        let now = state.moment.tick;
        let mut ticks: Vec<u64> = self.0.iter().map(|kept| kept.moment.tick).chain([0, now]).collect();
        ticks.sort_unstable();
        let worth = |kept: &FieldKey| {
            if !kept.shares_past(state) {
                return 0.0;
            }
            let tick = kept.moment.tick;
            let before = ticks[ticks.partition_point(|other| *other < tick).saturating_sub(1)];
            let after = ticks.get(ticks.partition_point(|other| *other <= tick)).copied().unwrap_or(tick);
            (after - before) as f64 / now.abs_diff(tick).max(1) as f64
        };
        let worths = self.0.iter().map(worth).enumerate();
        worths.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(slot, _)| slot)
    }
}
