//! Half a step of what drives the flow: weight, drag, and what stirs it besides.

use super::flow_measure::{FlowMeasures, FlowUniform};
use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels};

kernels! {
    pass flow_force;

    /// What half a step of drag leaves of vorticity with what half a step of the forces adds, and the part that is left.
    struct FlowForce {
        @0 flow: Uniform<FlowUniform>;
        @1 tangents: Read<[f32]>;
        @2 measures: Read<FlowMeasures>;
        @3 zeta: Read<[f32]>;
        @4 log_thickness: Read<[f32]>;
        @5 velocity: Read<[[f32; 4]]>;
        @6 forcing: Read<[f32]>;
        @7 pushed: ReadWrite<[[f32; 2]]>;
        @8 decay: ReadWrite<[f32]>;
    }
    compute flow_force;
}
