//! The drop that may hang at a film's bottom: it holds the film fast.

use super::FlowGrid;
use crate::gpu::{
    device::{Gpu, GpuError},
    passes::flow_pin::{FlowPin, PinUniform},
    timing::{Recorder, STEP_FLOW},
    uniform_buffer::UniformBuffer,
};
use crate::physics::flow::PinnedRegion;

/// What holds the film fast.
pub(super) struct PinnedDrop {
    uniform: UniformBuffer<PinUniform>,
}

impl PinnedDrop {
    /// A drop of an angular radius in radians.
    pub(super) fn new(gpu: &Gpu, grid: &FlowGrid, radius: f64) -> Self {
        let PinnedRegion { outer, inner } = PinnedRegion::new(radius, grid.sphere.cell_angle());
        let uniform = PinUniform { cells: grid.sphere.n() as u32, rim: outer as f32, inner: inner as f32, padding: 0 };
        Self { uniform: gpu.uniform("pin", &uniform) }
    }

    /// Stops what flows in the drop.
    pub(super) fn stop(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &FlowGrid,
        zeta: &wgpu::Buffer,
        psi: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let kernel = FlowPin { pin: &self.uniform, tangents: &grid.tangents, zeta, psi };
        kernel.flow_pin(recorder, STEP_FLOW, grid.film_groups())?;
        grid.fill_halo(recorder, psi)
    }
}
