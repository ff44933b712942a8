//! The rim that a film may end at: beyond it stands the image of its vorticity.

use super::{FlowGrid, buffer};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        grid::rim_numbers,
        passes::flow_mirror::{FlowMirror, MirrorUniform},
        timing::{Recorder, STEP_FLOW},
        uniform_buffer::UniformBuffer,
    },
    physics::film::Cap,
};

/// What makes the image.
pub(super) struct RimMirror {
    pub(super) cap: Cap,
    uniform: UniformBuffer<MirrorUniform>,
    with_mirror: wgpu::Buffer,
}

impl RimMirror {
    pub(super) fn new(gpu: &Gpu, grid: &FlowGrid, cap: Cap) -> Self {
        let [rim_z, inversion] = rim_numbers(Some(cap));
        let uniform = MirrorUniform { rim_z, inversion, cells: grid.sphere.n() as u32, padding: 0 };
        Self {
            cap,
            uniform: gpu.uniform("mirror", &uniform),
            with_mirror: buffer(gpu, "vorticity with its mirror image", grid.padded_len() * 4),
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
        let Self { uniform: mirror, with_mirror, .. } = self;
        let kernel = FlowMirror { mirror, tangents: &grid.tangents, zeta, with_mirror };
        kernel.flow_mirror(recorder, STEP_FLOW, grid.groups())?;
        recorder.encoder().copy_buffer_to_buffer(with_mirror, 0, zeta, 0, zeta.size());
        Ok(())
    }
}
