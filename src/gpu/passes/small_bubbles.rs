//! Small bubbles, all of one layer at once.

use super::{
    backdrop::{LampOverrides, LampUniform, LightUniform, MAX_LAMPS, ViewUniform},
    bake_table::{TableAxes, TableOverrides},
    bubble::OtherBubble,
};
use crate::gpu::kernel::{
    PointSampler, Read, Sampler, Texture2d, Texture2dArray, TextureCube, Uint2dArray, Uniform, kernels, shader_struct,
};

/// Side of a tile in pixels: bubbles are found by the tiles that they may cover.
pub const TILE: u32 = 16;

shader_struct! {
    /// The bubbles of a tile: see `shaders/pass/small_bubbles.wgsl`.
    pub struct SmallTile {
        /// The first in the list.
        pub first: u32,
        /// After the last.
        pub end: u32,
    }
}

kernels! {
    pass small_bubbles;

    /// What is seen of small bubbles, over the picture of what is behind them.
    struct SmallBubbles {
        const TILE: u32 = TILE;
        const ON_BATH: bool = false;
        const THICKNESSES: u32 = 1;
        const BACKDROP_IS_ENVIRONMENT: bool = false;
        override SAMPLES: u32 in [1, 4];
        override OUT_OF_FOCUS: bool;
        override FULL_PRECISION: bool;
        override THRICE: bool;
        override YARDSTICK: bool;
        overrides table_kind: TableOverrides;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 environment: TextureCube;
        @3 environment_sampler: Sampler;
        @4 axes: Uniform<TableAxes>;
        @5 table: Uint2dArray;
        @6 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
        @7 films: Texture2dArray;
        @8 bubbles: Read<[OtherBubble]>;
        @9 lists: Read<[u32]>;
        @10 tiles: Read<[SmallTile]>;
        @11 picture_behind: Texture2d;
        @12 point_sampler: PointSampler;
    }
    draw cover as small_bubbles;
}
