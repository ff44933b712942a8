//! Finds the smallest correction that restores a film's amount of liquid.

use bytemuck::{Pod, Zeroable};

use super::{
    GpuError,
    film::Grid,
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};

/// See `shaders/pass/conserve.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
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
    pad: u32,
}

/// What must be conserved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// Mean over the sphere.
    pub mean: f64,
    /// Bounds that corrected values must keep, if any.
    pub bounds: Option<[f32; 2]>,
}

/// Workgroups that a sum over a grid takes.
#[must_use]
pub fn parts(grid: &Grid) -> u32 {
    (6 * grid.cells * grid.cells).div_ceil(256).min(256)
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
}

/// Records the two passes, whose workgroups are given in turn.
pub fn conserve(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    target: Target,
    sum: &Sum<'_>,
    [sum_groups, one_group]: [Groups<'_>; 2],
) -> Result<(), GpuError> {
    let mean = target.mean as f32;
    let [low, high] = target.bounds.unwrap_or_default();
    let uniform = recorder.gpu.uniform(
        "conserve",
        &ConserveUniform {
            cells: sum.grid.cells,
            parts: parts(sum.grid),
            mean,
            mean_rest: (target.mean - f64::from(mean)) as f32,
            low,
            high,
            bounded: u32::from(target.bounds.is_some()),
            pad: 0,
        },
    );
    let key = |entry| ComputeKey { pass: "conserve", entry, constants: vec![] };
    let shared = [uniform.as_entire_binding(), sum.grid.areas.as_entire_binding()];
    let [field, sums, balance] = [sum.field, sum.partial_sums, sum.balance].map(wgpu::Buffer::as_entire_binding);
    let [uniform, areas] = shared;
    recorder.compute_at(
        name,
        &key("sum_parts"),
        &[(0, uniform.clone()), (1, areas), (2, field), (3, sums.clone())],
        sum_groups,
    )?;
    recorder.compute_at(name, &key("balance_sum"), &[(0, uniform), (3, sums), (4, balance)], one_group)
}
