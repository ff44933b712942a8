//! A bubble, ring by ring.

use super::{
    backdrop::{LampOverrides, LampUniform, LightUniform, MAX_LAMPS, ViewUniform},
    bake_table::{TableAxes, TableOverrides},
    open_hole::RimValue,
};
use crate::{
    gpu::{
        control::BalanceBlock,
        kernel::{
            Matrix, PointSampler, Read, Sampler, Texture2d, Texture2dArray, TextureCube, Uint2d, Uint2dArray, Uniform,
            kernels, overrides, shader_struct,
        },
        quadrature::{MAX_WAVELENGTHS, QuadratureOverrides, QuadratureSample},
    },
    physics::{film::HOLE_MERIDIANS, transport::Scheme},
};

shader_struct! {
    /// One ring of a bubble: see `shaders/pass/bubble.wgsl`.
    pub struct BubbleUniform {
        /// From the eye to the center: the difference of two places in f64, so that a scene looks the same wherever it stands.
        pub to_center_m: [f32; 3],
        /// Radius.
        pub radius_m: f32,
        /// Inner edge of the ring: cos and sin of the angle to the direction of the center.
        pub inner: [f32; 2],
        /// Outer edge.
        pub outer: [f32; 2],
        /// Thickness of a uniform film, in nm.
        pub thickness_nm: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Cells along a panel's edge of its tracer.
        pub tracer_cells: u32,
        /// What has evaporated, in nm.
        pub evaporated_nm: f32,
        /// Takes directions of the world to the film.
        pub to_film: Matrix,
        /// Takes the unit sphere to the bubble's wall, over the radius.
        pub stretch: Matrix,
        /// The inverse.
        pub unstretch: Matrix,
        /// Thickness at which evaporation ends, in nm.
        pub black_nm: f32,
        /// What the film's skins add to its thickness, in nm.
        pub extra_nm: f32,
        /// Thickness of both skins, in nm; above 0.
        pub skins_nm: f32,
        /// Cells along a panel's edge of the film's map.
        pub map_cells: u32,
        /// Height of the ring that the film ends at, over the radius.
        pub rim_z: f32,
        /// How much thicker the bubble is than the film shows.
        pub thickness_factor: f32,
        /// Sides of the polygons around the ring's edges.
        pub sides: u32,
        /// Radius of the circle of confusion, in pixels.
        pub confusion_pixels: f32,
    }
}

shader_struct! {
    /// A bubble's part of the lists of others: see `shaders/pass/bubble.wgsl`.
    pub struct ListPart {
        /// The first.
        pub first_other: u32,
        /// How many whose walls lie between its own.
        pub among: u32,
        /// How many with those that it mirrors only.
        pub mirrored: u32,
    }
}

shader_struct! {
    /// A bubble as others show it: see `shaders/sphere/others.wgsl`.
    pub struct OtherBubble {
        /// From the eye to the center.
        pub to_center_m: [f32; 3],
        /// Radius.
        pub radius_m: f32,
        /// Takes directions of the world to the film.
        pub to_film: Matrix,
        /// Where its film lies in the texture of all films, in texels.
        pub origin: [u32; 2],
        /// Cells along a panel's edge; 0 for a film of one thickness.
        pub cells: u32,
        /// Thickness of a film of one thickness, in nm.
        pub thickness_nm: f32,
        /// What has evaporated, in nm.
        pub evaporated_nm: f32,
        /// Thickness at which evaporation ends, in nm.
        pub black_nm: f32,
        /// What skins add to the film's thickness, in nm.
        pub extra_nm: f32,
        /// Thickness of both skins, in nm; above 0.
        pub skins_nm: f32,
        /// Height of the ring that the film ends at, over the radius.
        pub rim_z: f32,
        /// How much thicker the bubble is than the film shows.
        pub thickness_factor: f32,
        /// Radius of its circle of confusion, in pixels; 0 if it is in focus.
        pub confusion_pixels: f32,
        /// Fills 16 bytes.
        pub padding: f32,
    }
}

