//! Traces one step of a film's motion back in a solved flow.

use crate::gpu::kernel::{Read, Rgba32Float, Uniform, Written2dArray, kernels, shader_struct};

shader_struct! {
    /// A step: see `shaders/pass/trace_flow.wgsl`.
    pub struct SolvedUniform {
        /// Length of the step in seconds.
        pub dt_s: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Which of the films that flow together.
        pub film: u32,
        /// Fills 16 bytes.
        pub padding: u32,
    }
}

kernels! {
    pass trace_flow;

    /// From each cell to where its liquid was, in a velocity on the same grid.
    struct TraceFlow {
        @0 solved: Uniform<SolvedUniform>;
        @1 tangents: Read<[f32]>;
        @2 velocity: Read<[[f32; 4]]>;
        @3 step_map: Written2dArray<Rgba32Float>;
    }
    compute trace_flow;
}
