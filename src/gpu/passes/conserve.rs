//! Finds the smallest correction that restores a film's amount of liquid.

use crate::gpu::{
    control::{BalanceBlock, ControlBlock},
    device::GpuError,
    grid::Grid,
    kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    timing::{Groups, Recorder},
};

shader_struct! {
    /// See `shaders/pass/conserve.wgsl`.
    pub struct ConserveUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Workgroups of the first sum.
        pub parts: u32,
        /// The mean to restore.
        pub mean: f32,
        /// What rounding it left over.
        pub mean_rest: f32,
        /// Lower bound of values.
        pub low: f32,
        /// Upper bound of values.
        pub high: f32,
        /// Whether the bounds count.
        pub bounded: u32,
        /// What is added to corrected values.
        pub level: f32,
        /// Solid angle of the film.
        pub film_area: f32,
    }
}

/// Sums of workgroups that there is room for.
pub const PARTS: usize = 256;

kernels! {
    pass conserve;

    /// The sums of workgroups.
    struct SumParts {
        @0 conserve: Uniform<ConserveUniform>;
        @1 areas: Read<[f32]>;
        @2 field: Read<[f32]>;
        @3 partial_sums: ReadWrite<[f32; PARTS]>;
    }
    compute sum_parts;

    /// The excess as what evaporation has spared, or what it lacks as drained.
    struct CountExcess {
        @0 conserve: Uniform<ConserveUniform>;
        @3 partial_sums: ReadWrite<[f32; PARTS]>;
        @5 control: ReadWrite<ControlBlock>;
    }
    compute count_spared, count_drained;

    /// The correction that takes the excess away.
    struct BalanceSum {
        @0 conserve: Uniform<ConserveUniform>;
        @3 partial_sums: ReadWrite<[f32; PARTS]>;
        @4 balance: ReadWrite<BalanceBlock>;
        @5 control: ReadWrite<ControlBlock>;
    }
    compute balance_sum;
}

/// What must be conserved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// Mean over the film.
    pub mean: f64,
    /// Bounds that corrected values must keep, if any.
    pub bounds: Option<[f32; 2]>,
    /// What is then added to them.
    pub level: f32,
}

/// Workgroups that a sum over a grid takes, of 256 invocations that first add eight cells each: barriers cost more than sums.
#[must_use]
pub fn parts(grid: &Grid) -> u32 {
    (6 * grid.cells * grid.cells).div_ceil(8 * 256).min(PARTS as u32)
}

/// What is summed, and where the sums go.
pub struct Sum<'a> {
    /// The field's grid.
    pub grid: &'a Grid,
    /// The field.
    pub field: &'a wgpu::Buffer,
    /// Room for sums of workgroups.
    pub partial_sums: &'a wgpu::Buffer,
    /// The correction.
    pub balance: &'a wgpu::Buffer,
    /// The film's control block.
    pub control: &'a wgpu::Buffer,
}

/// What becomes of how far a field is from its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// It is corrected.
    Balanced,
    /// The present amount is conserved from now on: evaporation has spared some film.
    Spared,
    /// What the field lacks has drained.
    Drained,
}

/// Records the two passes that sum a field's excess over its target, and what becomes of it; their workgroups are given in turn.
pub fn conserve(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    target: Target,
    sum: &Sum<'_>,
    [sum_groups, one_group]: [Groups<'_>; 2],
    excess: Excess,
) -> Result<(), GpuError> {
    let mean = target.mean as f32;
    let [low, high] = target.bounds.unwrap_or_default();
    let conserve = &recorder.gpu.uniform(
        "conserve",
        &ConserveUniform {
            cells: sum.grid.cells,
            parts: parts(sum.grid),
            mean,
            mean_rest: (target.mean - f64::from(mean)) as f32,
            low,
            high,
            bounded: u32::from(target.bounds.is_some()),
            level: target.level,
            film_area: sum.grid.film_area as f32,
        },
    );
    let Sum { grid, field, partial_sums, balance, control } = *sum;
    SumParts { conserve, areas: &grid.areas, field, partial_sums }.sum_parts(recorder, name, sum_groups)?;
    let count = CountExcess { conserve, partial_sums, control };
    match excess {
        Excess::Balanced => {
            BalanceSum { conserve, partial_sums, balance, control }.balance_sum(recorder, name, one_group)
        }
        Excess::Spared => count.count_spared(recorder, name, one_group),
        Excess::Drained => count.count_drained(recorder, name, one_group),
    }
}
