//! Puts a film into the texture that pictures read.

use crate::gpu::{
    control::BalanceBlock,
    kernel::{R32Float, Read, Uniform, Written2dArray, kernels},
};

kernels! {
    pass show_film;

    /// What was sampled, with its liquid restored by a correction.
    struct ShowFilm {
        @0 balance: Uniform<BalanceBlock>;
        @1 sampled: Read<[f32]>;
        @2 film: Written2dArray<R32Float>;
    }
    compute show_film;
}
