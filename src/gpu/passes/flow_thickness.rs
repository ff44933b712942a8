//! Tells the flow the logarithm of the film's thickness.

use crate::gpu::{
    control::ControlBlock,
    kernel::{PointSampler, Read, ReadWrite, Texture2dArray, Uniform, kernels, shader_struct},
};

shader_struct! {
    /// Grids and thicknesses: see `shaders/pass/flow_thickness.wgsl`.
    pub struct ThicknessUniform {
        /// Cells along a panel's edge of the flow.
        pub cells: u32,
        /// Cells along a panel's edge of the map.
        pub map_cells: u32,
        /// Cells along a panel's edge of the tracer.
        pub tracer_cells: u32,
        /// Thickness that the logarithm is relative to, nm.
        pub reference_nm: f32,
        /// Added to the tracer for the thickness less the reference, nm.
        pub offset_nm: f32,
        /// What the tracer departs from, less the reference, nm.
        pub level_nm: f32,
        /// Thickness at which evaporation ends, less the reference, nm.
        pub black_nm: f32,
        /// Height of the rim that the film ends at.
        pub rim_z: f32,
        /// The inversion in it.
        pub inversion: f32,
        /// Which of the films that flow together.
        pub film: u32,
    }
}

kernels! {
    pass flow_thickness;

    /// Looks the tracer up through the map, cubic and limited: a thickness must stay positive, and the flow's cells are too wide for more.
    struct FlowThickness {
        const TAPS: u32 = 4;
        const LIMITER: bool = true;
        override HAS_MAP: bool;
        override HAS_RIM: bool;
        @0 thickness: Uniform<ThicknessUniform>;
        @1 tangents: Read<[f32]>;
        @2 control: ReadWrite<ControlBlock>;
        @3 map: Texture2dArray;
        @4 tracer: Texture2dArray;
        @5 log_thickness: ReadWrite<[f32]>;
        @6 point_sampler: PointSampler;
    }
    compute flow_thickness;
}
