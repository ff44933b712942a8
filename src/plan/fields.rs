//! Plans the fields of films: where one starts from, its steps, and what is shown.

use std::{
    collections::{BTreeMap, VecDeque},
    ops::Range,
};

use super::{DrawKey, FieldKey, FieldState, FilmKey, Moment, Pace, Pass, Planner, Reason};

/// What is left of a frame's cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepBudget {
    cells: u64,
    /// Whether no step was planned yet.
    is_whole: bool,
}

impl StepBudget {
    /// That of a whole frame; none for a file, for which all is done at once.
    pub fn of(pace: Pace) -> Option<Self> {
        match pace {
            Pace::Whole => None,
            Pace::Frame { cells } => Some(Self { cells, is_whole: true }),
        }
    }

    /// Steps that a film of some cells may take. The first one may always take one: each frame gets on.
    fn max_steps(self, cells: u64) -> usize {
        (self.cells / cells).max(self.is_whole.into()) as usize
    }

    fn spend(&mut self, cells: u64) {
        *self = Self { cells: self.cells.saturating_sub(cells), is_whole: false };
    }
}

impl Planner {
    /// The tick that a film has reached. The film that is furthest behind goes first, so that none waits for ever.
    pub(super) fn reached_tick(&self, film: usize) -> u64 {
        self.after.fields.get(film).and_then(Option::as_ref).map_or(0, |field| field.key.moment.tick)
    }

    /// Plans the fields of all films in sight, each once, and puts what will be shown in their place. Films that take the same steps take them
    /// one after the other, so that they can be taken together.
    pub(super) fn fields(&mut self, draw: &mut DrawKey) {
        let mut shown: BTreeMap<usize, FieldKey> = BTreeMap::new();
        for (index, film) in draw.films_mut() {
            if let FilmKey::Field(field) = film {
                shown.entry(index).or_insert_with(|| field.clone());
            }
        }
        let mut order: Vec<usize> = shown.keys().copied().collect();
        order.sort_by_key(|film| self.reached_tick(*film));
        let before = std::mem::take(&mut self.steps);
        let mut of_films = Vec::with_capacity(order.len());
        for film in order {
            shown.entry(film).and_modify(|field| *field = self.field(film, field));
            of_films.push(VecDeque::from(std::mem::take(&mut self.steps)));
        }
        self.steps = before;
        self.steps.extend(in_rounds(of_films));
        for (index, film) in draw.films_mut() {
            if let FilmKey::Field(field) = film {
                field.clone_from(&shown[&index]);
            }
        }
    }

    /// Plans a film's field and returns the key of what will be shown.
    pub(super) fn field(&mut self, film: usize, requested: &FieldKey) -> FieldKey {
        if self.after.fields.len() <= film {
            self.after.fields.resize(film + 1, None);
        }
        let before = self.after.fields[film].take();
        let mut field = self.start(film, requested, before.clone());
        let end = self.step(film, requested, &mut field);
        let moment = match field.rest {
            Some(rest) => Moment::tick(rest.since_tick),
            None if end == requested.state_tick() => requested.moment,
            None => Moment::tick(end),
        };
        let shown = requested.at(moment);
        if field.shown != Some(moment) || before.is_none_or(|before| before.key.law_differs_until(&shown)) {
            let reason = if field.shown.is_none() { Reason::Missing } else { Reason::Changed("the moment") };
            self.push(Pass::ShowField { film, key: shown.clone() }, reason);
            field.shown = Some(moment);
        }
        field.key = requested.at(Moment::tick(end));
        self.after.fields[film] = Some(field);
        shown
    }

    /// Plans where a film goes on from: its state, a checkpoint if one is nearer, or its beginning.
    fn start(&mut self, film: usize, requested: &FieldKey, before: Option<FieldState>) -> FieldState {
        let reason = if before.is_none() { Reason::Missing } else { Reason::Changed("the film's history") };
        let same_film = before.as_ref().filter(|before| requested.is_same_film(&before.key));
        let checkpoints = same_film.map(|before| before.checkpoints.clone().sharing(requested)).unwrap_or_default();
        let here = before.filter(|before| requested.continues(&before.key));
        let nearer = |key: &FieldKey| here.as_ref().is_none_or(|here| here.key.moment.tick < key.moment.tick);
        if let Some((slot, key)) = checkpoints.latest(requested).filter(|(_, key)| nearer(key)) {
            let key = key.clone();
            self.push(Pass::RestoreField { film, slot, key: key.clone() }, Reason::Changed("the moment"));
            return FieldState { key, shown: None, rest: None, checkpoints };
        }
        if let Some(here) = here {
            return FieldState { checkpoints, ..here };
        }
        let start = requested.at(Moment::default());
        self.push(Pass::SeedField { film, key: start.clone() }, reason);
        FieldState { key: start, shown: None, rest: None, checkpoints }
    }

    /// Plans a film's steps, with checkpoints on the way for a window, and returns the tick at which they end.
    fn step(&mut self, film: usize, requested: &FieldKey, field: &mut FieldState) -> u64 {
        let first = field.key.moment.tick;
        let cells = requested.cell_count();
        let max_steps = self.budget.map_or(usize::MAX, |budget| budget.max_steps(cells));
        let mut steps = requested.steps_from(first).peekable();
        let mut start = first;
        if let Some(rest) = field.rest {
            while let Some(step) = steps.next_if(|step| requested.undisturbed(step) == Some(rest.law)) {
                start = step.end;
            }
            field.rest = field.rest.filter(|_| steps.peek().is_none());
        }
        let mut end = start;
        for step in steps.take(max_steps) {
            end = step.end;
            self.budget.iter_mut().for_each(|budget| budget.spend(cells));
            // Only in windows people go back in time.
            if self.pace == Pace::Whole {
                continue;
            }
            let key = requested.at(Moment::tick(end));
            if let Some(slot) = field.checkpoints.keep(&key, &step) {
                self.move_through(film, &key, start..end);
                self.push(Pass::SaveField { film, slot, key }, Reason::Missing);
                start = end;
            }
        }
        self.move_through(film, &requested.at(Moment::tick(end)), start..end);
        self.complete &= end == requested.state_tick();
        end
    }

    fn move_through(&mut self, film: usize, end: &FieldKey, ticks: Range<u64>) {
        if !ticks.is_empty() {
            self.push(Pass::StepField { film, key: end.clone(), ticks }, Reason::Changed("the moment"));
        }
    }
}

/// The passes of films, which do not depend on each other, in an order in which equal steps of different films stand side by side.
fn in_rounds(mut films: Vec<VecDeque<(Pass, Reason)>>) -> Vec<(Pass, Reason)> {
    let is_step = |(pass, _): &(Pass, Reason)| matches!(pass, Pass::StepField { .. });
    let mut ordered = Vec::with_capacity(films.iter().map(VecDeque::len).sum());
    loop {
        // What leads to a film's next steps comes first.
        for film in &mut films {
            while let Some(pass) = film.pop_front_if(|pass| !is_step(pass)) {
                ordered.push(pass);
            }
        }
        films.retain(|film| !film.is_empty());
        let Some(round) = films.first_mut().and_then(VecDeque::pop_front) else { return ordered };
        let alike = films.iter_mut().filter_map(|film| film.pop_front_if(|(pass, _)| pass.steps_like(&round.0)));
        let alike: Vec<_> = alike.collect();
        ordered.push(round);
        ordered.extend(alike);
    }
}
