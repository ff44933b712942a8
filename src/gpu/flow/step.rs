//! A step of the flow: the passes in order.

use bytemuck::Zeroable;

use super::{FlowSolver, multigrid::System};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        passes::{
            flow_combine::{CombineUniform, FlowCombine, FlowCombineAndSum},
            flow_force::{FilmForces, FlowForce},
            flow_halo::{HaloOfPair, HaloOfTwo, HaloOfVelocities},
            flow_measure::{FlowMeasure, FlowUniform},
            flow_residual::MAX_FILMS,
            flow_trace::{TraceTracer, TraceVorticity},
            flow_velocity::FlowVelocity,
        },
        timing::{Recorder, STEP_FLOW},
        uniform_buffer::UniformBuffer,
    },
    physics::flow::{FlowForces, MIN_AIR_SPEED},
};

impl FlowSolver {
    /// Takes a step of all films, each under its forces, after a number of trial steps, which improve the velocity that it is taken with.
    pub(super) fn take(
        &mut self,
        recorder: &mut Recorder<'_>,
        dt_s: f64,
        forces: &[FlowForces],
        trials: usize,
    ) -> Result<(), GpuError> {
        if !(dt_s.is_finite() && dt_s > 0.0) {
            return Ok(());
        }
        // All of the state is read and written.
        recorder.counts.state_bytes += 2 * self.state().map(wgpu::Buffer::size).iter().sum::<u64>();
        let uniform = self.uniform(recorder.gpu, dt_s);
        self.grid.fill_halo(recorder, &self.log_thickness)?;
        let is_first = !std::mem::replace(&mut self.has_history, true);
        if is_first {
            recorder.encoder().copy_buffer_to_buffer(&self.psi, 0, &self.psi_before, 0, self.psi.size());
            self.find_velocity(recorder, &uniform, &self.psi, &self.psi_before)?;
        }
        // Without a trial the first step would be of first order, and all that follow inherit its error.
        for _ in 0..trials + usize::from(is_first) {
            self.advance(recorder, dt_s, forces, &uniform)?;
            // The ψ a step before from which a straight line leads to where the trial did.
            self.combine(recorder, &[(2.0, &self.psi), (-1.0, &self.psi_next)], 0.0, &self.psi_before)?;
            self.find_velocity(recorder, &uniform, &self.psi, &self.psi_before)?;
        }
        self.advance(recorder, dt_s, forces, &uniform)?;
        std::mem::swap(&mut self.zeta, &mut self.moved);
        std::mem::swap(&mut self.psi_before, &mut self.psi);
        std::mem::swap(&mut self.psi, &mut self.psi_next);
        self.find_velocity(recorder, &uniform, &self.psi, &self.psi_before)
    }

    /// From ζ, ψ and ψ before to the next ζ, in `moved`, and ψ, in `psi_next`.
    fn advance(
        &self,
        recorder: &mut Recorder<'_>,
        dt_s: f64,
        forces: &[FlowForces],
        uniform: &UniformBuffer<FlowUniform>,
    ) -> Result<(), GpuError> {
        let Self { grid, stages: [first, second], .. } = self;
        self.push(recorder, uniform, forces)?;
        let stages: Option<Vec<f64>> = forces.iter().map(|forces| forces.viscous_stage(dt_s)).collect();
        match stages {
            None => self.combine(recorder, &[(1.0, first), (1.0, second)], 0.0, &self.moved)?,
            Some(stages) => self.viscous(recorder, &stages)?,
        }
        self.reflect(recorder, &self.moved)?;
        self.combine(recorder, &[(2.0, &self.psi), (-1.0, &self.psi_before)], -1.0, &self.psi_next)?;
        let systems = vec![System::POISSON; forces.len()];
        self.multigrid.cycles(recorder, grid, (&systems, &self.moved), &self.psi_next, self.cycles.poisson)?;
        self.drop.as_ref().map_or(Ok(()), |drop| drop.stop(recorder, grid, &self.moved, &self.psi_next))
    }

    /// From ζ, ψ and ψ before to what the two viscous stages take.
    fn push(
        &self,
        recorder: &mut Recorder<'_>,
        flow: &UniformBuffer<FlowUniform>,
        forces: &[FlowForces],
    ) -> Result<(), GpuError> {
        let Self { grid, zeta, log_thickness, measures, pushed, decay, velocity_ahead, .. } = self;
        let (tangents, [first_stage, second_stage]) = (&grid.tangents, &self.stages);
        let measure = FlowMeasure {
            flow,
            tangents,
            zeta,
            psi: &self.psi,
            psi_before: &self.psi_before,
            log_thickness,
            velocity: &self.velocity,
            measures,
        };
        measure.flow_measure(recorder, STEP_FLOW, grid.film_groups())?;
        let force = FlowForce {
            flow,
            tangents,
            measures,
            zeta,
            log_thickness,
            velocity: velocity_ahead,
            forcing: &self.forcing,
            pushed,
            decay,
            forces: &recorder.gpu.uniform("forces", &film_forces(forces)),
        };
        force.flow_force(recorder, STEP_FLOW, grid.groups())?;
        HaloOfPair { entries: &grid.halo, pair: pushed }.halo_of_pair(recorder, STEP_FLOW, grid.film_groups())?;
        let trace =
            TraceVorticity { flow, tangents, velocity: velocity_ahead, pushed, decay, first_stage, second_stage };
        trace.trace_vorticity(recorder, STEP_FLOW, grid.groups())
    }

