//! Spreads what a remap sampled by diffusion within the film.

use super::flow_halo::halo_of_thickness;
use crate::gpu::{
    control::{Control, ControlBlock},
    device::{Gpu, GpuError},
    grid::Grid,
    kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    timing::{Recorder, STEP_FIELD},
};
use crate::physics::film::model::{DiffusionPlan, MAX_SPREAD_PER_PART, STAGES, stage_factors};

shader_struct! {
    /// See `shaders/pass/diffuse.wgsl`.
    pub struct DiffuseUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Which stage, from 1.
        pub stage: u32,
        /// Squared cell angles a tick and part, times the stage's weight.
        pub rate: f32,
        /// Largest rate that one part of the diffusion can take.
        pub max_spread: f32,
        /// Factor of the stage before.
        pub before: f32,
        /// Factor of the stage before that.
        pub earlier: f32,
        pad: [u32; 2],
    }
}

kernels! {
    pass diffuse;

    /// One stage, from the two before it.
    struct DiffuseStage {
        @0 diffuse: Uniform<DiffuseUniform>;
        @1 tangents: Read<[f32]>;
        @2 control: ReadWrite<ControlBlock>;
        @3 stage_before: Read<[f32]>;
        @4 stage_earlier: Read<[f32]>;
        @5 stage: ReadWrite<[f32]>;
    }
    compute diffuse_stage;
}

/// Diffusion of a film's thickness, done at remaps.
pub struct Diffusion {
    law: (f64, f64),
    plan: DiffusionPlan,
    /// Room for two stages.
    stages: [wgpu::Buffer; 2],
}

impl Diffusion {
    /// Diffusion on a grid at a rate in rad²/s, for ticks of a length in seconds; none if the rate is 0.
    #[must_use]
    pub fn new(gpu: &Gpu, grid: &Grid, rad2_s: f64, tick_s: f64) -> Option<Self> {
        let plan = DiffusionPlan::new(rad2_s, tick_s, grid.sphere.cell_angle())?;
        Some(Self {
            law: (rad2_s, tick_s),
            plan,
            stages: ["first stage", "second stage"].map(|label| grid.field(gpu, label, 4)),
        })
    }

    /// What it was made for: rad²/s, and the length of a tick in seconds.
    #[must_use]
    pub fn law(&self) -> (f64, f64) {
        self.law
    }

    /// The most ticks between two remaps that it allows.
    #[must_use]
    pub fn latest_ticks(&self) -> u32 {
        self.plan.latest_ticks
    }

    /// Records the diffusion of a field over the ticks since the last remap, if one is due.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        control: &Control,
        field: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let fields = [field, &self.stages[0], &self.stages[1], field];
        for _ in 0..self.plan.parts {
            for stage in 1..=STAGES {
                let k = stage as usize;
                let kernel = DiffuseStage {
                    diffuse: &recorder.gpu.uniform("diffuse", &self.uniform(grid, stage)),
                    tangents: &grid.tangents,
                    control: &control.block,
                    stage_before: fields[k - 1],
                    stage_earlier: fields[k.saturating_sub(2)],
                    stage: fields[k],
                };
                kernel.diffuse_stage(recorder, STEP_FIELD, control.quad_groups())?;
            }
            halo_of_thickness(recorder, grid, field, control.one_group())?;
        }
        Ok(())
    }

    fn uniform(&self, grid: &Grid, stage: u32) -> DiffuseUniform {
        let [before, earlier, weight] = stage_factors(stage);
        DiffuseUniform {
            cells: grid.cells,
            stage,
            rate: (weight * self.plan.per_tick / f64::from(self.plan.parts)) as f32,
            max_spread: (weight * MAX_SPREAD_PER_PART) as f32,
            before: before as f32,
            earlier: earlier as f32,
            pad: [0; 2],
        }
    }
}
