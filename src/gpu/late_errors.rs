//! Errors that a driver reports later. Outside browsers an error scope answers at once; in a browser it is a promise, and its errors must
//! not be lost although nothing waits for it.

use std::{
    pin::Pin,
    sync::{Mutex, PoisonError},
    task::{Context, Poll, Waker},
};

use super::shaders::ShaderError;

/// What a compiler will say of a shader: none if all is well.
#[cfg(not(target_arch = "wasm32"))]
pub type Answer = Pin<Box<dyn Future<Output = Option<ShaderError>> + Send>>;
/// What a compiler will say of a shader: none if all is well.
#[cfg(target_arch = "wasm32")]
pub type Answer = Pin<Box<dyn Future<Output = Option<ShaderError>>>>;

/// Answers that are still to come.
#[derive(Default)]
pub struct LateErrors(Mutex<Vec<Answer>>);

impl LateErrors {
    /// The error of an answer that has arrived; if not, [`LateErrors::take`] will have it.
    pub fn ask(&self, mut answer: Answer) -> Option<ShaderError> {
        match poll(&mut answer) {
            Poll::Ready(error) => error,
            Poll::Pending => {
                self.0.lock().unwrap_or_else(PoisonError::into_inner).push(answer);
                None
            }
        }
    }

    /// The first error that has come since the last call. Those behind it stay.
    pub fn take(&self) -> Option<ShaderError> {
        let mut waiting = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut told = None;
        waiting.retain_mut(|answer| {
            if told.is_some() {
                return true;
            }
            let polled = poll(answer);
            let is_pending = polled.is_pending();
            if let Poll::Ready(error) = polled {
                told = error;
            }
            is_pending
        });
        told
    }
}

/// Nobody is woken: the next frame asks again.
fn poll(answer: &mut Answer) -> Poll<Option<ShaderError>> {
    answer.as_mut().poll(&mut Context::from_waker(Waker::noop()))
}

#[cfg(test)]
mod tests {
    use std::sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    };

    use super::*;

    fn error(message: &str) -> ShaderError {
        ShaderError { place: "pass/some.wgsl:3".to_owned(), message: message.to_owned() }
    }

    /// An answer that comes once the flag is set.
    fn later(flag: &Arc<AtomicBool>, error: Option<ShaderError>) -> Answer {
        let flag = flag.clone();
        Box::pin(std::future::poll_fn(move |_| {
            if flag.load(Ordering::Relaxed) { Poll::Ready(error.clone()) } else { Poll::Pending }
        }))
    }

    #[test]
    fn an_answer_that_is_there_is_told_at_once() {
        let errors = LateErrors::default();
        assert_eq!(errors.ask(Box::pin(async { None })), None);
        assert_eq!(errors.ask(Box::pin(async { Some(error("now")) })), Some(error("now")));
        assert_eq!(errors.take(), None);
    }

    #[test]
    fn errors_that_come_later_are_told_one_after_the_other() {
        let (errors, flag) = (LateErrors::default(), Arc::new(AtomicBool::new(false)));
        for answer in [None, Some(error("first")), Some(error("second"))] {
            assert_eq!(errors.ask(later(&flag, answer)), None);
        }
        assert_eq!(errors.take(), None);
        flag.store(true, Ordering::Relaxed);
        assert_eq!(errors.take(), Some(error("first")));
        assert_eq!(errors.take(), Some(error("second")));
        assert_eq!(errors.take(), None);
    }
}
