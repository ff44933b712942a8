//! A film and what drives it: the steps of a history, each taken by the law in force.

use std::ops::Range;

use super::{Field, FreeMotion, Rules, Surroundings, checkpoint::Checkpoint, rest::RestWatch};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        flow::FlowSolver,
        passes::{decide_remap::RemapRule, sample_tracer::Gathered, trace_step::Step},
        timing::Recorder,
    },
    physics::film::{InitialFilm, PrescribedFlow},
    plan::{FieldKey, FlowLaw, RestingFilm},
};

/// A film that moves.
pub struct MovingFilm {
    /// Its thickness.
    pub field: Field,
    /// What moves it, once it has moved by itself.
    pub(super) motion: Option<FreeMotion>,
    /// Whether it still moves by itself.
    pub(super) watch: RestWatch,
    /// States to go back to, by slot.
    pub(super) checkpoints: Vec<Checkpoint>,
}

impl MovingFilm {
    /// A film that has not moved yet.
    #[must_use]
    pub fn new(field: Field) -> Self {
        Self { field, motion: None, watch: RestWatch::default(), checkpoints: Vec::new() }
    }

    /// Sets the film to its beginning. Checkpoints stay.
    pub fn seed(&mut self, gpu: &Gpu, initial: &InitialFilm) {
        self.motion = None;
        self.watch = RestWatch::default();
        self.field.seed(gpu, initial.profile());
    }

    /// Since when the film rests, if it does.
    #[must_use]
    pub fn rest(&self) -> Option<RestingFilm> {
        self.watch.rest()
    }

