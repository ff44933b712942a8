//! Holds a film fast in the drop at its bottom.

use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct};

shader_struct! {
    /// The drop: see `shaders/pass/flow_pin.wgsl`.
    pub struct PinUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Angle from the bottom at which the drop begins, radians.
        pub rim: f32,
        /// That within which nothing flows.
        pub inner: f32,
        /// Fills 16 bytes.
        pub padding: u32,
    }
}

kernels! {
    pass flow_pin;

    /// Stops what flows in the drop.
    struct FlowPin {
        @0 pin: Uniform<PinUniform>;
        @1 tangents: Read<[f32]>;
        @2 zeta: ReadWrite<[f32]>;
        @3 psi: ReadWrite<[f32]>;
    }
    compute flow_pin;
}
