//! Draws pictures beside the window: a picture takes long where its shaders are compiled first, and the window must stay quick meanwhile.
//!
//! The renderer is lent to a thread, with a plan, and comes back with the plan's result. A browser compiles shaders beside the page, and its
//! threads cannot share a device: there, a plan is executed in parts between other tasks.
//!
//! A software rasteriser compiles shaders when it first runs them, and whatever else is given to its device waits until it has. The renderer has
//! a device of its own there, and its pictures are copied to that of the window.

#[cfg_attr(target_arch = "wasm32", path = "render_thread/browser.rs")]
#[cfg_attr(not(target_arch = "wasm32"), path = "render_thread/desktop.rs")]
mod thread;

use std::time::Duration;

use crate::{
    gpu::{Gpu, GpuError, Renderer, formats::PICTURE_FORMAT, target::Target},
    plan::Plan,
};

/// A renderer, and the plan that it is lent with.
type Job = Box<(Renderer, Plan)>;

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
    /// The picture on the window's device, where that is another one.
    copied: Option<Target>,
    /// The picture that was drawn last, on the window's device.
    picture: Option<wgpu::TextureView>,
    thread: thread::Thread,
}

impl RenderThread {
    /// A renderer for a window with a device; it draws nothing yet. `wake` is called, from another thread or task, whenever a plan is finished.
    pub async fn new(window: &Gpu, wake: impl Fn() + Send + 'static) -> Result<Self, GpuError> {
        let is_software = window.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let copies = is_software && cfg!(not(target_arch = "wasm32"));
        let gpu = if copies { window.another().await? } else { window.clone() };
        Ok(Self {
            window: window.clone(),
            renderer: Some(Renderer::new(gpu.clone())),
            gpu,
            copies,
            copied: None,
            picture: None,
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
        if let Some(renderer) = self.renderer.take() {
            self.thread.begin(Box::new((renderer, plan)));
        }
    }

    /// What came of the plan that was begun last, once: it is waited for no longer than a while.
    pub fn finished(&mut self, patience: Duration) -> Option<Finished> {
        let (renderer, finished) = self.thread.finished(patience)?;
        self.renderer = Some(renderer);
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
