//! Carries fields on the flow's grid along its velocity.

use super::flow_measure::FlowUniform;
use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels};

kernels! {
    pass flow_trace;

    /// Carries vorticity, and adds the other half of the forces, for each of the two viscous stages.
    struct TraceVorticity {
        @0 flow: Uniform<FlowUniform>;
        @1 tangents: Read<[f32]>;
        @2 velocity: Read<[[f32; 4]]>;
        @3 pushed: Read<[[f32; 2]]>;
        @4 decay: Read<[f32]>;
        @5 first_stage: ReadWrite<[f32]>;
        @6 second_stage: ReadWrite<[f32]>;
    }
    compute trace_vorticity;

    /// Carries a field alone.
    struct TraceTracer {
        @0 flow: Uniform<FlowUniform>;
        @1 tangents: Read<[f32]>;
        @2 velocity: Read<[[f32; 4]]>;
        @3 field: Read<[f32]>;
        @4 moved: ReadWrite<[f32]>;
    }
    compute trace_tracer;
}
