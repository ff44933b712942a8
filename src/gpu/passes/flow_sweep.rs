//! Sweeps over the finest grid after a correction.

use super::flow_residual::SolveUniform;
use crate::{
    gpu::kernel::{Read, ReadWrite, Uniform, kernels},
    physics::flow::SWEEPS,
};

// The sweeps are numbered below.
const _: () = assert!(SWEEPS == 3);

kernels! {
    pass flow_sweep;

    /// One of the sweeps, which are told by their number.
    struct FlowSweep {
        override SWEEP: u32 in [0, 1, 2];
        @0 solve: Uniform<SolveUniform>;
        @1 tangents: Read<[f32]>;
        @2 source: Read<[f32]>;
        @3 psi: Read<[f32]>;
        @4 psi_after: ReadWrite<[f32]>;
    }
    compute flow_sweep;
}
