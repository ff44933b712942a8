//! Brings what a film shows into a buffer.

use super::{GpuError, film::Grid, pipelines::ComputeKey, timing::Recorder};

/// The shown values in the grid's order of cells.
pub fn read_film(recorder: &mut Recorder<'_>, grid: &Grid, film: &wgpu::TextureView) -> Result<wgpu::Buffer, GpuError> {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let values = recorder.gpu.buffer("film values", grid.sphere.cells() as u64 * 4, usage);
    let key = ComputeKey { pass: "read_film", entry: "read_film", constants: vec![] };
    let resources = [wgpu::BindingResource::TextureView(film), values.as_entire_binding()];
    recorder.compute("read_film", &key, &resources, grid.cell_groups().into())?;
    Ok(values)
}
