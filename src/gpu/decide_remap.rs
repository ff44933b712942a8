//! Decides on the device whether a film's map is remapped.

use bytemuck::{Pod, Zeroable};

use super::{
    GpuError,
    conserve::parts,
    film::{Control, Grid},
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};

pub use crate::physics::film::model::RemapRule;

/// See `shaders/pass/decide_remap.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct DecideUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Angle between neighbouring cells.
    pub cell_angle: f32,
    /// Error of interpolating the map at which it is remapped.
    pub error_limit: f32,
    /// Ticks since the last decision.
    pub ticks: u32,
    /// The most ticks between two remaps.
    pub latest_ticks: u32,
    pad: [u32; 3],
    /// Workgroups of a pass over the tracer's texels.
    pub tracer_groups: [u32; 3],
    /// Workgroups of its sum.
    pub sum_groups: u32,
    /// Workgroups of a pass over the map's texels.
    pub map_groups: [u32; 3],
    pad_middle: u32,
    /// Workgroups of a pass over the tracer's texels, two by two.
    pub quad_groups: [u32; 3],
    pad_end: u32,
}

/// Records the decision about a map, some ticks after the one before.
pub fn decide_remap(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    (film, tracer): (&Grid, &Grid),
    map: &wgpu::Buffer,
    control: &Control,
    (ticks, rule): (u32, RemapRule),
) -> Result<(), GpuError> {
    let uniform = DecideUniform {
        cells: film.cells,
        cell_angle: film.sphere.cell_angle() as f32,
        error_limit: rule.error_limit_cells,
        ticks,
        latest_ticks: rule.latest_ticks,
        pad: [0; 3],
        tracer_groups: tracer.padded_groups(),
        sum_groups: parts(tracer),
        map_groups: film.padded_groups(),
        pad_middle: 0,
        quad_groups: tracer.quad_groups(film.cells),
        pad_end: 0,
    };
    let uniform = recorder.gpu.uniform("decide", &uniform);
    let key = |entry| ComputeKey { pass: "decide_remap", entry, constants: vec![] };
    let [uniform, block, arguments] =
        [&uniform, &control.block, &control.arguments].map(wgpu::Buffer::as_entire_binding);
    if !rule.is_due_after(ticks) {
        let measured = [(0, uniform.clone()), (1, block.clone()), (2, map.as_entire_binding())];
        // One invocation for four cells.
        let half = film.cells.div_ceil(2);
        recorder.compute_at(name, &key("measure_distortion"), &measured, [half.div_ceil(64), half, 6].into())?;
    }
    let decided = [(0, uniform), (1, block), (3, arguments)];
    recorder.compute_at(name, &key("decide_remap"), &decided, Groups::Count([1; 3]))
}
