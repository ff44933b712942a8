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
    /// What is added to corrected values.
    pub level: f32,
    /// Solid angle of the film.
    pub film_area: f32,
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
    (6 * grid.cells * grid.cells).div_ceil(8 * 256).min(256)
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
    /// The field is taken as it is from now on: evaporation spared it.
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
    let (entry, result): (_, &[(u32, &wgpu::Buffer)]) = match excess {
        Excess::Balanced => ("balance_sum", &[(4, sum.balance)]),
        Excess::Spared => ("count_spared", &[]),
        Excess::Drained => ("count_drained", &[]),
    };
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
            level: target.level,
            film_area: sum.grid.film_area as f32,
        },
    );
    let key = |entry| ComputeKey { pass: "conserve", entry, constants: vec![] };
    let [field, sums, areas] = [(2, sum.field), (3, sum.partial_sums), (1, &sum.grid.areas)];
    let parts = bound_all(&[(0, &uniform), areas, field, sums]);
    recorder.compute_at(name, &key("sum_parts"), &parts, sum_groups)?;
    let last = [&[(0, &uniform), sums, (5, sum.control)], result].concat();
    recorder.compute_at(name, &key(entry), &bound_all(&last), one_group)
}

fn bound_all<'a>(buffers: &[(u32, &'a wgpu::Buffer)]) -> Vec<(u32, wgpu::BindingResource<'a>)> {
    buffers.iter().map(|(place, buffer)| (*place, buffer.as_entire_binding())).collect()
}