    /// Moves the film through some ticks of its history; what is recorded goes out in submissions of at most `steps_per_submission` steps.
    pub fn play(
        &mut self,
        gpu: &Gpu,
        key: &FieldKey,
        from_tick: u64,
        steps_per_submission: usize,
        mut submit: impl FnMut(Recorder<'_>) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let mut law = LawInForce::default();
        let moving = |step: &Range<u64>| key.law(step.start) != FlowLaw::Rest;
        let mut steps = key.steps_from(from_tick).filter(moving).peekable();
        loop {
            while steps.next_if(|step| self.stays_at_rest(key, step)).is_some() {}
            if steps.peek().is_none() {
                return Ok(());
            }
            let mut recorder = Recorder::new(gpu);
            let mut asking = None;
            for step in steps.by_ref().take(steps_per_submission) {
                self.advance(&mut recorder, key, &mut law, step.clone())?;
                let undisturbed = key.undisturbed(&step);
                if undisturbed.is_none() {
                    self.watch = RestWatch::default();
                }
                asking = undisturbed.filter(|_| key.asks_for_speed(&step)).map(|law| (step.end, law));
                if asking.is_some() {
                    break;
                }
            }
            submit(recorder)?;
            if let (Some((tick, law)), Some(motion)) = (asking, &self.motion) {
                let rest = RestingFilm { since_tick: tick, law };
                self.watch.watch(gpu, motion.flow(), rest, key.resting_speed())?;
            }
        }
    }

    /// Whether the film rests through a step; if the step moves it again, it is watched again.
    fn stays_at_rest(&mut self, key: &FieldKey, step: &Range<u64>) -> bool {
        let Some(rest) = self.watch.rest() else { return false };
        let stays = key.undisturbed(step) == Some(rest.law);
        if !stays {
            self.watch = RestWatch::default();
        }
        stays
    }

    /// Moves the film by one of the history's steps, by the law in force alone.
    fn advance(
        &mut self,
        recorder: &mut Recorder<'_>,
        key: &FieldKey,
        law: &mut LawInForce,
        ticks: Range<u64>,
    ) -> Result<(), GpuError> {
        let step = key.film_step(&ticks);
        self.field.diffuse(recorder.gpu, step.law.diffusion(), key.tick_s);
        self.field.collapse(recorder.gpu, step.blackening);
        self.field.drain(step.drain);
        if !matches!(step.law, FlowLaw::Free(_)) {
            return self.field.advance(recorder, &law.step(key, ticks.start, step.ticks.into()), step.ticks);
        }
        let Self { field, motion, .. } = self;
        let motion = match motion {
            Some(motion) => motion,
            None => motion.insert(FreeMotion::new(recorder, field)?),
        };
        let air = law.flow(key, ticks.start);
        for (k, part) in step.parts.iter().enumerate() {
            let around = Surroundings { part, air, mean_nm: field.mean() };
            // The film counts its ticks once.
            motion.advance(recorder, field, &around, if k == 0 { step.ticks } else { 0 })?;
        }
        Ok(())
    }

    /// Keeps the state in a slot, the next new one at most.
    pub fn save(&mut self, recorder: &mut Recorder<'_>, slot: usize) -> Result<(), GpuError> {
        let checkpoint = Checkpoint {
            field: self.field.save(recorder),
            motion: self.motion.as_ref().map(|motion| motion.solver.save(recorder)),
            watch: self.watch.kept(recorder.gpu)?,
        };
        match self.checkpoints.get_mut(slot) {
            Some(old) => *old = checkpoint,
            None => self.checkpoints.push(checkpoint),
        }
        Ok(())
    }

    /// Restores the film's state from a slot; does nothing for an empty slot.
    pub fn restore(&mut self, recorder: &mut Recorder<'_>, slot: usize) {
        let Self { field, motion, watch, checkpoints } = self;
        let Some(checkpoint) = checkpoints.get(slot) else { return };
        *watch = checkpoint.watch.into();
        field.restore(recorder, &checkpoint.field);
        // A film that had not moved by itself then starts to with no motion.
        let Some(flow) = &checkpoint.motion else {
            *motion = None;
            return;
        };
        motion.get_or_insert_with(|| FreeMotion::empty(recorder.gpu, field)).solver.restore(recorder, flow);
    }

    /// The flow that moves it by itself, once it has.
    #[must_use]
    pub fn flow(&self) -> Option<&FlowSolver> {
        self.motion.as_ref().map(FreeMotion::flow)
    }

    /// What is left to do from the film's state to the moment of a key, if anything moves.
    #[must_use]
    pub fn ahead(&self, key: &FieldKey) -> Option<Step> {
        let (state, moment) = (key.state_tick(), key.moment);
        let ticks = (moment.tick - state) as f64 + moment.fraction;
        match key.law(state) {
            _ if ticks <= 0.0 || self.rest().is_some() => None,
            FlowLaw::Rest => None,
            FlowLaw::Free(_) => self.motion.as_ref().map(|motion| motion.ahead(ticks * key.tick_s)),
            _ => Some(LawInForce::default().step(key, state, ticks)),
        }
    }
}

/// Cells along a panel's edge from which on a film has a map half as fine: flows are smooth, remaps come before it errs by more than a map
/// as fine as the film may, and composing it is most of what a step of the film costs.
const FINE_CELLS: u32 = 128;

/// How a scene's film is moved: always limited and conserved, for a film has a thickness and an amount of liquid.
pub fn rules(key: &FieldKey) -> Rules {
    Rules {
        scheme: key.scheme,
        limiter: true,
        gathered: Gathered::Nothing,
        conserved: true,
        remap: RemapRule { error_limit_cells: RemapRule::ERROR_LIMIT_CELLS, latest_ticks: key.remap_ticks },
        map_coarsening: if key.cells < FINE_CELLS { 1 } else { 2 },
        flow_cells: key.flow_cells,
        cap: key.cap(),
        drop_rad: key.drop_rad(),
    }
}

/// The law that drives a film, made into a flow once for as long as it holds.
#[derive(Default)]
struct LawInForce(Option<(FlowLaw, PrescribedFlow)>);

impl LawInForce {
    /// A step of a number of ticks.
    fn step(&mut self, key: &FieldKey, tick: u64, ticks: f64) -> Step {
        let [from_s, to_s] = [tick as f64, tick as f64 + ticks].map(|tick| key.tick_s * tick);
        Step::prescribed(self.flow(key, tick), from_s, to_s)
    }

    /// The flow at a tick.
    fn flow(&mut self, key: &FieldKey, tick: u64) -> &PrescribedFlow {
        let law = key.law(tick);
        if self.0.as_ref().is_some_and(|(known, _)| *known != law) {
            self.0 = None;
        }
        &self.0.get_or_insert_with(|| (law, law.prescribed())).1
    }
}
