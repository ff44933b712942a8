//! Half a step of what drives the flow: weight, drag, and what stirs it besides.

use super::{
    flow_measure::{FlowMeasures, FlowUniform},
    flow_residual::MAX_FILMS,
};
use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct};

shader_struct! {
    /// What acts on one film: see `shaders/flow/step.wgsl`.
    pub struct FilmForces {
        /// Gravity over the radius, 1/s².
        pub gravity: [f32; 3],
        /// Drag that is the same everywhere, 1/s.
        pub drag: f32,
        /// Drag of air over the root of the speed, times the thickness, nm/√s.
        pub air_drag: f32,
        /// Fills 32 bytes.
        pub padding: [u32; 3],
    }
}

kernels! {
    pass flow_force;

    /// What half a step of drag leaves of vorticity with what half a step of the forces adds, and the part that is left.
    struct FlowForce {
        @0 flow: Uniform<FlowUniform>;
        @1 tangents: Read<[f32]>;
        @2 measures: Read<[FlowMeasures]>;
        @3 zeta: Read<[f32]>;
        @4 log_thickness: Read<[f32]>;
        @5 velocity: Read<[[f32; 4]]>;
        @6 forcing: Read<[f32]>;
        @7 pushed: ReadWrite<[[f32; 2]]>;
        @8 decay: ReadWrite<[f32]>;
        @9 forces: Uniform<[FilmForces; MAX_FILMS]>;
    }
    compute flow_force;
}
