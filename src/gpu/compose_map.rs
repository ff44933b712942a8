//! Advances the flow map by a step that was traced on a coarser grid.

use bytemuck::{Pod, Zeroable};

use super::{GpuError, advance_map::MapBuffers, pipelines::ComputeKey, timing::Recorder};

/// See `shaders/pass/compose_map.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ComposeUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// The same of the grid that the step was traced on.
    pub step_cells: u32,
    /// 1 right after a remap.
    pub map_is_identity: u32,
    pad: u32,
}

/// Records the composition of the map with a step, which is given with its halo.
pub fn compose_map(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    (step_cells, step_map): (u32, &wgpu::Buffer),
    map: &MapBuffers<'_>,
) -> Result<(), GpuError> {
    let gpu = recorder.gpu;
    let key = ComputeKey { pass: "compose_map", entry: "compose_map", constants: vec![] };
    let pipeline = gpu.pipelines.compute(gpu, &key)?;
    let map_is_identity = u32::from(map.before.is_none());
    let uniform = gpu.uniform("compose", &ComposeUniform { cells: map.cells, step_cells, map_is_identity, pad: 0 });
    // Where the map is the identity nothing is read from it, and any buffer of the right kind will do.
    let before = map.before.unwrap_or(step_map);
    let bindings = gpu.bind(
        &pipeline.get_bind_group_layout(0),
        &[&uniform, map.tangents, step_map, before, map.after].map(wgpu::Buffer::as_entire_binding),
    );
    recorder.dispatch(name, &pipeline, &bindings, [map.cells.div_ceil(64), map.cells, 6]);
    Ok(())
}
