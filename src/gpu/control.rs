//! What the device itself knows of a film: its control block, the arguments of a remap's dispatches, and the corrections that conserve.

use std::mem::offset_of;

use bytemuck::Zeroable;

use super::{device::Gpu, kernel::shader_struct, timing::Groups, uniform_buffer::UniformBuffer};

shader_struct! {
    /// See `shaders/film/control.wgsl`.
    #[derive(PartialEq)]
    pub struct ControlBlock {
        /// Ticks since the last remap.
        pub ticks_since_remap: u32,
        /// Remaps so far.
        pub remaps: u32,
        /// The map's distortion over the limit, as the bits of a float.
        pub distortion: u32,
        /// Values that were not finite and have been replaced.
        pub sanitised: u32,
        /// Ticks that the last remap came after the one before it.
        pub ticks_remapped: u32,
        /// What evaporation has left in black film, at which it ends, as a mean over the sphere in nm.
        pub spared_nm: f32,
        /// What has left the film at its rim, as a mean over the film in nm.
        pub drained_nm: f32,
    }
}

shader_struct! {
    /// See `shaders/film/control.wgsl`.
    #[derive(PartialEq)]
    pub struct BalanceBlock {
        /// Added to a departure from the film's level.
        pub offset: f32,
        /// Times the departure, added to it.
        pub slope: f32,
        /// The film's level where a thickness is made of the departure, else 0.
        pub level: f32,
    }
}

shader_struct! {
    /// Arguments of the dispatches of a remap: see `shaders/pass/decide_remap.wgsl`.
    #[derive(PartialEq, Eq)]
    pub struct RemapArguments {
        /// Passes over the tracer's cells.
        pub tracer_groups: [u32; 3],
        /// The sum over them.
        pub sum_groups: [u32; 3],
        /// A single workgroup.
        pub one_group: [u32; 3],
        /// Passes over the map's cells.
        pub map_groups: [u32; 3],
        /// Passes over the tracer's cells, two by two.
        pub quad_groups: [u32; 3],
    }
}

/// The buffers of a film's control.
pub struct Control {
    /// The control block.
    pub block: wgpu::Buffer,
    /// Arguments of a remap's dispatches.
    pub arguments: wgpu::Buffer,
    /// Sums of workgroups on their way to one.
    pub partial_sums: wgpu::Buffer,
    /// Correction of what is shown.
    pub shown_balance: UniformBuffer<BalanceBlock>,
    /// Correction of what a remap sampled.
    pub tracer_balance: UniformBuffer<BalanceBlock>,
}

impl Control {
    pub(in crate::gpu) fn new(gpu: &Gpu) -> Self {
        use wgpu::BufferUsages as Usage;
        let storage = Usage::STORAGE | Usage::COPY_DST | Usage::COPY_SRC;
        let balance =
            |label| UniformBuffer::of(gpu.buffer(label, size_of::<BalanceBlock>() as u64, storage | Usage::UNIFORM));
        Self {
            block: gpu.buffer("control", size_of::<ControlBlock>() as u64, storage),
            arguments: gpu.buffer("remap arguments", size_of::<RemapArguments>() as u64, storage | Usage::INDIRECT),
            partial_sums: gpu.buffer("partial sums", 256 * 4, storage),
            shown_balance: balance("shown balance"),
            tracer_balance: balance("tracer balance"),
        }
    }

    /// Forgets everything; what is shown stands on a level.
    pub(in crate::gpu) fn reset(&self, gpu: &Gpu, level: f32) {
        gpu.upload(&self.block, &[ControlBlock::zeroed()]);
        gpu.upload(&self.tracer_balance, &[BalanceBlock::zeroed()]);
        gpu.upload(&self.shown_balance, &[BalanceBlock { level, ..BalanceBlock::zeroed() }]);
    }

    /// A pass over the tracer's texels, if a remap is due.
    pub(in crate::gpu) fn tracer_groups(&self) -> Groups<'_> {
        Groups::From(&self.arguments, offset_of!(RemapArguments, tracer_groups) as u64)
    }

    /// The sum over the tracer's cells, if a remap is due.
    pub(in crate::gpu) fn sum_groups(&self) -> Groups<'_> {
        Groups::From(&self.arguments, offset_of!(RemapArguments, sum_groups) as u64)
    }

    /// A pass over the map's texels, if a remap is due.
    pub(in crate::gpu) fn map_groups(&self) -> Groups<'_> {
        Groups::From(&self.arguments, offset_of!(RemapArguments, map_groups) as u64)
    }

    /// A pass over the tracer's texels, two by two, if a remap is due.
    pub(in crate::gpu) fn quad_groups(&self) -> Groups<'_> {
        Groups::From(&self.arguments, offset_of!(RemapArguments, quad_groups) as u64)
    }

    /// A single workgroup, if a remap is due.
    pub(in crate::gpu) fn one_group(&self) -> Groups<'_> {
        Groups::From(&self.arguments, offset_of!(RemapArguments, one_group) as u64)
    }
}
