//! Adds the correction of the coarse grids to the finest.

use super::flow_residual::SolveUniform;
use crate::gpu::kernel::{Read, ReadWrite, Uniform, kernels};

kernels! {
    pass flow_correct;

    /// Interpolates the correction and adds it.
    struct FlowCorrect {
        @0 solve: Uniform<SolveUniform>;
        @1 correction: Read<[f32]>;
        @2 psi: Read<[f32]>;
        @3 psi_after: ReadWrite<[f32]>;
    }
    compute flow_correct;
}
