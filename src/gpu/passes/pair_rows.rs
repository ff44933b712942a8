//! Stores a baked table as lookups read it.

use crate::gpu::kernel::{Rgba32Uint, Texture2dArray, Uniform, Written2dArray, kernels, shader_struct};

shader_struct! {
    /// Which rows: see `shaders/pass/pair_rows.wgsl`.
    pub struct PairUniform {
        /// Columns of the table.
        pub columns: u32,
        /// The first row that is stored.
        pub first_row: u32,
        /// The row after the last that is stored.
        pub end_row: u32,
        /// The table's last row, which has no next.
        pub last_row: u32,
    }
}

kernels! {
    pass pair_rows;

    /// Some rows of a table, each with the next.
    struct PairRows {
        @0 pair: Uniform<PairUniform>;
        @1 baked: Texture2dArray;
        @2 paired: Written2dArray<Rgba32Uint>;
    }
    compute pair_rows;
}
