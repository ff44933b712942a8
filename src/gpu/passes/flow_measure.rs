//! Measures what a step of the flow starts from: means over the film, and the fastest flow.

use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct};

shader_struct! {
    /// One step, for all of its passes and films: see `shaders/flow/step.wgsl`.
    pub struct FlowUniform {
        /// Length of the step, seconds.
        pub dt_s: f32,
        /// Slowest speed that the drag of air is reckoned with, rad/s.
        pub min_air_speed: f32,
        /// Angle of a cell, radians.
        pub cell_angle: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
    }
}

shader_struct! {
    /// What was measured of a whole film at the start of the last step: see `shaders/flow/step.wgsl`.
    #[derive(Default, PartialEq)]
    pub struct FlowMeasures {
        /// Mean vorticity, which the step took away, 1/s.
        pub zeta_mean: f32,
        /// Mean of the first guess of the stream function.
        pub guess_mean: f32,
        /// Fastest flow, rad/s.
        pub max_speed: f32,
        /// Values of vorticity, stream function and ln h that could not be used since the film was seeded: not finite, or beyond 1e6.
        /// Zeros stood in for them.
        pub invalid: u32,
    }
}

kernels! {
    pass flow_measure;

    /// Measures vorticity, stream function and speed, and replaces what cannot be used.
    struct FlowMeasure {
        @0 flow: Uniform<FlowUniform>;
        @1 tangents: Read<[f32]>;
        @2 zeta: Read<[f32]>;
        @3 psi: Read<[f32]>;
        @4 psi_before: Read<[f32]>;
        @5 log_thickness: Read<[f32]>;
        @6 velocity: Read<[[f32; 4]]>;
        @7 measures: ReadWrite<[FlowMeasures]>;
    }
    compute flow_measure;
}
