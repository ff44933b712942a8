//! What is left of a linear system's right side, on the grid below the finest.

use crate::{
    gpu::kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    physics::flow::SWEEPS,
};

/// Films that one dispatch can step at most.
pub const MAX_FILMS: usize = 64;

shader_struct! {
    /// The linear system of one film: see `shaders/flow/solve.wgsl`.
    pub struct FilmSystem {
        /// Weights of the sweeps after a correction.
        pub weights: [f32; SWEEPS],
        /// k.
        pub shift: f32,
        /// f over the source that it is read from.
        pub gain: f32,
        /// Fills 32 bytes.
        pub padding: [u32; 3],
    }
}

shader_struct! {
    /// One solution on the finest grid, for all of its passes: see `shaders/flow/solve.wgsl`.
    pub struct SolveUniform {
        /// 1 over the square of the cell angle, 1/rad².
        pub per_angle2: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Cells along a panel's edge of the next grid.
        pub coarse_cells: u32,
        /// Where the corrections of the next grid start.
        pub coarse_field: u32,
        /// The system of each film.
        pub systems: [FilmSystem; MAX_FILMS],
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
