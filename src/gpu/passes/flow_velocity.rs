//! Finds the velocity of a stream function.

use super::flow_measure::FlowUniform;
use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels};

kernels! {
    pass flow_velocity;

    /// The velocity now, and half a step ahead, extrapolated from the velocity one step ago.
    struct FlowVelocity {
        @0 flow: Uniform<FlowUniform>;
        @1 tangents: Read<[f32]>;
        @2 psi: Read<[f32]>;
        @3 psi_before: Read<[f32]>;
        @4 velocity: ReadWrite<[[f32; 4]]>;
        @5 velocity_ahead: ReadWrite<[[f32; 4]]>;
    }
    compute flow_velocity;
}
