//! Draws pictures beside the window: a picture takes long where its shaders are compiled first, and the window must stay quick meanwhile.
//!
//! The renderer is lent to a thread, with a plan, and comes back with the plan's result. A browser compiles shaders beside the page, and its
//! threads cannot share a device: there, a plan is executed on the spot.
//!
//! A software rasteriser compiles shaders when it first runs them, and whatever else is given to its device waits until it has. The renderer has
//! a device of its own there, and its pictures are copied to that of the window.

use std::time::Duration;

use web_time::Instant;

use crate::{
    gpu::{Gpu, GpuError, Renderer, formats::PICTURE_FORMAT, target::Target},
    plan::{Pass, Plan},
};

/// What came of a plan.
pub struct Finished {
    /// The plan.
    pub plan: Plan,
    /// Whether it was executed.
    pub result: Result<(), GpuError>,
    /// Time that it took, milliseconds.
    pub ms: f64,
    /// A new picture for a window with another device: rows of RGBA.
    copy: Option<Vec<u8>>,
}

/// A renderer that draws beside the window.
pub struct RenderThread {
    /// Its device.
    pub gpu: Gpu,
    /// The window's device.
    window: Gpu,
    /// Whether that is another one, to which pictures are copied.
    copies: bool,
    /// The renderer, while it draws nothing.
    renderer: Option<Renderer>,
    /// What was executed on the spot.
    finished: Option<Finished>,
    /// The picture on the window's device, where that is another one.
    copied: Option<Target>,
    /// The picture that was drawn last, on the window's device.
    picture: Option<wgpu::TextureView>,
    #[cfg(not(target_arch = "wasm32"))]
    thread: Option<thread::Thread>,
}

impl RenderThread {
    /// A renderer for a window with a device; it draws nothing yet. `wake` is called, from another thread, whenever a plan is finished.
    #[cfg_attr(target_arch = "wasm32", expect(unused_variables, reason = "there is no other thread"))]
    pub async fn new(window: &Gpu, wake: impl Fn() + Send + 'static) -> Result<Self, GpuError> {
        let is_software = window.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let copies = is_software && cfg!(not(target_arch = "wasm32"));
        let gpu = if copies { window.another().await? } else { window.clone() };
        Ok(Self {
            window: window.clone(),
            renderer: Some(Renderer::new(gpu.clone())),
            gpu,
            copies,
            finished: None,
            copied: None,
            picture: None,
            #[cfg(not(target_arch = "wasm32"))]
            thread: thread::Thread::new(copies, wake),
        })
    }

    /// The renderer, unless it is drawing.
    pub fn renderer(&mut self) -> Option<&mut Renderer> {
        self.renderer.as_mut()
    }

    /// The picture that was drawn last, if there is one.
    pub fn picture(&self) -> Option<&wgpu::TextureView> {
        self.picture.as_ref()
    }

    /// Whether one of the two devices is gone, and everything on it with it.
    pub fn is_lost(&self) -> bool {
        // A loss is told by a callback, which comes when the device is polled.
        [&self.window, &self.gpu].into_iter().any(|gpu| {
            let _ = gpu.device.poll(wgpu::PollType::Poll);
            gpu.is_lost()
        })
    }

    /// Fails if a device was lost, or refused something, since the last call.
    pub fn check(&self) -> Result<(), GpuError> {
        self.window.check().and_then(|()| self.gpu.check())
    }

    /// Begins to execute a plan that was made for the renderer's present state. Nothing happens while another one is executed.
    pub fn begin(&mut self, plan: Plan) {
        let Some(renderer) = self.renderer.take() else { return };
        let job = Box::new((renderer, plan));
        #[cfg(not(target_arch = "wasm32"))]
        let job = match &self.thread {
            Some(thread) if !job.1.is_empty() => match thread.begin(job) {
                Ok(()) => return,
                Err(job) => job,
            },
            _ => job,
        };
        let (renderer, finished) = execute(*job, self.copies);
        (self.renderer, self.finished) = (Some(renderer), Some(finished));
    }

