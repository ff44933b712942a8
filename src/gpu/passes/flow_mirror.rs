//! Puts the image of vorticity beyond the rim that a film ends at.

use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct};

shader_struct! {
    /// The rim: see `shaders/pass/flow_mirror.wgsl`.
    pub struct MirrorUniform {
        /// Height of the rim.
        pub rim_z: f32,
        /// The inversion in it.
        pub inversion: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Fills 16 bytes.
        pub padding: u32,
    }
}

kernels! {
    pass flow_mirror;

    /// Vorticity within the rim, and its image beyond.
    struct FlowMirror {
        @0 mirror: Uniform<MirrorUniform>;
        @1 tangents: Read<[f32]>;
        @2 zeta: Read<[f32]>;
        @3 with_mirror: ReadWrite<[f32]>;
    }
    compute flow_mirror;
}
