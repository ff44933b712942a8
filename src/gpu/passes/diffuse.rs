//! Spreads what a remap sampled by diffusion within the film.

use super::flow_halo::halo_of_thickness;
use crate::gpu::{
    control::{Control, ControlBlock},
    device::{Gpu, GpuError},
    grid::Grid,
    kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    timing::{Recorder, STEP_FIELD},
};

shader_struct! {
    /// See `shaders/pass/diffuse.wgsl`.
    pub struct DiffuseUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Which stage, from 1.
        pub stage: u32,
        /// Squared cell angles a tick and part, times the stage's weight.
        pub rate: f32,
        /// The same in any one part at most.
        pub most: f32,
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

/// Stages of a part: as many as a panel's halo is wide.
const STAGES: u32 = 3;
/// Squared cell angles that one part can spread over: s stages are stable for (s² + s)/2 explicit steps, and one of those for 1/6, for at a
/// panel's corners cells are narrower than at its centre.
const MOST_A_PART: f64 = 0.9;
/// Parts of one diffusion at most.
const MOST_PARTS: u32 = 4;
/// How long a film is moved without being diffused, if that needs no more parts: filaments reach the grid in a few tenths of a second.
const USUAL_S: f64 = 0.1;
/// The longest that it is, if as many parts can do it.
const LONGEST_S: f64 = 0.2;

/// Diffusion of a film's thickness, done at remaps.
pub struct Diffusion {
    law: (f64, f64),
    /// Squared cell angles a tick.
    per_tick: f64,
    parts: u32,
    latest_ticks: u32,
    spread: wgpu::Buffer,
}

impl Diffusion {
    /// Diffusion of so many rad²/s on a grid, for ticks of a length in seconds; nothing if nothing spreads.
    #[must_use]
    pub fn new(gpu: &Gpu, grid: &Grid, rad2_s: f64, tick_s: f64) -> Option<Self> {
        let per_tick = rad2_s * tick_s / grid.sphere.cell_angle().powi(2);
        if per_tick <= 0.0 {
            return None;
        }
        let [usual_ticks, longest_ticks] = [USUAL_S, LONGEST_S].map(|most_s| (most_s / tick_s).max(1.0));
        let parts = (usual_ticks * per_tick / MOST_A_PART).ceil().min(f64::from(MOST_PARTS));
        let latest_ticks = longest_ticks.min(parts * MOST_A_PART / per_tick).max(1.0) as u32;
        Some(Self {
            law: (rad2_s, tick_s),
            per_tick,
            parts: parts as u32,
            latest_ticks,
            spread: grid.field(gpu, "spread", 4),
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
        self.latest_ticks
    }

    /// Records the diffusion of a field over the ticks since the last remap, if one is due. The other buffer is overwritten.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        control: &Control,
        field: &wgpu::Buffer,
        spare: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let fields = [field, spare, &self.spread, field];
        for _ in 0..self.parts {
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
                kernel.diffuse_stage(recorder, STEP_FIELD, control.tracer_groups())?;
            }
            halo_of_thickness(recorder, grid, field, control.one_group())?;
        }
        Ok(())
    }

    /// The stage's numbers: with w = 2 / (s² + s), stage j is (2j−1)/j of the one before, (1−j)/j of that before, and w (2j−1)/j of the
    /// Laplacian.
    fn uniform(&self, grid: &Grid, stage: u32) -> DiffuseUniform {
        let (j, s) = (f64::from(stage), f64::from(STAGES));
        let before = (2.0 * j - 1.0) / j;
        let weight = before * 2.0 / (s * s + s);
        DiffuseUniform {
            cells: grid.cells,
            stage,
            rate: (weight * self.per_tick / f64::from(self.parts)) as f32,
            most: (weight * MOST_A_PART) as f32,
            before: before as f32,
            earlier: ((1.0 - j) / j) as f32,
            pad: [0; 2],
        }
    }
}
