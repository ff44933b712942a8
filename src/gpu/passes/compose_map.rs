//! Composes a film's flow map with a step.

use crate::gpu::{
    control::ControlBlock,
    device::GpuError,
    grid::Grid,
    kernel::{Read, ReadWrite, Rgba32Float, Texture2dArray, Uniform, Written2dArray, kernels, shader_struct},
    timing::Recorder,
};

shader_struct! {
    /// See `shaders/pass/compose_map.wgsl`.
    pub struct ComposeUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Cells along a panel's edge of the grid that the step was traced on.
        pub step_cells: u32,
        /// Cells that the first two by two begin before storage does.
        pub quad_skew: u32,
        pad: u32,
    }
}

kernels! {
    pass compose_map;

    /// Looks the map before a step up where the step leads to. A map is looked up alike whatever the tracer's stencil.
    struct ComposeMap {
        const TAPS: u32 = 6;
        const LIMITER: bool = false;
        override SAME_GRID: bool;
        override HAS_MAP: bool;
        @0 compose: Uniform<ComposeUniform>;
        @1 tangents: Read<[f32]>;
        @2 control: ReadWrite<ControlBlock>;
        @3 step_map: Texture2dArray;
        @4 map_before: Texture2dArray;
        @5 map_after: Written2dArray<Rgba32Float>;
    }
    compute compose_map, compose_quads;
}

/// What a composition reads and writes.
pub struct Composition<'a> {
    /// The map's grid.
    pub grid: &'a Grid,
    /// Cells along a panel's edge of the grid that the step was traced on.
    pub step_cells: u32,
    /// The step.
    pub step_map: &'a wgpu::TextureView,
    /// The map before it, if there is one.
    pub before: Option<&'a wgpu::TextureView>,
    /// The film's control block.
    pub control: &'a wgpu::Buffer,
    /// The map after it.
    pub after: &'a wgpu::TextureView,
}

/// Records one composition.
pub fn compose_map(recorder: &mut Recorder<'_>, name: &'static str, maps: &Composition<'_>) -> Result<(), GpuError> {
    let Composition { grid, step_cells, before, .. } = *maps;
    let uniform = ComposeUniform { cells: grid.cells, step_cells, quad_skew: grid.quad_skew(step_cells), pad: 0 };
    let kernel = ComposeMap {
        SAME_GRID: step_cells == grid.cells,
        HAS_MAP: before.is_some(),
        compose: &recorder.gpu.uniform("compose", &uniform),
        tangents: &grid.tangents,
        control: maps.control,
        step_map: maps.step_map,
        // Where there is no map nothing is read from it, and any of the right kind will do.
        map_before: before.unwrap_or(maps.step_map),
        map_after: maps.after,
    };
    if grid.has_quads_in(step_cells) {
        kernel.compose_quads(recorder, name, grid.quad_groups(step_cells))
    } else {
        kernel.compose_map(recorder, name, grid.padded_groups())
    }
}
