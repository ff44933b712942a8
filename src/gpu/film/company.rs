//! Films that flow together: for as long as they take the same steps, a solver holds the flows of all of them, so that a step takes as many
//! dispatches of the flow for many films as for one. What each is given is what it would get alone, to the last bit.

use std::ops::Range;

use super::{
    MovingFilm, Rules, Surroundings,
    free::{Flowing, FreeMotion, advance_together, is_corrected, solver_of},
    moving::LawInForce,
};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        flow::FlowSolver,
        timing::Recorder,
    },
    physics::film::model::{FilmStep, FreePart},
    plan::{FieldKey, FlowLaw},
};

/// A film that moves, and its key.
pub type Member<'a> = (&'a mut MovingFilm, &'a FieldKey);

/// Solvers for films that flow together. Between submissions each film has its own flow.
#[derive(Default)]
pub struct Company {
    /// Solvers that hold films, each with the places of its films in the list of members.
    busy: Vec<(Vec<usize>, FlowSolver)>,
    /// Solvers that hold none, with what they were made for.
    spare: Vec<(Shape, FlowSolver)>,
}

/// What a solver is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shape {
    cells: u32,
    rules: Rules,
    films: usize,
}

impl Shape {
    fn of(film: &MovingFilm, films: usize) -> Self {
        Self { cells: film.field.flow_grid().cells, rules: film.field.rules(), films }
    }
}

/// What films that flow together have in common.
#[derive(PartialEq)]
struct Kind {
    cells: u32,
    rules: Rules,
    has_history: bool,
    /// For each part of the step how long it lasts, whether it is tried first, and whether there is viscosity.
    parts: Vec<(f64, bool, bool)>,
}

impl Kind {
    fn of(film: &MovingFilm, step: &FilmStep, has_history: bool) -> Self {
        let part = |part: &FreePart| {
            let is_viscous = part.forces.viscous_stage(part.dt_s).is_some();
            (part.dt_s, is_corrected(part), is_viscous)
        };
        Self {
            cells: film.field.flow_grid().cells,
            rules: film.field.rules(),
            has_history,
            parts: step.parts.iter().map(part).collect(),
        }
    }
}

impl Company {
    /// Forgets the films that a failure may have left here.
    pub(super) fn forget(&mut self) {
        self.busy.clear();
    }

