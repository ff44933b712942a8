//! Fills the halo of a film's thickness from its cells.

use super::{
    GpuError,
    film::Grid,
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};

/// Records the one workgroup that does it. No value leaves the range of those that it is interpolated from.
pub fn halo_of_thickness(
    recorder: &mut Recorder<'_>,
    grid: &Grid,
    thickness: &wgpu::Buffer,
    one_group: Groups<'_>,
) -> Result<(), GpuError> {
    let key = ComputeKey { pass: "flow_halo", entry: "halo_of_thickness", constants: vec![] };
    let bound = [grid.halo(recorder.gpu), thickness].map(wgpu::Buffer::as_entire_binding);
    recorder.compute("step_field", &key, &bound, one_group)
}
