//! The middle of back and forth error compensation.

use crate::gpu::kernel::{Read, ReadWrite, kernels};

kernels! {
    pass correct_error;

    /// Takes half of what a tracer lost on the way forth and back off before the step is made for good.
    struct CorrectError {
        @0 tracer: Read<[f32]>;
        @1 returned: Read<[f32]>;
        @2 corrected: ReadWrite<[f32]>;
    }
    compute correct_error;
}
