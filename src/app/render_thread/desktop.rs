//! A thread that draws.

use std::{
    sync::mpsc::{Receiver, RecvTimeoutError, SendError, Sender, channel},
    thread::{Builder, JoinHandle},
    time::{Duration, Instant},
};

use super::{Finished, Job};
use crate::{
    gpu::{GpuError, Renderer},
    plan::Pass,
};

/// The thread, if the system gives one.
pub struct Thread {
    /// Whether what is drawn is read back.
    copies: bool,
    /// Dropped first, which ends the thread.
    plans: Option<Sender<Job>>,
    finished: Receiver<(Renderer, Finished)>,
    handle: Option<JoinHandle<()>>,
    /// What was executed on the spot.
    on_the_spot: Option<(Renderer, Finished)>,
}

impl Thread {
    /// A thread that waits for plans. With `copies`, it reads back what it draws.
    pub fn new(copies: bool, wake: impl Fn() + Send + 'static) -> Self {
        let (plans, begun) = channel::<Job>();
        let (done, finished) = channel();
        let draw = move || {
            for job in begun {
                // Nobody listens any more once the window is gone.
                let _ = done.send(execute(job, copies));
                wake();
            }
        };
        let handle = Builder::new().name("soapfilm pictures".to_owned()).spawn(draw);
        let handle = handle.inspect_err(|error| log::warn!("pictures are drawn by the window itself: {error}")).ok();
        Self { copies, plans: handle.is_some().then_some(plans), finished, handle, on_the_spot: None }
    }

    /// Lends it a renderer with a plan. What it cannot take, or is nothing to do, is done on the spot.
    pub fn begin(&mut self, job: Job) {
        let left = match &self.plans {
            Some(plans) if !job.1.is_empty() => plans.send(job).err().map(|SendError(job)| job),
            _ => Some(job),
        };
        self.on_the_spot = left.map(|job| execute(job, self.copies));
    }

    /// The renderer, if it comes back within a while.
    pub fn finished(&mut self, patience: Duration) -> Option<(Renderer, Finished)> {
        if self.on_the_spot.is_some() {
            return self.on_the_spot.take();
        }
        match self.finished.recv_timeout(patience) {
            Ok(finished) => Some(finished),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => {
                // It has panicked, which is a fault of the program: what follows is as if the window had.
                if let Some(Err(panic)) = self.handle.take().map(JoinHandle::join) {
                    std::panic::resume_unwind(panic);
                }
                None
            }
        }
    }
}

impl Drop for Thread {
    /// Waits until the thread has ended: a device must not be used while the program ends.
    fn drop(&mut self) {
        self.plans = None;
        // A panic was told when it happened.
        let _ = self.handle.take().map(JoinHandle::join);
    }
}

fn execute(job: Job, copies: bool) -> (Renderer, Finished) {
    let (mut renderer, plan) = *job;
    let begun = Instant::now();
    let draws = plan.steps.iter().any(|(pass, _)| matches!(pass, Pass::Tonemap(_)));
    let executed = renderer.execute(&plan);
    let copied = executed.and_then(|()| if copies && draws { copy(&renderer) } else { Ok(None) });
    let (result, copy) = match copied {
        Ok(copy) => (Ok(()), copy),
        Err(error) => (Err(error), None),
    };
    (renderer, Finished { plan, result, ms: begun.elapsed().as_secs_f64() * 1e3, copy })
}

/// Waits for the picture, and reads it.
fn copy(renderer: &Renderer) -> Result<Option<Vec<u8>>, GpuError> {
    renderer.read_picture().map(|picture| picture.wait(&renderer.gpu)).transpose()
}
