//! A film that moves by itself: the flow feels the thickness through the film's map, and the film follows the flow.

use bytemuck::Zeroable;

use super::Field;
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        flow::{Cycles, FlowSolver},
        grid::rim_numbers,
        passes::{
            flow_gusts::{FlowGusts, GustsUniform},
            flow_push::{FlowPush, MAX_PUSHES, PushesUniform},
            flow_thickness::{FlowThickness, ThicknessUniform},
            trace_step::Step,
        },
        timing::{Recorder, STEP_FLOW},
        uniform_buffer::UniformBuffer,
    },
    physics::{
        film::{
            FrozenFlow, MAX_VORTICES, MAX_WAVES, PrescribedFlow, Push,
            model::{FREE_STEP, FreePart, Operation, air_rate},
        },
        flow::{FOLLOWED_TURN, FlowForces},
    },
};

/// What a free film is subject to during a step.
#[derive(Clone, Copy)]
pub struct Surroundings<'a> {
    /// When the step begins, how long it lasts, and what acts on the film.
    pub part: &'a FreePart,
    /// The air's own motion.
    pub air: &'a PrescribedFlow,
    /// Mean thickness, on which the drag of the air depends, nm.
    pub mean_nm: f64,
}

impl Surroundings<'_> {
    /// Reference thickness of the flow: the mean remaining thickness, so that logarithms are as exact as the tracer.
    fn reference_nm(&self) -> f64 {
        self.part.reference_nm(self.mean_nm)
    }
}

/// A film that moves by itself, in one step of its flow.
pub(super) struct Flowing<'a> {
    pub(super) field: &'a mut Field,
    pub(super) around: Surroundings<'a>,
    /// Ticks that the step counts as.
    pub(super) ticks: u32,
}

/// Moves films by one step each, which lasts as long for all and is tried first for all or for none. The solver has a place for each.
pub(super) fn advance_together(
    recorder: &mut Recorder<'_>,
    solver: &mut FlowSolver,
    films: &mut [Flowing<'_>],
) -> Result<(), GpuError> {
    for operation in FREE_STEP {
        if operation == Operation::StepFlow {
            step_flow(recorder, solver, films)?;
            continue;
        }
        for (film, Flowing { field, around, ticks }) in (0..).zip(&mut *films) {
            let flow = FlowOf { solver, film };
            match operation {
                Operation::FeelThickness => flow.feel(recorder, field, around),
                Operation::BlowAir => flow.blow(recorder, field, around),
                Operation::Push => flow.push(recorder, field, &around.part.pushes),
                of_any_film => field.run(of_any_film, recorder, &flow.ahead(around.part.dt_s), *ticks),
            }?;
        }
    }
    Ok(())
}

/// Whether a step of the flow is tried first, as one is in which eddies turn too far.
pub(super) fn is_corrected(part: &FreePart) -> bool {
    part.strain * part.dt_s > FOLLOWED_TURN
}

/// Moves the flow of all films by a step.
fn step_flow(recorder: &mut Recorder<'_>, solver: &mut FlowSolver, films: &[Flowing<'_>]) -> Result<(), GpuError> {
    let Some(first) = films.first().map(|film| film.around.part) else { return Ok(()) };
    // The flow knows thicknesses relative to a reference.
    let forces = |Flowing { around, .. }: &Flowing<'_>| {
        let forces = around.part.forces;
        FlowForces { air_drag: forces.air_drag / around.reference_nm(), ..forces }
    };
    let forces: Vec<FlowForces> = films.iter().map(forces).collect();
    solver.step_films(recorder, first.dt_s, &forces, is_corrected(first))
}

/// The flow of a film that moves by itself.
pub struct FreeMotion {
    pub(super) solver: FlowSolver,
}

impl FreeMotion {
    /// A flow at rest, for a film.
    pub fn new(recorder: &mut Recorder<'_>, field: &Field) -> Result<Self, GpuError> {
        let mut motion = Self::empty(recorder.gpu, field);
        let still = vec![0.0; motion.solver.sphere().cells()];
        motion.solver.seed(recorder, &still)?;
        Ok(motion)
    }

    /// A flow whose state is yet to come.
    pub(super) fn empty(gpu: &Gpu, field: &Field) -> Self {
        Self { solver: solver_of(gpu, field, 1) }
    }

    /// Sets the number of multigrid cycles per step.
    pub fn solve_in(&mut self, cycles: Cycles) {
        self.solver.cycles = cycles;
    }

    /// The flow.
    #[must_use]
    pub fn flow(&self) -> &FlowSolver {
        &self.solver
    }

    /// Moves a film by one step, that counts as some ticks.
    pub fn advance(
        &mut self,
        recorder: &mut Recorder<'_>,
        field: &mut Field,
        around: &Surroundings<'_>,
        ticks: u32,
    ) -> Result<(), GpuError> {
        advance_together(recorder, &mut self.solver, &mut [Flowing { field, around: *around, ticks }])
    }

