//! What is drawn at films: wires, feet, drops, rims of holes, and droplets.

use super::{
    backdrop::{LampOverrides, LampUniform, LightUniform, MAX_LAMPS, ViewUniform},
    open_hole::RimValue,
};
use crate::{
    gpu::kernel::{Matrix, Read, Sampler, Texture2d, TextureCube, Uniform, kernels, overrides, shader_struct},
    physics::film::HOLE_MERIDIANS,
};

/// Straight pieces that a wire is drawn in.
pub const WIRE_SIDES: u32 = 192;

shader_struct! {
    /// See `shaders/pass/bodies.wgsl`.
    pub struct BodyValue {
        /// From the eye to the bubble's center.
        pub to_center_m: [f32; 3],
        /// Radius of the rim.
        pub rim_m: f32,
        /// From the eye to the middle of the rim.
        pub to_rim_m: [f32; 3],
        /// Radius of the wire, or of the foot.
        pub wire_m: f32,
        /// Takes directions of the film to the world.
        pub to_world: Matrix,
        /// Radius of the bubble.
        pub radius_m: f32,
        /// Fills 16 bytes.
        pub padding: [f32; 3],
    }
}

shader_struct! {
    /// A droplet: see `shaders/pass/bodies.wgsl`.
    pub struct Droplet {
        /// The meridian of the hole on which it leaves the rim, as a turn.
        pub turn: f32,
        /// Angle from the hole's middle there, radians.
        pub leaves_rad: f32,
        /// Radius.
        pub radius_m: f32,
        /// How fast it flies over how fast the rim moves.
        pub speed: f32,
    }
}

overrides! {
    /// What all bodies have.
    pub struct BodyOverrides {
        const WIRE_SIDES: u32 = WIRE_SIDES;
        const HOLE_MERIDIANS: u32 = HOLE_MERIDIANS as u32;
        const BACKDROP_IS_ENVIRONMENT: bool = false;
        /// Whether what lies beyond the bubble's center is drawn, or the rest.
        override IS_FAR: bool;
        /// What is drawn: 0 a wire, 1 the foot of a bubble, 2 the rim of a hole, 3 a drop, 4 droplets.
        override KIND: u32 in [0, 1, 2, 3, 4];
        /// Whether there is a bath.
        override ON_BATH: bool;
        /// Whether the linear picture is made in full precision.
        override FULL_PRECISION: bool;
    }
}

kernels! {
    pass bodies;

    /// A body, or droplets, over what is behind.
    struct Bodies {
        overrides shape: BodyOverrides;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 environment: TextureCube;
        @3 environment_sampler: Sampler;
        @4 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
        @5 body: Read<BodyValue>;
        @6 picture_behind: Texture2d;
        @7 hole_middle: Read<[f32; 4]>;
        @8 hole_rim: Read<[RimValue]>;
        @9 droplets: Read<[Droplet]>;
    }
    draw corner as shade;
}
