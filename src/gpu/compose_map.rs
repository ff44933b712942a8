//! Composes a film's flow map with a step.

use bytemuck::{Pod, Zeroable};

use super::{GpuError, film::Grid, pipelines::ComputeKey, timing::Recorder};

/// See `shaders/pass/compose_map.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ComposeUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// The same of the grid that the step was traced on.
    pub step_cells: u32,
    /// Cells that the first two by two begin before storage does.
    pub quad_skew: u32,
    pad: u32,
}

/// What a composition reads and writes.
pub struct Composition<'a> {
    /// The map's grid.
    pub grid: &'a Grid,
    /// Cells along a panel's edge of the grid that the step was traced on.
    pub step_cells: u32,
    /// The step.
    pub step_map: &'a wgpu::Buffer,
    /// The map before it, if there is one.
    pub before: Option<&'a wgpu::Buffer>,
    /// Whether steps gather anything.
    pub gathers: bool,
    /// The film's control block.
    pub control: &'a wgpu::Buffer,
    /// The map after it.
    pub after: &'a wgpu::Buffer,
}

/// Records one composition.
pub fn compose_map(recorder: &mut Recorder<'_>, name: &'static str, maps: &Composition<'_>) -> Result<(), GpuError> {
    let Composition { grid, step_cells, before, .. } = *maps;
    let uniform = ComposeUniform { cells: grid.cells, step_cells, quad_skew: grid.quad_skew(step_cells), pad: 0 };
    let uniform = recorder.gpu.uniform("compose", &uniform);
    let resources = [
        uniform.as_entire_binding(),
        grid.tangents.as_entire_binding(),
        maps.control.as_entire_binding(),
        maps.step_map.as_entire_binding(),
        // Where there is no map nothing is read from it, and any of the right kind will do.
        before.unwrap_or(maps.step_map).as_entire_binding(),
        maps.after.as_entire_binding(),
    ];
    let constants = vec![
        ("SAME_GRID", u32::from(step_cells == grid.cells)),
        ("HAS_MAP", u32::from(before.is_some())),
        ("GATHERS", u32::from(maps.gathers)),
        // A map is looked up alike whatever the tracer's stencil.
        ("TAPS", 6),
        ("LIMITER", 0),
    ];
    let (entry, groups) = if grid.has_quads_in(step_cells) {
        ("compose_quads", grid.quad_groups(step_cells))
    } else {
        ("compose_map", grid.padded_groups())
    };
    let key = ComputeKey { pass: "compose_map", entry, constants };
    recorder.compute(name, &key, &resources, groups.into())
}
