//! The page's worker: the same program with a memory of its own, to which work is sent, and from which products come back.

use std::{cell::RefCell, collections::VecDeque, io};

use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use web_sys::{MessageEvent, Worker};

use super::spawn;
use crate::plan::{Product, Work};

type Answer = Box<dyn FnOnce(Product)>;

#[derive(Default)]
struct Page {
    worker: Option<Worker>,
    /// What the worker has been asked for and has not answered yet: it answers in order.
    asked: VecDeque<(Work, Answer)>,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

/// Takes a worker into service, which answers each message by [`done`].
pub fn employ(worker: Worker) {
    let answered = Closure::<dyn Fn(MessageEvent)>::new(|event: MessageEvent| {
        let next = PAGE.with_borrow_mut(|page| page.asked.pop_front());
        let Some((work, answer)) = next else { return };
        let bytes = js_sys::Uint8Array::new(&event.data()).to_vec();
        // What cannot be read is done again.
        answer(postcard::from_bytes(&bytes).unwrap_or_else(|_| work.done()));
    });
    let failed = Closure::<dyn Fn(JsValue)>::new(|_| dismiss());
    worker.set_onmessage(Some(answered.as_ref().unchecked_ref()));
    worker.set_onerror(Some(failed.as_ref().unchecked_ref()));
    // They live as long as the page.
    answered.forget();
    failed.forget();
    PAGE.with_borrow_mut(|page| page.worker = Some(worker));
}

/// Does without the worker, because it failed: the page itself does what it was asked for.
fn dismiss() {
    log::warn!("the worker has failed: the page does its work itself");
    let asked = PAGE.with_borrow_mut(|page| {
        page.worker = None;
        std::mem::take(&mut page.asked)
    });
    asked.into_iter().for_each(|(work, answer)| answer(work.done()));
}

/// Asks for a product.
pub fn ask(work: Work, answer: Answer) -> io::Result<()> {
    let Some(worker) = PAGE.with_borrow(|page| page.worker.clone()) else {
        return spawn(move || answer(work.done()));
    };
    let refused = |reason: JsValue| io::Error::other(format!("{reason:?}"));
    let bytes = postcard::to_allocvec(&work).map_err(io::Error::other)?;
    let bytes = js_sys::Uint8Array::from(bytes.as_slice());
    worker.post_message_with_transfer(&bytes, &js_sys::Array::of1(&bytes.buffer())).map_err(refused)?;
    PAGE.with_borrow_mut(|page| page.asked.push_back((work, answer)));
    Ok(())
}

/// In the worker: the product that a message asks for.
pub fn done(message: &[u8]) -> Result<Vec<u8>, postcard::Error> {
    let work: Work = postcard::from_bytes(message)?;
    postcard::to_allocvec(&work.done())
}
