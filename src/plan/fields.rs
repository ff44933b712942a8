//! Plans the fields of films: where one starts from, its steps, and what is shown.

use std::ops::Range;

use super::{FieldHave, FieldKey, Moment, Pace, Pass, Planner, Reason};

/// Cells stepped a frame while a window waits for a film to catch up.
const CELLS_A_FRAME: u64 = 800_000;

impl Planner {
    /// Plans a film's field and returns the key of what will be shown.
    pub(super) fn field(&mut self, film: usize, wanted: &FieldKey) -> FieldKey {
        if self.after.fields.len() <= film {
            self.after.fields.resize(film + 1, None);
        }
        let before = self.after.fields[film].take();
        let mut have = self.start(film, wanted, before.clone());
        let end = self.step(film, wanted, &mut have);
        let moment = match have.rest {
            Some(rest) => Moment::tick(rest.since_tick),
            None if end == wanted.state_tick() => wanted.moment,
            None => Moment::tick(end),
        };
        let shown = wanted.at(moment);
        if have.shown != Some(moment) || before.is_none_or(|before| before.state.law_differs_until(&shown)) {
            let reason = if have.shown.is_none() { Reason::Missing } else { Reason::Changed("the moment") };
            self.push(Pass::ShowField { film, key: shown.clone() }, reason);
            have.shown = Some(moment);
        }
        have.state = wanted.at(Moment::tick(end));
        self.after.fields[film] = Some(have);
        shown
    }

    /// Plans where a film goes on from: its state, a checkpoint if one is nearer, or its beginning.
    fn start(&mut self, film: usize, wanted: &FieldKey, before: Option<FieldHave>) -> FieldHave {
        let reason = if before.is_none() { Reason::Missing } else { Reason::Changed("the film's history") };
        let same_film = before.as_ref().filter(|before| wanted.is_same_film(&before.state));
        let checkpoints = same_film.map(|before| before.checkpoints.clone()).unwrap_or_default();
        let here = before.filter(|before| wanted.continues(&before.state));
        let nearer = |key: &FieldKey| here.as_ref().is_none_or(|here| here.state.moment.tick < key.moment.tick);
        if let Some((slot, key)) = checkpoints.latest(wanted).filter(|(_, key)| nearer(key)) {
            let state = key.clone();
            self.push(Pass::RestoreField { film, slot, key: state.clone() }, Reason::Changed("the moment"));
            return FieldHave { state, shown: None, rest: None, checkpoints };
        }
        here.unwrap_or_else(|| {
            let start = wanted.at(Moment::default());
            self.push(Pass::SeedField { film, key: start.clone() }, reason);
            FieldHave { state: start, shown: None, rest: None, checkpoints }
        })
    }

    /// Plans a film's steps, with checkpoints on the way for a window, and returns the tick at which they end.
    fn step(&mut self, film: usize, wanted: &FieldKey, have: &mut FieldHave) -> u64 {
        let first = have.state.moment.tick;
        let most = match self.pace {
            Pace::Frame => (CELLS_A_FRAME / wanted.cell_count()).max(1) as usize,
            Pace::Whole => usize::MAX,
        };
        let mut steps = wanted.steps_from(first).peekable();
        let mut start = first;
        if let Some(rest) = have.rest {
            while let Some(step) = steps.next_if(|step| wanted.undisturbed(step) == Some(rest.law)) {
                start = step.end;
            }
            have.rest = have.rest.filter(|_| steps.peek().is_none());
        }
        let mut end = start;
        for step in steps.take(most) {
            end = step.end;
            if self.pace == Pace::Whole {
                continue;
            }
            let state = wanted.at(Moment::tick(end));
            if let Some(slot) = have.checkpoints.keep(&state, &step) {
                self.move_through(film, &state, start..end);
                self.push(Pass::SaveField { film, slot, key: state }, Reason::Missing);
                start = end;
            }
        }
        self.move_through(film, &wanted.at(Moment::tick(end)), start..end);
        self.complete &= end == wanted.state_tick();
        end
    }

    fn move_through(&mut self, film: usize, end: &FieldKey, ticks: Range<u64>) {
        if !ticks.is_empty() {
            self.push(Pass::StepField { film, key: end.clone(), ticks }, Reason::Changed("the moment"));
        }
    }
}
