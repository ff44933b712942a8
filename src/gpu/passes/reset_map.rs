//! Makes a film's flow map the identity.

use crate::gpu::kernel::{Read, ReadWrite, kernels};

kernels! {
    pass reset_map;

    /// Each cell comes from where it is.
    struct ResetMap {
        @0 tangents: Read<[f32]>;
        @1 map: ReadWrite<[[f32; 4]]>;
    }
    compute reset_map;
}
