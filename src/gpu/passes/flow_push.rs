//! Lets what pushes the film from outside stir it.

use crate::{
    gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct, shader_view},
    physics::film::FrozenPush,
};

/// Pushes that one dispatch takes.
pub const MAX_PUSHES: usize = 32;

shader_view! { FrozenPush { center, sharpness, velocity, rate } }

shader_struct! {
    /// Some pushes: see `shaders/pass/flow_push.wgsl`.
    pub struct PushesUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Pushes in use.
        pub count: u32,
        /// Which of the films that flow together.
        pub film: u32,
        /// Fills 16 bytes.
        pub padding: u32,
        /// Pushes; those in use come first.
        pub pushes: [FrozenPush; MAX_PUSHES],
    }
}

kernels! {
    pass flow_push;

    /// Adds their source of vorticity.
    struct FlowPush {
        @0 pushes: Uniform<PushesUniform>;
        @1 tangents: Read<[f32]>;
        @2 velocity: Read<[[f32; 4]]>;
        @3 zeta: Read<[f32]>;
        @4 forcing: ReadWrite<[f32]>;
    }
    compute flow_push;
}
