//! One multigrid cycle on all grids below the finest, by one workgroup for each film.

use crate::{
    gpu::kernel::{Read, ReadWrite, kernels, shader_struct},
    physics::{
        flow::{MAX_COARSEST_SWEEPS, SWEEPS},
        sphere::HaloEntry,
    },
};

/// Grids that there is room for: enough for 8 · 2¹¹ cells per edge.
pub const MAX_LEVELS: usize = 12;

shader_struct! {
    /// A grid: see `shaders/pass/flow_coarse.wgsl`.
    #[derive(Default)]
    pub struct CoarseLevel {
        /// Weights of the sweeps after a correction.
        pub weights: [f32; SWEEPS],
        /// 1 over the square of the cell angle, 1/rad².
        pub per_angle2: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Where its values start.
        pub field: u32,
        /// Where its tangents start.
        pub tangent: u32,
        /// Where its halo entries start.
        pub halo: u32,
    }
}

shader_struct! {
    /// All grids, for one film: see `shaders/pass/flow_coarse.wgsl`.
    pub struct CoarseSystem {
        /// How many.
        pub levels: u32,
        /// Values of all films on all grids.
        pub values: u32,
        /// k.
        pub shift: f32,
        /// Sweeps on the coarsest.
        pub sweeps: u32,
        /// The finest first.
        pub level: [CoarseLevel; MAX_LEVELS],
        /// Weights of the sweeps on the coarsest.
        pub coarsest: [f32; MAX_COARSEST_SWEEPS],
    }
}

kernels! {
    pass flow_coarse;

    /// Corrections of all coarse grids.
    struct FlowCoarse {
        @0 coarse: Read<[CoarseSystem]>;
        @1 tangents: Read<[f32]>;
        @2 entries: Read<[HaloEntry]>;
        @3 f: ReadWrite<[f32]>;
        @4 e: ReadWrite<[f32]>;
    }
    compute flow_coarse;
}
