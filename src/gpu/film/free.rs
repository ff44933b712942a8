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
        let mut solver = FlowSolver::new(gpu, field.flow_grid().cells);
        solver.end_at(gpu, field.rules.cap);
        solver.pin(gpu, field.rules.drop_rad);
        Self { solver }
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
        FREE_STEP.into_iter().try_for_each(|operation| match operation {
            Operation::FeelThickness => self.feel(recorder, field, around),
            Operation::BlowAir => self.blow(recorder, field, around),
            Operation::Push => self.push(recorder, field, &around.part.pushes),
            Operation::StepFlow => self.step_flow(recorder, around),
            of_any_film => field.run(of_any_film, recorder, &self.ahead(around.part.dt_s), ticks),
        })
    }

    /// Moves the flow by a step; what turns too fast for one is tried first.
    fn step_flow(&mut self, recorder: &mut Recorder<'_>, around: &Surroundings<'_>) -> Result<(), GpuError> {
        let FreePart { dt_s, strain, forces, .. } = *around.part;
        // The flow knows thicknesses relative to a reference.
        let forces = FlowForces { air_drag: forces.air_drag / around.reference_nm(), ..forces };
        if strain * dt_s > FOLLOWED_TURN {
            self.solver.step_corrected(recorder, dt_s, &forces)
        } else {
            self.solver.step(recorder, dt_s, &forces)
        }
    }

    /// A step of the film in the velocity of now.
    #[must_use]
    pub fn ahead(&self, dt_s: f64) -> Step {
        Step::Solved(self.solver.velocity().clone(), dt_s)
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
            film: 0,
        };
        let map = field.map_so_far();
        let kernel = FlowThickness {
            HAS_MAP: map.is_some(),
            HAS_RIM: field.rules.cap.is_some(),
            thickness: &recorder.gpu.uniform("flow thickness", &uniform),
            tangents: &flow.tangents,
            control: &field.control.block,
            // Where there is no map nothing is read from it, and any buffer will do.
            map: map.unwrap_or(&field.tracer),
            tracer: &field.tracer,
            log_thickness: self.solver.log_thickness(),
        };
        kernel.flow_thickness(recorder, STEP_FLOW, flow.cell_groups())
    }

    /// Lets the air stir the film.
    fn blow(&self, recorder: &mut Recorder<'_>, field: &Field, around: &Surroundings<'_>) -> Result<(), GpuError> {
        let flow = field.flow_grid();
        let rate = air_rate(&around.part.forces, around.mean_nm.max(around.part.black_nm));
        let gusts = &gusts(recorder.gpu, &around.air.frozen_at(around.part.from_s), flow.cells, rate);
        let kernel = FlowGusts { gusts, tangents: &flow.tangents, forcing: self.solver.forcing() };
        kernel.flow_gusts(recorder, STEP_FLOW, flow.cell_groups())
    }

    /// Adds what pushes the film to what the air does.
    fn push(&self, recorder: &mut Recorder<'_>, field: &Field, pushes: &[Push]) -> Result<(), GpuError> {
        let flow = field.flow_grid();
        for some in pushes.chunks(MAX_PUSHES) {
            let mut uniform = PushesUniform { cells: flow.cells, count: some.len() as u32, ..PushesUniform::zeroed() };
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

fn gusts(gpu: &Gpu, air: &FrozenFlow, cells: u32, rate: f64) -> UniformBuffer<GustsUniform> {
    let mut uniform = Box::new(GustsUniform {
        cells,
        waves_count: air.waves.len().min(MAX_WAVES) as u32,
        vortices_count: air.vortices.len().min(MAX_VORTICES) as u32,
        rate: rate as f32,
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
