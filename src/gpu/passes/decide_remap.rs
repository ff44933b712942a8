//! Decides on the device whether a film's map is remapped.

use super::conserve::parts;
use crate::gpu::{
    control::{Control, ControlBlock, RemapArguments},
    device::GpuError,
    grid::Grid,
    kernel::{ReadWrite, Texture2dArray, Uniform, kernels, shader_struct},
    timing::Recorder,
};

pub use crate::physics::film::model::RemapRule;

shader_struct! {
    /// See `shaders/pass/decide_remap.wgsl`.
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
}

kernels! {
    pass decide_remap;

    /// Measures what interpolating the map errs by. One invocation for four cells.
    struct MeasureDistortion {
        @0 decide: Uniform<DecideUniform>;
        @1 control: ReadWrite<ControlBlock>;
        @2 map: Texture2dArray;
    }
    compute measure_distortion;

    /// Decides, and writes the workgroups of all that a remap takes: none where none is due.
    struct DecideRemap {
        @0 decide: Uniform<DecideUniform>;
        @1 control: ReadWrite<ControlBlock>;
        @3 arguments: ReadWrite<RemapArguments>;
    }
    compute decide_remap;
}

/// Records the decision about a map, some ticks after the one before.
pub fn decide_remap(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    (film, tracer): (&Grid, &Grid),
    map: &wgpu::TextureView,
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
    let decide = &recorder.gpu.uniform("decide", &uniform);
    let Control { block, arguments, .. } = control;
    if !rule.is_due_after(ticks) {
        let half = film.cells.div_ceil(2);
        let groups = [half.div_ceil(64), half, 6];
        MeasureDistortion { decide, control: block, map }.measure_distortion(recorder, name, groups)?;
    }
    DecideRemap { decide, control: block, arguments }.decide_remap(recorder, name, [1; 3])
}
