//! What is left of a linear system's right side, on the grid below the finest.

use crate::{
    gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    physics::flow::SWEEPS,
};

shader_struct! {
    /// One solution on the finest grid, for all of its passes: see `shaders/flow/solve.wgsl`.
    pub struct SolveUniform {
        /// Weights of the sweeps after a correction.
        pub weights: [f32; SWEEPS],
        /// k.
        pub shift: f32,
        /// f over the source that it is read from.
        pub gain: f32,
        /// Angle of a cell, radians.
        pub cell_angle: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Cells along a panel's edge of the next grid.
        pub coarse_cells: u32,
        /// Where the corrections of the next grid start.
        pub coarse_field: u32,
        /// Fills 48 bytes.
        pub padding: [u32; 3],
    }
}

kernels! {
    pass flow_residual;

    /// Finds it and restricts it.
    struct FlowResidual {
        @0 solve: Uniform<SolveUniform>;
        @1 tangents: Read<[f32]>;
        @2 source: Read<[f32]>;
        @3 psi: Read<[f32]>;
        @4 left: ReadWrite<[f32]>;
    }
    compute flow_residual;
}
