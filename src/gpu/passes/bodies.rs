//! What films end at: wires and drops.

use super::backdrop::{LampOverrides, LampUniform, LightUniform, MAX_LAMPS, ViewUniform};
use crate::gpu::kernel::{Read, Sampler, Texture2d, TextureCube, Uniform, kernels, shader_struct};

/// Straight pieces that a wire is drawn in.
pub const WIRE_SIDES: u32 = 192;

shader_struct! {
    /// See `shaders/pass/bodies.wgsl`.
    pub struct BodyUniform {
        /// From the eye to the bubble's center.
        pub to_center_m: [f32; 3],
        /// Radius of the rim.
        pub rim_m: f32,
        /// From the eye to the middle of the rim.
        pub to_rim_m: [f32; 3],
        /// Radius of the wire.
        pub wire_m: f32,
    }
}

kernels! {
    pass bodies;

    /// A wire.
    struct Wire {
        const WIRE_SIDES: u32 = WIRE_SIDES;
        override IS_FAR: bool;
        override FULL_PRECISION: bool;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 environment: TextureCube;
        @3 environment_sampler: Sampler;
        @4 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
        @5 body: Read<BodyUniform>;
        @6 picture_behind: Texture2d;
    }
    draw ribbon as wire;

    /// A drop of water.
    struct WaterDrop {
        override IS_FAR: bool;
        override FULL_PRECISION: bool;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 environment: TextureCube;
        @3 environment_sampler: Sampler;
        @4 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
        @5 body: Read<BodyUniform>;
        @6 picture_behind: Texture2d;
    }
    draw around_drop as drop;
}
