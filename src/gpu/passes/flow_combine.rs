//! Sums fields of the flow.

use super::flow_measure::FlowMeasures;
use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct};

shader_struct! {
    /// Factors of a sum: see `shaders/pass/flow_combine.wgsl`.
    pub struct CombineUniform {
        /// Factor of the first field.
        pub first: f32,
        /// Factor of the second field.
        pub second: f32,
        /// Factor of the third field.
        pub third: f32,
        /// Factor of the mean of the guess.
        pub mean: f32,
        /// Values of each film.
        pub values: u32,
    }
}

kernels! {
    pass flow_combine;

    /// The weighted sum of three fields and of the guess's mean, halos included.
    struct FlowCombine {
        @0 combine: Uniform<CombineUniform>;
        @1 measures: Read<[FlowMeasures]>;
        @2 first: Read<[f32]>;
        @3 second: Read<[f32]>;
        @4 third: Read<[f32]>;
        @5 combined: ReadWrite<[f32]>;
    }
    compute flow_combine;

    /// The weighted sum of three fields, and the plain one of the first two, halos included.
    struct FlowCombineAndSum {
        @0 combine: Uniform<CombineUniform>;
        @2 first: Read<[f32]>;
        @3 second: Read<[f32]>;
        @4 third: Read<[f32]>;
        @5 combined: ReadWrite<[f32]>;
        @6 sum: ReadWrite<[f32]>;
    }
    compute flow_combine_and_sum;
}
