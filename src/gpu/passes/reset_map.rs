//! Makes a film's flow map the identity.

use crate::gpu::kernel::{Read, Rgba32Float, Written2dArray, kernels};

kernels! {
    pass reset_map;

    /// Each cell comes from where it is.
    struct ResetMap {
        @0 tangents: Read<[f32]>;
        @1 map: Written2dArray<Rgba32Float>;
    }
    compute reset_map;
}