    /// A step of the film in the velocity of now.
    #[must_use]
    pub fn ahead(&self, dt_s: f64) -> Step {
        FlowOf { solver: &self.solver, film: 0 }.ahead(dt_s)
    }
}

/// A solver for the flows of some films like one.
pub(super) fn solver_of(gpu: &Gpu, field: &Field, films: usize) -> FlowSolver {
    let mut solver = FlowSolver::of_films(gpu, field.flow_grid().cells, films);
    solver.end_at(gpu, field.rules.cap);
    solver.pin(gpu, field.rules.drop_rad);
    solver
}

/// The flow of one of a solver's films.
struct FlowOf<'a> {
    solver: &'a FlowSolver,
    /// Place of the film.
    film: u32,
}

impl FlowOf<'_> {
    /// A step of the film in the velocity of now.
    fn ahead(&self, dt_s: f64) -> Step {
        Step::Solved { velocity: self.solver.velocity().clone(), film: self.film, dt_s }
    }

    /// Tells the flow the film's thickness.
    fn feel(&self, recorder: &mut Recorder<'_>, field: &Field, around: &Surroundings<'_>) -> Result<(), GpuError> {
        let flow = field.flow_grid();
        let (level_nm, reference_nm) = (f64::from(field.level), around.reference_nm());
        let [rim_z, inversion] = rim_numbers(field.rules.cap);
        let uniform = ThicknessUniform {
            cells: flow.cells,
            map_cells: field.map_grid().cells,
            tracer_cells: field.tracer_grid().cells,
            reference_nm: reference_nm as f32,
            offset_nm: (level_nm - around.part.evaporated_nm - reference_nm) as f32,
            level_nm: (level_nm - reference_nm) as f32,
            black_nm: (around.part.black_nm - reference_nm) as f32,
            rim_z,
            inversion,
            film: self.film,
        };
        let map = field.map_so_far();
        let kernel = FlowThickness {
            HAS_MAP: map.is_some(),
            HAS_RIM: field.rules.cap.is_some(),
            thickness: &recorder.gpu.uniform("flow thickness", &uniform),
            tangents: &flow.tangents,
            control: &field.control.block,
            // Where there is no map nothing is read from it, and any texture will do.
            map: &map.unwrap_or(&field.tracer).view,
            tracer: &field.tracer.view,
            log_thickness: self.solver.log_thickness(),
            point_sampler: recorder.gpu.point_sampler(),
        };
        kernel.flow_thickness(recorder, STEP_FLOW, flow.cell_groups())
    }

    /// Lets the air stir the film.
    fn blow(&self, recorder: &mut Recorder<'_>, field: &Field, around: &Surroundings<'_>) -> Result<(), GpuError> {
        let flow = field.flow_grid();
        let rate = air_rate(&around.part.forces, around.mean_nm.max(around.part.black_nm));
        let air = around.air.frozen_at(around.part.from_s);
        let gusts = &gusts(recorder.gpu, &air, [flow.cells, self.film], rate);
        let kernel = FlowGusts { gusts, tangents: &flow.tangents, forcing: self.solver.forcing() };
        kernel.flow_gusts(recorder, STEP_FLOW, flow.cell_groups())
    }

    /// Adds what pushes the film to what the air does.
    fn push(&self, recorder: &mut Recorder<'_>, field: &Field, pushes: &[Push]) -> Result<(), GpuError> {
        let flow = field.flow_grid();
        for some in pushes.chunks(MAX_PUSHES) {
            let mut uniform = PushesUniform {
                cells: flow.cells,
                count: some.len() as u32,
                film: self.film,
                ..PushesUniform::zeroed()
            };
            for (slot, push) in uniform.pushes.iter_mut().zip(some) {
                *slot = push.frozen();
            }
            let kernel = FlowPush {
                pushes: &recorder.gpu.uniform("pushes", &uniform),
                tangents: &flow.tangents,
                velocity: self.solver.velocity(),
                zeta: self.solver.zeta(),
                forcing: self.solver.forcing(),
            };
            kernel.flow_push(recorder, STEP_FLOW, flow.cell_groups())?;
        }
        Ok(())
    }
}

fn gusts(gpu: &Gpu, air: &FrozenFlow, [cells, film]: [u32; 2], rate: f64) -> UniformBuffer<GustsUniform> {
    let mut uniform = Box::new(GustsUniform {
        cells,
        waves_count: air.waves.len().min(MAX_WAVES) as u32,
        vortices_count: air.vortices.len().min(MAX_VORTICES) as u32,
        rate: rate as f32,
        film,
        ..GustsUniform::zeroed()
    });
    for (slot, wave) in uniform.waves.iter_mut().zip(&air.waves) {
        *slot = *wave;
    }
    for (slot, vortex) in uniform.vortices.iter_mut().zip(&air.vortices) {
        *slot = *vortex;
    }
    gpu.uniform("gusts", &*uniform)
}