    /// Carries ln h along the velocity for `dt_s` seconds on the flow's own grid. For a film whose thickness lives here too.
    pub fn carry_log_thickness(&mut self, recorder: &mut Recorder<'_>, dt_s: f64) -> Result<(), GpuError> {
        let uniform = self.uniform(recorder.gpu, dt_s);
        self.grid.fill_halo(recorder, &self.log_thickness)?;
        let kernel = TraceTracer {
            flow: &uniform,
            tangents: &self.grid.tangents,
            velocity: &self.velocity,
            field: &self.log_thickness,
            moved: &self.moved,
        };
        kernel.trace_tracer(recorder, STEP_FLOW, self.grid.groups())?;
        std::mem::swap(&mut self.log_thickness, &mut self.moved);
        Ok(())
    }

    /// Viscosity on what the two implicit stages take, into `moved`: see the twin.
    fn viscous(&self, recorder: &mut Recorder<'_>, stages: &[f64]) -> Result<(), GpuError> {
        let Self { grid, stages: [first, second], once, twice, moved, .. } = self;
        let root = std::f64::consts::SQRT_2;
        let system = |stage: &f64| System { shift: (1.0 - 2.0 * stage) / stage, gain: -1.0 / stage };
        let systems: &[System] = &stages.iter().map(system).collect::<Vec<_>>();
        for taken in [first, second] {
            self.reflect(recorder, taken)?;
        }
        let fill = HaloOfTwo { entries: &grid.halo, scalar: first, other: second };
        fill.halo_of_two(recorder, STEP_FLOW, grid.film_groups())?;
        recorder.encoder().copy_buffer_to_buffer(first, 0, once, 0, first.size());
        self.multigrid.cycles(recorder, grid, (systems, first), once, self.cycles.viscous)?;
        // What the first stage took away, the second nearly will of its part.
        let guess = FlowCombineAndSum {
            combine: &self.factors(recorder.gpu, [root, 1.0, 1.0 - root], 0.0),
            first: once,
            second,
            third: first,
            combined: moved,
            sum: twice,
        };
        guess.flow_combine_and_sum(recorder, STEP_FLOW, self.value_groups())?;
        self.multigrid.cycles(recorder, grid, (systems, twice), moved, self.cycles.viscous)
    }

    pub(super) fn find_velocity(
        &self,
        recorder: &mut Recorder<'_>,
        uniform: &UniformBuffer<FlowUniform>,
        psi: &wgpu::Buffer,
        before: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let Self { grid, velocity, velocity_ahead, .. } = self;
        let tangents = &grid.tangents;
        let find = FlowVelocity { flow: uniform, tangents, psi, psi_before: before, velocity, velocity_ahead };
        find.flow_velocity(recorder, STEP_FLOW, grid.groups())?;
        let fill = HaloOfVelocities { entries: &grid.halo, velocity, velocity_ahead };
        fill.halo_of_velocities(recorder, STEP_FLOW, grid.film_groups())
    }

    /// The weighted sum of up to three fields and of the guess's mean, halos included.
    fn combine(
        &self,
        recorder: &mut Recorder<'_>,
        terms: &[(f64, &wgpu::Buffer)],
        mean: f32,
        to: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        // Where there are fewer, the first stands for the rest, times nothing.
        let [first, second, third] = [0, 1, 2].map(|k| terms.get(k).copied().unwrap_or((0.0, terms[0].1)));
        let kernel = FlowCombine {
            combine: &self.factors(recorder.gpu, [first.0, second.0, third.0], mean),
            measures: &self.measures,
            first: first.1,
            second: second.1,
            third: third.1,
            combined: to,
        };
        kernel.flow_combine(recorder, STEP_FLOW, self.value_groups())
    }

    fn factors(&self, gpu: &Gpu, terms: [f64; 3], mean: f32) -> UniformBuffer<CombineUniform> {
        let [first, second, third] = terms.map(|factor| factor as f32);
        gpu.uniform("combine", &CombineUniform { first, second, third, mean, values: self.values_of_film() })
    }

    fn values_of_film(&self) -> u32 {
        self.grid.sphere.padded_len() as u32
    }

    /// Workgroups of a pass with one invocation for each cell, halos included, in the order of storage.
    fn value_groups(&self) -> [u32; 3] {
        [self.values_of_film().div_ceil(64), self.grid.films, 1]
    }

    pub(super) fn uniform(&self, gpu: &Gpu, dt_s: f64) -> UniformBuffer<FlowUniform> {
        let uniform = FlowUniform {
            dt_s: dt_s as f32,
            min_air_speed: MIN_AIR_SPEED as f32,
            cell_angle: self.grid.sphere.cell_angle() as f32,
            cells: self.grid.sphere.n() as u32,
        };
        gpu.uniform("flow step", &uniform)
    }
}

/// What acts on each film, as shaders read it.
fn film_forces(forces: &[FlowForces]) -> [FilmForces; MAX_FILMS] {
    let mut found = [FilmForces::zeroed(); MAX_FILMS];
    for (slot, forces) in found.iter_mut().zip(forces) {
        *slot = FilmForces {
            gravity: forces.gravity.as_vec3().to_array(),
            drag: forces.drag as f32,
            air_drag: forces.air_drag as f32,
            padding: [0; 3],
        };
    }
    found
}
