//! What stands behind the bubbles.

use crate::gpu::kernel::{Matrix, Sampler, TextureCube, Uniform, kernels, overrides, shader_struct};

shader_struct! {
    /// The camera: see `shaders/camera/view.wgsl`.
    pub struct ViewUniform {
        /// Line of sight.
        pub forward: [f32; 3],
        /// Height of a pixel on the plane one metre before the eye.
        pub pixel_height: f32,
        /// Right of the picture.
        pub right: [f32; 3],
        /// Picture width in pixels.
        pub width: f32,
        /// Top of the picture.
        pub up: [f32; 3],
        /// Picture height in pixels.
        pub height: f32,
        /// Where the line of sight meets the picture, in pixels.
        pub axis: [f32; 2],
        /// Fills 16 bytes.
        pub padding: [f32; 2],
    }
}

shader_struct! {
    /// The light: see `shaders/light/environment.wgsl`.
    pub struct LightUniform {
        /// Factor on the environment's radiance.
        pub gain: [f32; 3],
        /// Angle between texels of its finest level.
        pub texel_angle: f32,
        /// Radiance of the backdrop where it is a colour.
        pub backdrop: [f32; 3],
        /// Angle between texels of the backdrop's finest level.
        pub backdrop_texel_angle: f32,
        /// Factor that makes daylight's white (1, 1, 1), exposed as the linear picture is.
        pub scale: [f32; 3],
        /// Cosine of the environment's turn.
        pub turn_cos: f32,
        /// Direction that a polariser lets pass.
        pub polariser: [f32; 3],
        /// Sine of the environment's turn.
        pub turn_sin: f32,
        /// Matrix from light to its colour, exposed like the linear picture.
        pub seen: Matrix,
        /// The inverse.
        pub unseen: Matrix,
        /// Tangent of the half angle of the cones that the backdrop is spread over.
        pub defocus: f32,
        /// Fills 16 bytes.
        pub padding: [f32; 3],
    }
}

shader_struct! {
    /// A lamp: see `shaders/light/lamps.wgsl`.
    pub struct LampUniform {
        /// Direction of its middle.
        pub towards: [f32; 3],
        /// Half the width of its soft edge.
        pub edge: f32,
        /// Along its width.
        pub right: [f32; 3],
        /// Radius of its corners.
        pub corner: f32,
        /// Along its height.
        pub up: [f32; 3],
        /// Its area.
        pub area: f32,
        /// Radiance.
        pub radiance: [f32; 3],
        /// Fills 16 bytes.
        pub padding: f32,
        /// Half of its width and height.
        pub half_size: [f32; 2],
        /// Fills 16 bytes.
        pub padding_after: [f32; 2],
    }
}

/// Room for lamps: the length of `array<Lamp, ...>` in passes. A scene has 8 at most, and an environment some of its own.
pub const MAX_LAMPS: usize = 12;

overrides! {
    /// The lamps of a light.
    pub struct LampOverrides {
        /// How many there are.
        override LAMPS: u32 in [0, 1, 3];
    }
}

kernels! {
    pass backdrop;

    /// The environment or a colour, at each pixel.
    struct Backdrop {
        override ON_BATH: bool;
        override FULL_PRECISION: bool;
        override BACKDROP_IS_ENVIRONMENT: bool;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 backdrop_map: TextureCube;
        @3 backdrop_sampler: Sampler;
        @4 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
    }
    draw cover as backdrop;
}
