//! Makes a film's flow map the identity.

use super::{
    GpuError,
    film::Grid,
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};

/// Records the pass.
pub fn reset_map(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    grid: &Grid,
    map: &wgpu::Buffer,
    groups: Groups<'_>,
) -> Result<(), GpuError> {
    let key = ComputeKey { pass: "reset_map", entry: "reset_map", constants: vec![] };
    recorder.compute(name, &key, &[&grid.tangents, map].map(wgpu::Buffer::as_entire_binding), groups)
}
