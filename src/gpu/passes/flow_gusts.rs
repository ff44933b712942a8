//! Lets moving air stir the film.

use crate::{
    gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    physics::film::{FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES},
};

shader_struct! {
    /// The air at one moment: see `shaders/pass/flow_gusts.wgsl`.
    pub struct GustsUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Waves in use.
        pub waves_count: u32,
        /// Vortices in use.
        pub vortices_count: u32,
        /// Rate at which the air drags the film along, 1/s.
        pub rate: f32,
        /// Which of the films that flow together.
        pub film: u32,
        /// Fills 32 bytes.
        pub padding: [u32; 3],
        /// Waves; those in use come first.
        pub waves: [FrozenWave; MAX_WAVES],
        /// Vortices; those in use come first.
        pub vortices: [FrozenVortex; MAX_VORTICES],
    }
}

kernels! {
    pass flow_gusts;

    /// The source of vorticity that the air is.
    struct FlowGusts {
        @0 gusts: Uniform<GustsUniform>;
        @1 tangents: Read<[f32]>;
        @2 forcing: ReadWrite<[f32]>;
    }
    compute flow_gusts;
}