    /// Moves some of the members, given by their places, by one of their history's steps, each by the law in force alone.
    pub(super) fn advance(
        &mut self,
        recorder: &mut Recorder<'_>,
        members: &mut [Member<'_>],
        laws: &mut [LawInForce],
        (moving, ticks): (&[usize], &Range<u64>),
    ) -> Result<(), GpuError> {
        let mut groups: Vec<(Kind, Vec<(usize, FilmStep)>)> = Vec::new();
        for &place in moving {
            let (film, key) = &mut members[place];
            let step = key.film_step(ticks);
            film.prepare(recorder.gpu, &step, key.tick_s);
            if !matches!(step.law, FlowLaw::Free(_)) {
                film.field.advance(recorder, &laws[place].step(key, ticks.start, step.ticks.into()), step.ticks)?;
                continue;
            }
            film.set_in_motion(recorder)?;
            let holder = self.busy.iter().find(|(busy, _)| busy.contains(&place)).map(|(_, solver)| solver);
            let has_history = holder.or(film.flow()).is_some_and(FlowSolver::has_history);
            let kind = Kind::of(film, &step, has_history);
            let room = |(known, films): &&mut (Kind, Vec<_>)| *known == kind && films.len() < FlowSolver::MAX_FILMS;
            match groups.iter_mut().find(room) {
                Some((_, films)) => films.push((place, step)),
                None => groups.push((kind, vec![(place, step)])),
            }
        }
        for (_, films) in groups {
            self.flow(recorder, members, laws, (&films, ticks))?;
        }
        Ok(())
    }

    /// Moves films of one kind by all parts of a step.
    fn flow(
        &mut self,
        recorder: &mut Recorder<'_>,
        members: &mut [Member<'_>],
        laws: &mut [LawInForce],
        (films, ticks): (&[(usize, FilmStep)], &Range<u64>),
    ) -> Result<(), GpuError> {
        let places: Vec<usize> = films.iter().map(|(place, _)| *place).collect();
        let mut solver = self.gather(recorder, members, &places);
        let parts = films.iter().map(|(_, step)| step.parts.len()).min().unwrap_or_default();
        for part in 0..parts {
            let mut flowing = Vec::with_capacity(films.len());
            let of_members = members.iter_mut().zip(&mut *laws).enumerate();
            // That of the only film, if there is but one.
            let mut own = None;
            for (place, ((film, key), law)) in of_members {
                let Some((_, step)) = films.iter().find(|(member, _)| *member == place) else { continue };
                let mean_nm = film.field.mean();
                let around = Surroundings { part: &step.parts[part], air: law.flow(key, ticks.start), mean_nm };
                let MovingFilm { field, motion, .. } = &mut **film;
                own = motion.as_mut().map(|motion| &mut motion.solver);
                // A film counts its ticks once.
                flowing.push(Flowing { field, around, ticks: if part == 0 { step.ticks } else { 0 } });
            }
            if let Some(solver) = solver.as_mut().or(own) {
                advance_together(recorder, solver, &mut flowing)?;
            }
        }
        self.busy.extend(solver.map(|solver| (places, solver)));
        Ok(())
    }

    /// The solver that holds some films; none for a film that is alone, and has its own.
    fn gather(
        &mut self,
        recorder: &mut Recorder<'_>,
        members: &mut [Member<'_>],
        places: &[usize],
    ) -> Option<FlowSolver> {
        if let Some(known) = self.busy.iter().position(|(busy, _)| busy == places) {
            return Some(self.busy.swap_remove(known).1);
        }
        while let Some(other) = self.busy.iter().position(|(busy, _)| busy.iter().any(|place| places.contains(place))) {
            self.disperse(recorder, members, other);
        }
        let [first, _, ..] = places else { return None };
        let film = &members[*first].0;
        let shape = Shape::of(film, places.len());
        let mut solver = match self.spare.iter().position(|(known, _)| *known == shape) {
            Some(known) => self.spare.swap_remove(known).1,
            None => solver_of(recorder.gpu, &film.field, shape.films),
        };
        for (place, member) in places.iter().enumerate() {
            if let Some(motion) = &members[*member].0.motion {
                solver.cycles = motion.solver.cycles;
                solver.take_in(recorder, place, &motion.solver);
            }
        }
        Some(solver)
    }

    /// Gives the films of a solver their flows back.
    fn disperse(&mut self, recorder: &mut Recorder<'_>, members: &mut [Member<'_>], busy: usize) {
        let (places, solver) = self.busy.swap_remove(busy);
        for (place, member) in places.iter().enumerate() {
            if let Some(motion) = &mut members[*member].0.motion {
                solver.hand_back(recorder, place, &mut motion.solver);
            }
        }
        self.spare.extend(places.first().map(|first| (Shape::of(members[*first].0, places.len()), solver)));
    }

    /// Gives all films their flows back.
    pub(super) fn part(&mut self, recorder: &mut Recorder<'_>, members: &mut [Member<'_>]) {
        // Solvers that were not needed this time are not kept for the next.
        self.spare.clear();
        while !self.busy.is_empty() {
            self.disperse(recorder, members, 0);
        }
    }
}

impl MovingFilm {
    /// Sets what a step brings besides motion.
    fn prepare(&mut self, gpu: &Gpu, step: &FilmStep, tick_s: f64) {
        self.field.diffuse(gpu, step.law.diffusion(), tick_s);
        self.field.collapse(gpu, step.blackening.clone());
        self.field.drain(step.drain.clone());
    }

    /// Lets the film move by itself from now on, if it does not yet.
    fn set_in_motion(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        if self.motion.is_none() {
            self.motion = Some(FreeMotion::new(recorder, &self.field)?);
        }
        Ok(())
    }
}
