//! The middle of back and forth error compensation.

use crate::gpu::kernel::{R32Float, Read, Texture2dArray, Written2dArray, kernels};

kernels! {
    pass correct_error;

    /// Subtracts half of what a tracer lost on the way there and back, before the final step.
    struct CorrectError {
        @0 tracer: Texture2dArray;
        @1 returned: Read<[f32]>;
        @2 corrected: Written2dArray<R32Float>;
    }
    compute correct_error;
}