    /// What came of the plan that was begun last, once: it is waited for no longer than a while.
    #[cfg_attr(target_arch = "wasm32", expect(unused_variables, reason = "nothing is waited for"))]
    pub fn finished(&mut self, patience: Duration) -> Option<Finished> {
        #[cfg(not(target_arch = "wasm32"))]
        if let (None, Some(thread)) = (&self.renderer, &mut self.thread) {
            let (renderer, finished) = thread.finished(patience)?;
            (self.renderer, self.finished) = (Some(renderer), Some(finished));
        }
        let finished = self.finished.take()?;
        self.take_picture(&finished);
        Some(finished)
    }

    fn take_picture(&mut self, finished: &Finished) {
        if let (Some(rgba), Some(drawn)) = (&finished.copy, &finished.plan.after.picture) {
            let size = drawn.draw.size;
            let copied = Target::fit(self.copied.take(), &self.window, "picture", size, PICTURE_FORMAT);
            copied.upload(&self.window, rgba);
            self.picture = Some(self.copied.insert(copied).view.clone());
        } else if !self.copies
            && let Some(picture) = self.renderer.as_ref().and_then(Renderer::picture)
        {
            self.picture = Some(picture.clone());
        }
    }
}

fn execute((mut renderer, plan): (Renderer, Plan), copies: bool) -> (Renderer, Finished) {
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
#[cfg(not(target_arch = "wasm32"))]
fn copy(renderer: &Renderer) -> Result<Option<Vec<u8>>, GpuError> {
    renderer.read_picture().map(|picture| picture.wait(&renderer.gpu)).transpose()
}

/// Nothing may be waited for in a browser, and nothing is copied.
#[cfg(target_arch = "wasm32")]
fn copy(_: &Renderer) -> Result<Option<Vec<u8>>, GpuError> {
    Ok(None)
}

#[cfg(not(target_arch = "wasm32"))]
mod thread {
    use std::{
        sync::mpsc::{Receiver, RecvTimeoutError, SendError, Sender, channel},
        thread::{Builder, JoinHandle},
        time::Duration,
    };

    use super::{Finished, execute};
    use crate::{gpu::Renderer, plan::Plan};

    /// The thread that draws.
    pub struct Thread {
        /// Dropped first, which ends the thread.
        plans: Option<Sender<Box<(Renderer, Plan)>>>,
        finished: Receiver<(Renderer, Finished)>,
        handle: Option<JoinHandle<()>>,
    }

    impl Thread {
        /// A thread that waits for plans, if the system gives one. With `copies`, it reads back what it draws.
        pub fn new(copies: bool, wake: impl Fn() + Send + 'static) -> Option<Self> {
            let (plans, begun) = channel::<Box<(Renderer, Plan)>>();
            let (done, finished) = channel();
            let draw = move || {
                for job in begun {
                    // Nobody listens any more once the window is gone.
                    let _ = done.send(execute(*job, copies));
                    wake();
                }
            };
            let handle = Builder::new().name("soapfilm pictures".to_owned()).spawn(draw);
            let handle =
                handle.inspect_err(|error| log::warn!("pictures are drawn by the window itself: {error}")).ok()?;
            Some(Self { plans: Some(plans), finished, handle: Some(handle) })
        }

        /// Lends it a renderer; one that it cannot take comes back.
        pub fn begin(&self, job: Box<(Renderer, Plan)>) -> Result<(), Box<(Renderer, Plan)>> {
            match &self.plans {
                Some(plans) => plans.send(job).map_err(|SendError(job)| job),
                None => Err(job),
            }
        }

        /// The renderer, if it comes back within a while.
        pub fn finished(&mut self, patience: Duration) -> Option<(Renderer, Finished)> {
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
}