overrides! {
    /// The constants that distinguish rings. A film in a scene is moved as a flow map where it is looked up through one, and always limited.
    pub struct RingOverrides {
        const HOLE_MERIDIANS: u32 = HOLE_MERIDIANS as u32;
        const TAPS: u32 = Scheme::Map.taps();
        const LIMITER: bool = true;
        /// Whether the film has one thickness everywhere.
        override UNIFORM_FILM: bool;
        /// Whether the film is looked up through its flow map.
        override MAGNIFIED: bool;
        /// Samples along each side of a pixel, or in all where they stand in a line.
        override SAMPLES: u32 in [1, 4, 8];
        /// Whether the samples stand in a line.
        override IN_LINE: bool;
        /// Whether the samples fill a circle of confusion.
        override OUT_OF_FOCUS: bool;
        /// Samples along each side of a pixel that is unlike its neighbours; 0 if all have one.
        override REFINED_SAMPLES: u32 in [0, 2];
        /// Lookups of the surroundings in a reflection, at most.
        override ENVIRONMENT_TAPS: u32 in [1, 4];
        /// Whether the bubble's outline crosses the ring.
        override OUTLINE: bool;
        /// Thicknesses that each sample is the mean of: several where the film is finer than pixels.
        override THICKNESSES: u32 in [1, 2, 4];
        /// Whether the bubble is an ellipsoid.
        override STRETCHED: bool;
        /// Whether the bubble bursts.
        override BURST: bool;
        /// Whether the linear picture is made in full precision.
        override FULL_PRECISION: bool;
        /// Whether the environment is seen behind the bubbles.
        override BACKDROP_IS_ENVIRONMENT: bool;
        /// Whether the bubble sits on a bath.
        override ON_BATH: bool;
        /// Whether the film has skins.
        override SKINS: bool;
        /// Whether the film ends at a ring.
        override ON_RING: bool;
        /// Whether the eye is inside the bubble.
        override INSIDE: bool;
        /// Whether other bubbles may be behind the bubble.
        override OVER_OTHERS: bool;
        /// Whether walls of others lie between its own.
        override AMONG_OTHERS: bool;
        /// Whether it mirrors others.
        override MIRRORS_OTHERS: bool;
        /// Whether what it mirrors of others shows the walls opposite to those that mirror.
        override OPPOSITE_WALLS: bool;
        /// Whether the picture keeps what is polarised of it, for bubbles in front.
        override TRACKS_POLARISATION: bool;
        /// Inner reflections whose films are looked up.
        override INNER: u32 in [1, 3, 7, 11];
    }
}

kernels! {
    pass bubble;

    /// What is seen of the film.
    struct Shade {
        overrides shape: RingOverrides;
        overrides table_kind: TableOverrides;
        overrides summed: QuadratureOverrides;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 environment: TextureCube;
        @3 environment_sampler: Sampler;
        @4 bubble: Uniform<BubbleUniform>;
        @5 axes: Uniform<TableAxes>;
        @6 table: Uint2dArray;
        @7 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
        @8 film: Texture2dArray;
        @9 quadrature: Uniform<[QuadratureSample; MAX_WAVELENGTHS]>;
        @10 film_balance: Uniform<BalanceBlock>;
        @11 film_map: Texture2dArray;
        @12 film_tracer: Texture2dArray;
        @13 hole_middle: Read<[f32; 4]>;
        @14 hole_rim: Read<[RimValue]>;
        @15 picture_behind: Texture2d;
        @16 picture_so_far: Texture2d;
        @17 others: Read<[OtherBubble]>;
        @18 lists: Read<[u32]>;
        @19 films: Texture2dArray;
        @20 part: Read<ListPart>;
        @21 backdrop_map: TextureCube;
        @22 backdrop_sampler: Sampler;
        @23 polarised_behind: Uint2d;
        @24 point_sampler: PointSampler;
    }
    draw ring, everywhere as shade;

    /// A mirror in the bubble's place, which reads no film: the yardstick for what a frame costs.
    struct ShadeMirror {
        overrides shape: RingOverrides;
        overrides table_kind: TableOverrides;
        overrides summed: QuadratureOverrides;
        overrides lit: LampOverrides;
        @0 view: Uniform<ViewUniform>;
        @1 light: Uniform<LightUniform>;
        @2 environment: TextureCube;
        @3 environment_sampler: Sampler;
        @4 bubble: Uniform<BubbleUniform>;
        @7 lamps: Uniform<[LampUniform; MAX_LAMPS]>;
        @15 picture_behind: Texture2d;
        @16 picture_so_far: Texture2d;
        @21 backdrop_map: TextureCube;
        @22 backdrop_sampler: Sampler;
    }
    draw ring, everywhere as shade_mirror;
}

impl<'a> ShadeMirror<'a> {
    /// The mirror that stands where a bubble would.
    pub fn in_place_of(shade: &Shade<'a>) -> Self {
        let Shade { shape, table_kind, summed, lit, view, light, environment, environment_sampler, bubble, .. } =
            *shade;
        let Shade { picture_behind, picture_so_far, backdrop_map, backdrop_sampler, lamps, .. } = *shade;
        Self {
            shape,
            table_kind,
            summed,
            lit,
            view,
            light,
            environment,
            environment_sampler,
            bubble,
            picture_behind,
            picture_so_far,
            backdrop_map,
            backdrop_sampler,
            lamps,
        }
    }
}
