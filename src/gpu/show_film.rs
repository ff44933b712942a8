//! Puts a film into the texture that pictures read.

use super::{GpuError, film::Grid, pipelines::ComputeKey, timing::Recorder};

/// Records the pass: what was sampled, with its liquid restored by a correction.
pub fn show_film(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    grid: &Grid,
    balance: &wgpu::Buffer,
    sampled: &wgpu::Buffer,
    film: &wgpu::TextureView,
) -> Result<(), GpuError> {
    let key = ComputeKey { pass: "show_film", entry: "show_film", constants: vec![] };
    let film = wgpu::BindingResource::TextureView(film);
    let resources = [balance.as_entire_binding(), sampled.as_entire_binding(), film];
    recorder.compute(name, &key, &resources, grid.padded_groups().into())
}
