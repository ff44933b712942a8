//! The drop that may hang at a film's bottom: it holds the film fast.

use bytemuck::{Pod, Zeroable};

use super::{
    super::{Gpu, GpuError, timing::Recorder},
    FlowGrid,
};
use crate::physics::flow::PinnedRegion;

/// See `shaders/pass/flow_hold.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct HoldUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Angle from the bottom at which the drop begins, radians.
    pub rim: f32,
    /// That within which nothing flows.
    pub inner: f32,
    pad: u32,
}

/// What holds the film fast.
pub(super) struct FlowHold {
    uniform: wgpu::Buffer,
}

impl FlowHold {
    /// A drop of an angular radius in radians.
    pub(super) fn new(gpu: &Gpu, grid: &FlowGrid, radius: f64) -> Self {
        let PinnedRegion { outer, inner } = PinnedRegion::new(radius, grid.sphere.cell_angle());
        let uniform = HoldUniform { cells: grid.sphere.n() as u32, rim: outer as f32, inner: inner as f32, pad: 0 };
        Self { uniform: gpu.uniform("hold", &uniform) }
    }

    /// Stops what flows in the drop.
    pub(super) fn stop(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &FlowGrid,
        zeta: &wgpu::Buffer,
        psi: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let bound = [&self.uniform, &grid.tangents, zeta, psi];
        grid.run(recorder, ("flow_hold", "flow_hold"), &[], &bound, [1; 3])?;
        grid.fill_halo(recorder, psi)
    }
}
