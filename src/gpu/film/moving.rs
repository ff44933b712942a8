//! A film and what drives it: the steps of a history, each taken by the law in force.

use std::ops::Range;

use super::{Field, FreeMotion, Rules, checkpoint::Checkpoint, rest::RestWatch};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        flow::FlowSolver,
        passes::{decide_remap::RemapRule, sample_tracer::Gathered, trace_step::Step},
        timing::Recorder,
    },
    physics::film::{PrescribedFlow, Seed},
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
    pub fn begin(&mut self, gpu: &Gpu, seed: &Seed) {
        self.motion = None;
        self.watch = RestWatch::default();
        self.field.begin(gpu, seed);
    }

    /// Since when the film rests, if it does.
    #[must_use]
    pub fn rest(&self) -> Option<RestingFilm> {
        self.watch.rest()
    }

    /// What the film comes to rest under, if its speed is asked for at the end of a step that it has taken.
    pub(super) fn asks(&mut self, key: &FieldKey, step: &Range<u64>) -> Option<RestingFilm> {
        let undisturbed = key.undisturbed(step);
        if undisturbed.is_none() {
            self.watch = RestWatch::default();
        }
        let law = undisturbed.filter(|_| key.asks_for_speed(step))?;
        Some(RestingFilm { since_tick: step.end, law })
    }

    /// Whether the film rests through a step; if the step moves it again, it is watched again.
    pub(super) fn stays_at_rest(&mut self, key: &FieldKey, step: &Range<u64>) -> bool {
        let Some(rest) = self.watch.rest() else { return false };
        let stays = key.undisturbed(step) == Some(rest.law);
        if !stays {
            self.watch = RestWatch::default();
        }
        stays
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
pub(super) struct LawInForce(Option<(FlowLaw, PrescribedFlow)>);

impl LawInForce {
    /// A step of a number of ticks.
    pub(super) fn step(&mut self, key: &FieldKey, tick: u64, ticks: f64) -> Step {
        let [from_s, to_s] = [tick as f64, tick as f64 + ticks].map(|tick| key.tick_s * tick);
        Step::prescribed(self.flow(key, tick), from_s, to_s)
    }

    /// The flow at a tick.
    pub(super) fn flow(&mut self, key: &FieldKey, tick: u64) -> &PrescribedFlow {
        let law = key.law(tick);
        if self.0.as_ref().is_some_and(|(known, _)| *known != law) {
            self.0 = None;
        }
        &self.0.get_or_insert_with(|| (law, law.prescribed())).1
    }
}
