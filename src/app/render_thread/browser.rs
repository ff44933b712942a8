//! A page has no thread that draws. It executes a plan in parts, each in a task of its own, so that none holds it up for long.

use std::{
    cell::RefCell,
    rc::{Rc, Weak},
    time::Duration,
};

use web_time::Instant;

use super::{Finished, Job};
use crate::{
    app::system,
    gpu::{GpuError, Renderer},
};

/// Time after which no further pass is begun in a task. A pass takes as long again at most, where its shaders are new.
const PART: Duration = Duration::from_millis(16);

/// What stands for the thread.
pub struct Thread {
    wake: Rc<dyn Fn()>,
    begun: Rc<RefCell<Option<Begun>>>,
}

/// A plan that is being executed.
struct Begun {
    job: Job,
    /// How many of its passes have run.
    done: usize,
    ms: f64,
    /// What came of it.
    result: Option<Result<(), GpuError>>,
}

impl Thread {
    /// Nothing to do yet. Nothing is read back, for nothing may be waited for.
    pub fn new(_copies: bool, wake: impl Fn() + 'static) -> Self {
        Self { wake: Rc::new(wake), begun: Rc::default() }
    }

    /// Executes the first part of a plan at once, which for most pictures is all of it.
    pub fn begin(&mut self, job: Job) {
        let mut begun = Begun { job, done: 0, ms: 0.0, result: None };
        begun.go_on();
        let is_done = begun.result.is_some();
        self.begun = Rc::new(RefCell::new(Some(begun)));
        if !is_done {
            go_on_later(Rc::downgrade(&self.begun), self.wake.clone());
        }
    }

    /// The renderer, once the plan is executed.
    pub fn finished(&mut self, _patience: Duration) -> Option<(Renderer, Finished)> {
        let mut begun = self.begun.borrow_mut();
        let Begun { job, ms, result, .. } = begun.take_if(|begun| begun.result.is_some())?;
        let (renderer, plan) = *job;
        Some((renderer, Finished { plan, result: result?, ms, copy: None }))
    }
}

impl Begun {
    /// Executes the next part.
    fn go_on(&mut self) {
        let (renderer, plan) = &mut *self.job;
        let since = Instant::now();
        let ran = renderer.execute_from(plan, self.done, || since.elapsed() < PART);
        self.ms += since.elapsed().as_secs_f64() * 1e3;
        match ran {
            Ok(done) if done < plan.steps.len() => self.done = done,
            ran => self.result = Some(ran.map(drop)),
        }
    }
}

/// Executes the other parts of a plan, unless its window is gone, and tells when they are done.
fn go_on_later(begun: Weak<RefCell<Option<Begun>>>, wake: Rc<dyn Fn()>) {
    let part = move || {
        let Some(shared) = begun.upgrade() else { return };
        if let Some(begun) = shared.borrow_mut().as_mut() {
            begun.go_on();
        }
        if shared.borrow().as_ref().is_some_and(|begun| begun.result.is_none()) {
            go_on_later(begun, wake);
        } else {
            wake();
        }
    };
    if let Err(error) = system::spawn_after(0, part) {
        log::error!("the picture is not finished: {error}");
    }
}
