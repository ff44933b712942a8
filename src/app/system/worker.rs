//! The page's worker: the same program with a memory of its own, to which tasks are sent, and from which answers come back.

use std::{cell::RefCell, collections::VecDeque, io, sync::Arc};

use js_sys::Uint8Array;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use wasm_bindgen_futures::JsFuture;
use web_sys::{MessageEvent, Worker};

use super::spawn;
use crate::{
    input::{self, LightNamed, MadeEnvironment},
    physics::{
        bulk,
        environment::{CubeMap, CubeTiles},
    },
    plan::{DefocusKey, EnvironmentKey, Work},
};

/// What the worker is told.
#[derive(Serialize, Deserialize)]
pub enum Task {
    /// A file that scenes may name, and its bytes. The answer is empty.
    File(String, #[serde(with = "bulk")] Vec<u8>),
    /// The environment of a light is to be made: a [`MadeEnvironment`].
    Environment(LightNamed),
    /// Work is to be done: a [`Product`](crate::plan::Product).
    Work(Work),
    /// The environment that was made last, if it has this id, is to be put out of focus: a [`Product`](crate::plan::Product).
    Defocus(u64, f64, CubeTiles),
}

impl Task {
    /// Some work, without an environment that the worker has.
    pub fn of(work: &Work) -> Self {
        match work {
            Work::Defocus(key) if PAGE.with_borrow(|page| page.made == Some(key.environment.0.id())) => {
                Self::Defocus(key.environment.0.id(), key.half_angle_rad, key.tiles)
            }
            work => Self::Work(work.clone()),
        }
    }
}

/// What happens with the bytes of an answer, or where there is none.
type Answer = Box<dyn FnOnce(Option<Vec<u8>>)>;

#[derive(Default)]
struct Page {
    worker: Option<Worker>,
    /// What the worker has not answered yet: it answers in order.
    asked: VecDeque<Answer>,
    /// The id of the environment that the worker has made last.
    made: Option<u64>,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
    /// In the worker: the environment that was made last.
    static MADE: RefCell<Option<Arc<CubeMap>>> = const { RefCell::new(None) };
}

/// Asks for the environment of a light.
pub async fn environment(light: LightNamed) -> Option<MadeEnvironment> {
    let made: MadeEnvironment = answer(&Task::Environment(light)).await?;
    PAGE.with_borrow_mut(|page| page.made = Some(made.map().id()));
    Some(made)
}

/// Takes a worker into service, which answers each message by [`done`].
pub fn employ(worker: Worker) {
    let answered = Closure::<dyn Fn(MessageEvent)>::new(|event: MessageEvent| {
        let answer = PAGE.with_borrow_mut(|page| page.asked.pop_front());
        answer.into_iter().for_each(|answer| answer(Some(event.data().unchecked_into::<Uint8Array>().to_vec())));
    });
    let failed = Closure::<dyn Fn(JsValue)>::new(|_| dismiss());
    worker.set_onmessage(Some(answered.as_ref().unchecked_ref()));
    worker.set_onerror(Some(failed.as_ref().unchecked_ref()));
    // They live as long as the page.
    answered.forget();
    failed.forget();
    PAGE.with_borrow_mut(|page| page.worker = Some(worker));
}

/// Does without the worker, because it failed: whoever has asked it does the work in the page.
fn dismiss() {
    log::warn!("the worker has failed: the page does its work itself");
    let page = PAGE.take();
    page.asked.into_iter().for_each(|answer| answer(None));
}

/// Asks for a task to be done; `answer` gets nothing where there is no worker, or where it failed.
pub fn ask<T: DeserializeOwned>(task: &Task, answer: impl FnOnce(Option<T>) + 'static) -> io::Result<()> {
    let Some(worker) = PAGE.with_borrow(|page| page.worker.clone()) else {
        return spawn(move || answer(None));
    };
    let refused = |reason: JsValue| io::Error::other(format!("{reason:?}"));
    let bytes = postcard::to_allocvec(task).map_err(io::Error::other)?;
    let bytes = Uint8Array::from(bytes.as_slice());
    worker.post_message_with_transfer(&bytes, &js_sys::Array::of1(&bytes.buffer())).map_err(refused)?;
    let read = move |bytes: Option<Vec<u8>>| answer(bytes.and_then(|bytes| postcard::from_bytes(&bytes).ok()));
    PAGE.with_borrow_mut(|page| page.asked.push_back(Box::new(read)));
    Ok(())
}

/// Waits for the answer to a task.
async fn answer<T: DeserializeOwned + 'static>(task: &Task) -> Option<T> {
    let answered = std::rc::Rc::new(RefCell::new(None));
    let place = answered.clone();
    let promise = js_sys::Promise::new(&mut |resolve, reject| {
        let place = place.clone();
        let answer = move |answer| {
            *place.borrow_mut() = answer;
            // It cannot fail: it is a promise's own.
            let _ = resolve.call0(&JsValue::NULL);
        };
        if let Err(error) = ask(task, answer) {
            log::warn!("the worker is not asked: {error}");
            let _ = reject.call0(&JsValue::NULL);
        }
    });
    JsFuture::from(promise).await.ok()?;
    answered.take()
}

/// Keeps a file, here and in the worker, so that scenes find it by its name.
pub fn keep_file(name: &str, bytes: &[u8]) {
    input::keep_file(name, bytes);
    if let Err(error) = ask(&Task::File(name.to_owned(), bytes.to_vec()), |_: Option<()>| {}) {
        log::warn!("the worker does not have {name}: {error}");
    }
}

/// In the worker: the answer to a message, empty where there is none.
pub fn done(message: &[u8]) -> Vec<u8> {
    let answer = postcard::from_bytes(message).map(|task| match task {
        Task::File(name, bytes) => {
            input::keep_file(&name, &bytes);
            Ok(Vec::new())
        }
        // The page finds out itself what is wrong with the light, and says it.
        Task::Environment(light) => light.made().map_or(Ok(Vec::new()), |made| {
            MADE.set(Some(made.map().clone()));
            postcard::to_allocvec(&made)
        }),
        Task::Work(work) => postcard::to_allocvec(&work.done()),
        Task::Defocus(id, half_angle_rad, tiles) => {
            let made = MADE.with_borrow(|made| made.clone()).filter(|made| made.id() == id);
            made.map_or(Ok(Vec::new()), |made| {
                let key = DefocusKey { environment: EnvironmentKey(made), half_angle_rad, tiles };
                postcard::to_allocvec(&Work::Defocus(key).done())
            })
        }
    });
    answer.and_then(|answer| answer).unwrap_or_default()
}
