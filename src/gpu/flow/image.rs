//! The rim that a film may end at: beyond it stands the image of its vorticity.

use bytemuck::{Pod, Zeroable};

use super::{
    super::{Gpu, GpuError, film::rim_numbers, timing::Recorder},
    FlowGrid, buffer,
};
use crate::physics::film::Cap;

/// See `shaders/pass/flow_image.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ImageUniform {
    /// Height of the rim.
    pub rim_z: f32,
    /// The inversion in it.
    pub inversion: f32,
    /// Cells along a panel's edge.
    pub cells: u32,
    pad: u32,
}

/// What makes the image.
pub(super) struct FlowImage {
    pub(super) cap: Cap,
    uniform: wgpu::Buffer,
    with_image: wgpu::Buffer,
}

impl FlowImage {
    pub(super) fn new(gpu: &Gpu, grid: &FlowGrid, cap: Cap) -> Self {
        let [rim_z, inversion] = rim_numbers(Some(cap));
        let uniform = ImageUniform { rim_z, inversion, cells: grid.sphere.n() as u32, pad: 0 };
        Self {
            cap,
            uniform: gpu.uniform("image", &uniform),
            with_image: buffer(gpu, "vorticity with its image", grid.sphere.padded_len() as u64 * 4),
        }
    }

    /// Makes vorticity beyond the rim the image of that within.
    pub(super) fn reflect(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &FlowGrid,
        zeta: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        grid.fill_halo(recorder, zeta)?;
        let bound = [&self.uniform, &grid.tangents, zeta, &self.with_image];
        grid.run(recorder, ("flow_image", "flow_image"), &[], &bound, grid.groups())?;
        recorder.encoder().copy_buffer_to_buffer(&self.with_image, 0, zeta, 0, zeta.size());
        Ok(())
    }
}
