//! A film and what drives it: the steps of a history, each taken by the law in force.

use std::ops::Range;

use super::{Field, FreeMotion, Rules, Surroundings, checkpoint::Checkpoint, rest::RestWatch};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        flow::FlowSolver,
        passes::{
            blacken::BlackeningLaw, decide_remap::RemapRule, drain::DrainLaw, sample_tracer::Gathered, trace_step::Step,
        },
        timing::Recorder,
    },
    physics::{
        film::{
            InitialFilm, Patch, PrescribedFlow,
            properties::{BLACK_FILM_COLLAPSE, BLACK_FILM_ONSET},
        },
        flow::{CORRECTED_TURN, FlowForces},
    },
    plan::{BLACK_FILM_NM, FieldKey, FlowLaw, FreeFlow, RestingFilm},
};

/// Steps of a flow in one step of its film at most: enough for 250 times the gravity of the Earth, or a stir of 10 m/s and 8°, on a bubble
/// of 5 cm.
const MOST_PARTS_A_STEP: f64 = 16.0;

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

    /// Moves the film through some ticks of its history; what is recorded goes out in submissions of so many steps at most.
    pub fn play(
        &mut self,
        gpu: &Gpu,
        key: &FieldKey,
        from_tick: u64,
        steps_a_submission: usize,
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
            for step in steps.by_ref().take(steps_a_submission) {
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

    /// Whether the film rests through a step; if that moves it again, it is watched anew.
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
        let length = u32::try_from(ticks.end - ticks.start).unwrap_or(u32::MAX);
        let (now, end) = (key.law(ticks.start), ticks.end as f64);
        self.field.diffuse(recorder.gpu, now.diffusion(), key.tick_s);
        let FlowLaw::Free(free) = now else {
            self.field.collapse(recorder.gpu, None);
            self.field.drain(None);
            return self.field.advance(recorder, &law.step(key, ticks.start, length.into()), length);
        };
        self.field.collapse(recorder.gpu, key.has_black_film(end).then(|| blackening(key, end)));
        self.field.drain(draining(key, &free, end));
        self.advance_freely(recorder, key, &free, law, (ticks.start, length))
    }

    fn advance_freely(
        &mut self,
        recorder: &mut Recorder<'_>,
        key: &FieldKey,
        free: &FreeFlow,
        law: &mut LawInForce,
        (tick, ticks): (u64, u32),
    ) -> Result<(), GpuError> {
        let Self { field, motion, .. } = self;
        let motion = match motion {
            Some(motion) => motion,
            None => motion.insert(FreeMotion::new(recorder, field)?),
        };
        // Where even a tick is longer than the flow's steps may be, it is several; the film counts its ticks once.
        let end = tick as f64 + f64::from(ticks);
        let felt = free.accelerated(key.acceleration_during(tick as f64, end));
        let strain = key.strain_until(end);
        let longest_s = felt.longest_step_s().min(CORRECTED_TURN / strain);
        let parts = (f64::from(ticks) * key.tick_s / longest_s).ceil().clamp(1.0, MOST_PARTS_A_STEP);
        let dt_ticks = f64::from(ticks) / parts;
        // Beyond so many steps gravity is felt as far as they can follow it: such films are sorted within a tick anyway.
        let followed = (felt.longest_step_s() / (dt_ticks * key.tick_s)).min(1.0).powi(2);
        for part in 0..parts as u32 {
            let now = tick as f64 + f64::from(part) * dt_ticks;
            let forces = free.accelerated(key.acceleration_during(now, now + dt_ticks)).forces;
            let around = Surroundings {
                forces: FlowForces { gravity: followed * forces.gravity, ..forces },
                air: law.flow(key, tick),
                pushes: &key.pushes_during(now, now + dt_ticks),
                mean_nm: field.mean(),
                thinned_nm: key.thinned_nm(now + 0.5 * dt_ticks),
                black_nm: BLACK_FILM_NM,
                strain,
            };
            let counted = if part == 0 { ticks } else { 0 };
            motion.advance(recorder, field, &around, (now * key.tick_s, dt_ticks * key.tick_s), counted)?;
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

    /// Makes the state of a slot the film's again; nothing for an empty slot.
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

/// The longest time between two remaps of a film that regenerates: patches are seen when they have risen by a part of their size.
const REGENERATION_S: f64 = 0.1;
/// Angle from the lowest point of a film within which what drains is in the drop, where nothing else says how large that is: 5°.
const DROP_RAD: f64 = 0.0873;

/// How film leaves at its rim until a time in ticks, if it does, and how often it must.
fn draining(key: &FieldKey, free: &FreeFlow, ticks: f64) -> Option<(DrainLaw, u32)> {
    if key.regeneration().is_none() && free.drainage == 0.0 {
        return None;
    }
    let most = key.regeneration().map_or(f64::from(key.remap_ticks), |_| REGENERATION_S / key.tick_s).max(1.0);
    // A remap that is due comes with a step's end.
    let window = most + free.ticks_a_step(key.tick_s) as f64;
    let patches = key.patches_during(ticks - window, ticks);
    let aged = |patch: Patch| (patch.middle, patch.thickness, (ticks - patch.time_s / key.tick_s).max(0.0) as u32);
    let law = DrainLaw {
        gravity: free.forces.gravity,
        flux: free.drainage * key.tick_s,
        thinned_nm: key.thinned_nm(ticks),
        black_nm: BLACK_FILM_NM,
        drop_rad: if key.cap().is_some() { 0.0 } else { key.drop_rad().unwrap_or(DROP_RAD) },
        patch_radius: key.regeneration().map_or(1.0, |regeneration| regeneration.radius),
        patches: patches.into_iter().map(aged).collect(),
    };
    Some((law, most as u32))
}

/// How the film collapses at a time in ticks.
fn blackening(key: &FieldKey, ticks: f64) -> BlackeningLaw {
    BlackeningLaw {
        thinned_nm: key.thinned_nm(ticks),
        black_nm: BLACK_FILM_NM,
        onset_nm: 1e9 * BLACK_FILM_ONSET,
        rate: BLACK_FILM_COLLAPSE * key.tick_s,
    }
}

/// The law that drives a film, made into a flow once for as long as it holds.
#[derive(Default)]
struct LawInForce(Option<(FlowLaw, PrescribedFlow)>);

impl LawInForce {
    /// A step of so many ticks.
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
