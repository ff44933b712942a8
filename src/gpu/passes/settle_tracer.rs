//! The end of a remap.

use crate::gpu::{
    control::BalanceBlock,
    kernel::{Read, ReadWrite, Uniform, kernels},
};

kernels! {
    pass settle_tracer;

    /// Makes what a remap sampled the tracer, with its liquid restored.
    struct SettleTracer {
        @0 balance: Uniform<BalanceBlock>;
        @1 sampled: Read<[f32]>;
        @2 tracer: ReadWrite<[f32]>;
    }
    compute settle_tracer;
}
