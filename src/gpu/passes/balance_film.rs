//! Puts what was sampled of a film into a texture.

use crate::gpu::{
    control::BalanceBlock,
    kernel::{R32Float, Read, Uniform, Written2dArray, kernels},
};

kernels! {
    pass balance_film;

    /// What was sampled, with its liquid restored by a correction.
    struct BalanceFilm {
        @0 balance: Uniform<BalanceBlock>;
        @1 sampled: Read<[f32]>;
        @2 film: Written2dArray<R32Float>;
    }
    compute balance_film;
}
