//! A fence around decoders that may panic.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Runs `decode` on this thread and turns a panic into `None`, without the panic's message.
///
/// Files come from anywhere, and decoders of foreign formats are known to panic (overflow, index out of bounds) on damaged
/// ones. For the user that is a damaged file like any other. `decode` must not hand work to other threads: a panic there is
/// out of reach.
pub(super) fn catch_panic<T>(decode: impl FnOnce() -> T) -> Option<T> {
    silence_guarded_panics();
    GUARDED.set(true);
    // Whatever `decode` leaves half done is dropped with it: nothing of it is seen again.
    let result = panic::catch_unwind(AssertUnwindSafe(decode));
    GUARDED.set(false);
    result.ok()
}

/// Wraps the panic hook, once, so that it says nothing about panics that [`catch_panic`] catches.
fn silence_guarded_panics() {
    static WRAPPED: Once = Once::new();
    WRAPPED.call_once(|| {
        let report = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !GUARDED.get() {
                report(panic);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn catch_panic_returns_none_for_a_panic_and_keeps_a_result() {
        assert_eq!(catch_panic(|| 7), Some(7));
        assert_eq!(catch_panic(|| -> i32 { panic!("odd file") }), None);
        assert!(!GUARDED.get());
    }
}
