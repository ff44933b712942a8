//! The film model: a bubble's film that flows, evaporates, spreads, drains and turns black, as text, in f64 on the CPU.
//!
//! What is done in a step is a list, [`FREE_STEP`] and [`REMAP`]; each operation is a function here, in a file with the name of the shader that does the
//! same on the device. [`Film`] runs the lists on small grids, and tests compare the two step by step. See [`film`](super) for the equations.

mod blacken;
mod compose_map;
mod conserve;
mod decide_remap;
mod diffuse;
mod drain;
mod flow_thickness;
mod operations;
mod sample_tracer;
mod step;
mod trace_step;

use glam::DVec3;

pub use blacken::{BlackeningLaw, MAX_NUCLEI, collapse, remaining_nm, stop_evaporation};
pub use compose_map::compose_map;
pub use conserve::{Liquid, film_areas};
pub use decide_remap::{RemapClock, RemapRule, distortion};
pub use diffuse::{DiffusionPlan, MAX_SPREAD_PER_PART, STAGES, diffuse, stage_factors};
pub use drain::{DROP_RAD, DrainLaw, MAX_RIM_PATCHES, REGENERATION_S, drain, latest_ticks};
pub use flow_thickness::{air_rate, log_thickness, source};
pub use operations::{FREE_STEP, Operation, PRESCRIBED_STEP, REMAP, RemapOperation};
pub use sample_tracer::{felt_tracer, sample_tracer};
pub use step::{FilmStep, FreePart};
pub use trace_step::{trace_prescribed, trace_solved};

use super::{FlowLaw, PrescribedFlow};
use crate::physics::{
    flow::{FOLLOWED_TURN, FlowForces, FlowSolver},
    sphere::{Cap, CubedSphere, HaloTable, PaddedField},
};

/// How a film is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmRules {
    /// Where the film ends, if anywhere. Beyond stands its image, which nothing shows or counts.
    pub cap: Option<Cap>,
    /// Angular radius of the drop at its lowest point, if there is one, radians.
    pub drop_rad: Option<f64>,
    /// When its map is remapped.
    pub remap: RemapRule,
}

/// A film in f64, whose thickness, flow and map are on one grid. The tracer is the thickness's departure from the film's level, its mean.
pub struct Film {
    rules: FilmRules,
    halo: HaloTable,
    level_nm: f64,
    tracer: PaddedField<f64>,
    /// What a remap has looked up, before it is the tracer.
    sampled: PaddedField<f64>,
    /// Where the liquid of each cell was at the last remap; none while it is where it was.
    map: Option<PaddedField<DVec3>>,
    /// Where it was when the last step began.
    step_map: PaddedField<DVec3>,
    clock: RemapClock,
    liquid: Liquid,
    flow: FlowSolver,
    log_thickness: PaddedField<f64>,
    forcing: Vec<f64>,
}

