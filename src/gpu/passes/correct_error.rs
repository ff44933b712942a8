//! The middle of back and forth error compensation.

use crate::gpu::kernel::{Read, ReadWrite, kernels};

kernels! {
    pass correct_error;

    /// Subtracts half of what a tracer lost on the way there and back, before the final step.
    struct CorrectError {
        @0 tracer: Read<[f32]>;
        @1 returned: Read<[f32]>;
        @2 corrected: ReadWrite<[f32]>;
    }
    compute correct_error;
}
