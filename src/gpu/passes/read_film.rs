//! Copies what a film shows into a buffer.

use crate::gpu::{
    device::GpuError,
    grid::Grid,
    kernel::{ReadWrite, Texture2dArray, kernels},
    timing::Recorder,
};

kernels! {
    pass read_film;

    /// The shown values in the grid's order of cells.
    struct ReadFilm {
        @0 film: Texture2dArray;
        @1 values: ReadWrite<[f32]>;
    }
    compute read_film;
}

/// Records the pass, and gives the buffer.
pub fn read_film(recorder: &mut Recorder<'_>, grid: &Grid, film: &wgpu::TextureView) -> Result<wgpu::Buffer, GpuError> {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let values = recorder.gpu.buffer("film values", grid.sphere.cells() as u64 * 4, usage);
    ReadFilm { film, values: &values }.read_film(recorder, "read_film", grid.cell_groups())?;
    Ok(values)
}