impl Film {
    /// A film at rest whose thickness in nm is given at each unit vector.
    #[must_use]
    pub fn new(grid: CubedSphere, rules: FilmRules, thickness_nm: impl Fn(DVec3) -> f64 + Sync) -> Self {
        let halo = HaloTable::new(grid);
        let folded = |x| thickness_nm(rules.cap.map_or(x, |cap| cap.folded(x)));
        let thickness = PaddedField::sample(grid, folded);
        let level_nm = Liquid::of(&thickness, rules.cap).mean();
        let tracer = PaddedField::from_places(grid, 0, |place| thickness.padded()[place] - level_nm);
        Self {
            level_nm,
            liquid: Liquid::of(&tracer, rules.cap),
            sampled: tracer.clone(),
            tracer,
            map: None,
            step_map: identity(grid),
            clock: RemapClock::default(),
            flow: FlowSolver::bounded(grid, rules.cap, rules.drop_rad, |_| 0.0),
            log_thickness: PaddedField::from_cells(grid, &halo, |_| 0.0),
            forcing: vec![0.0; grid.cells()],
            halo,
            rules,
        }
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> CubedSphere {
        self.tracer.grid()
    }

    /// Its flow.
    #[must_use]
    pub fn flow(&self) -> &FlowSolver {
        &self.flow
    }

    /// Its liquid.
    #[must_use]
    pub fn liquid(&self) -> &Liquid {
        &self.liquid
    }

    /// Remaps so far.
    #[must_use]
    pub fn remaps(&self) -> u32 {
        self.clock.remaps
    }

    /// The mean thickness at the start, nm.
    #[must_use]
    pub fn mean_nm(&self) -> f64 {
        self.level_nm + self.liquid.mean()
    }

    /// Moves the film by a step.
    pub fn advance(&mut self, step: &FilmStep) {
        let flow = step.law.prescribed();
        if step.drain.is_some() {
            self.liquid.unbind();
        }
        self.clock.since_decision += step.ticks;
        for part in &step.parts {
            for operation in FREE_STEP {
                self.run(operation, step, &flow, Some(part));
            }
        }
        if !matches!(step.law, FlowLaw::Free(_)) {
            for operation in PRESCRIBED_STEP {
                self.run(operation, step, &flow, None);
            }
        }
    }

    /// Executes one operation of a step.
    fn run(&mut self, operation: Operation, step: &FilmStep, flow: &PrescribedFlow, part: Option<&FreePart>) {
        let grid = self.grid();
        match (operation, part) {
            (Operation::FeelThickness, Some(part)) => {
                let felt = felt_tracer(&self.tracer, self.map.as_ref(), self.rules.cap);
                let reference_nm = part.reference_nm(self.mean_nm());
                let log = log_thickness(&felt, self.level_nm, part, reference_nm);
                self.log_thickness = PaddedField::from_cells(grid, &self.halo, |cell| log[cell]);
            }
            (Operation::BlowAir, Some(part)) => {
                let rate = air_rate(&part.forces, self.mean_nm().max(part.black_nm));
                let blown = |cell| rate * flow.vorticity(grid.cell_direction(cell), part.from_s);
                self.forcing = (0..grid.cells()).map(blown).collect();
            }
            (Operation::Push, Some(part)) => {
                let pushed = source(&part.pushes, &self.flow);
                self.forcing.iter_mut().zip(pushed).for_each(|(forcing, push)| *forcing += push);
            }
            (Operation::StepFlow, Some(part)) => self.step_flow(part),
            (Operation::TraceStep, Some(part)) => self.step_map = trace_solved(&self.flow.velocity(), part.dt_s),
            (Operation::TraceStep, None) => {
                let dt_s = f64::from(step.ticks) * step.tick_s;
                self.step_map = trace_prescribed(grid, flow, step.from_s + dt_s, dt_s);
            }
            (Operation::ComposeMap, _) => self.map = Some(compose_map(self.step_map.clone(), self.map.as_ref())),
            (Operation::DecideRemap, _) => self.remap_if_due(step),
            // A flow in closed form feels nothing.
            (_, None) => {}
        }
    }

    /// Moves the flow by a step; what turns too fast for one is tried first.
    fn step_flow(&mut self, part: &FreePart) {
        let forcing = PaddedField::from_cells(self.grid(), &self.halo, |cell| self.forcing[cell]);
        self.flow.stir(forcing);
        // The flow knows thicknesses relative to a reference.
        let air_drag = part.forces.air_drag / part.reference_nm(self.mean_nm());
        let forces = FlowForces { air_drag, ..part.forces };
        if part.strain * part.dt_s > FOLLOWED_TURN {
            self.flow.step_corrected(part.dt_s, &forces, &self.log_thickness);
        } else {
            self.flow.step(part.dt_s, &forces, &self.log_thickness);
        }
    }

    /// Decides on a remap as often as it must, and lets what it is due for happen.
    fn remap_if_due(&mut self, step: &FilmStep) {
        let spreads = DiffusionPlan::new(step.law.diffusion(), step.tick_s, self.grid().cell_angle());
        let drains = step.drain.as_ref().map(|(_, max_ticks)| *max_ticks);
        let rule = self.rules.remap.no_later_than([spreads.map(|plan| plan.latest_ticks), drains]);
        let (ticks, Some(map)) = (self.clock.since_decision, &self.map) else { return };
        if ticks < rule.decision_ticks() || !self.clock.decide(rule, map) {
            return;
        }
        let is_surprise = !rule.is_due_after(ticks);
        for operation in REMAP {
            self.remap(operation, step, spreads.as_ref(), is_surprise);
        }
    }

    /// Executes one operation of a remap. Of one that only the map's distortion told the device of, it finds the identity written down, and looks
    /// through it like through any map.
    fn remap(
        &mut self,
        operation: RemapOperation,
        step: &FilmStep,
        spreads: Option<&DiffusionPlan>,
        is_surprise: bool,
    ) {
        let ticks = self.clock.remapped;
        match operation {
            RemapOperation::SampleTracer => {
                self.sampled = sample_tracer(&self.tracer, self.map.as_ref(), self.rules.cap);
            }
            RemapOperation::Diffuse => {
                if let Some(plan) = spreads {
                    self.sampled = diffuse(self.sampled.clone(), plan, ticks, &self.halo);
                }
            }
            RemapOperation::Settle => self.tracer = self.liquid.restored(&self.sampled),
            RemapOperation::Drain => {
                if let Some((law, _)) = &step.drain {
                    let drained = drain(&self.tracer, law, self.level_nm, ticks, self.rules.cap);
                    self.liquid.count_drained(&drained);
                    self.tracer = self.liquid.restored(&drained);
                }
            }
            RemapOperation::Blacken => {
                if let Some(law) = &step.blackening {
                    self.blacken(law, ticks);
                }
            }
            RemapOperation::ResetMap => self.map = is_surprise.then(|| identity(self.grid())),
        }
    }

    /// Evaporation has ended where film is black, and what collapsing film loses goes to the film as a whole.
    fn blacken(&mut self, law: &BlackeningLaw, ticks: u32) {
        if law.evaporated_nm > 0.0 {
            self.tracer = stop_evaporation(&self.tracer, law, self.level_nm);
            self.liquid.count_spared(&self.tracer);
        }
        self.tracer = self.liquid.restored(&collapse(&self.tracer, law, self.level_nm, ticks, &self.halo));
    }

    /// Thickness in nm at each cell, in the grid's order, as if nothing had evaporated.
    #[must_use]
    pub fn thickness_nm(&self) -> Vec<f64> {
        self.shown(self.map.as_ref())
    }

    /// This thickness a fraction of a step later, in the law that drives the film from a time in seconds on for a number of seconds.
    #[must_use]
    pub fn thickness_ahead_nm(&self, law: FlowLaw, from_s: f64, dt_s: f64) -> Vec<f64> {
        let step = match law {
            FlowLaw::Free(_) => trace_solved(&self.flow.velocity(), dt_s),
            _ => trace_prescribed(self.grid(), &law.prescribed(), from_s + dt_s, dt_s),
        };
        self.shown(Some(&compose_map(step, self.map.as_ref())))
    }

    fn shown(&self, map: Option<&PaddedField<DVec3>>) -> Vec<f64> {
        let sampled = sample_tracer(&self.tracer, map, self.rules.cap);
        self.liquid.restored(&sampled).cells().into_iter().map(|departure| self.level_nm + departure).collect()
    }
}

/// The map of liquid that is where it was.
fn identity(grid: CubedSphere) -> PaddedField<DVec3> {
    PaddedField::sample(grid, |x| x)
}
