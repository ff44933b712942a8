//! The event loop of a page, which all of its canvases share.

use std::{
    cell::{OnceCell, RefCell},
    rc::Rc,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use wasm_bindgen::{JsError, JsValue};
use wasm_bindgen_futures::spawn_local;
use web_sys::HtmlCanvasElement;
use web_time::Instant;
use winit::{
    application::ApplicationHandler,
    event::{StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy},
    platform::web::{EventLoopExtWebSys, WindowAttributesExtWebSys},
    window::{Window, WindowId},
};

use crate::{
    app::{
        frame::Progress,
        model::Model,
        storage::Storage,
        window::{Handler, Outside},
    },
    gpu::AdapterChoice,
};

/// A canvas, and whom to tell how far its picture is.
pub struct Bubble {
    pub handler: Handler,
    told: js_sys::Function,
    progress: Progress,
    /// Whether the device has drawn the picture, once it was asked to tell.
    drawn: Option<Arc<AtomicBool>>,
}

type Bubbles = Rc<RefCell<Vec<Rc<RefCell<Bubble>>>>>;

thread_local! {
    static PAGE: OnceCell<(EventLoopProxy<Outside>, Bubbles)> = const { OnceCell::new() };
}

/// Adds a canvas to the page's event loop, which begins with the first.
pub fn add(model: Model, canvas: HtmlCanvasElement, told: js_sys::Function) -> Result<Rc<RefCell<Bubble>>, JsError> {
    let (proxy, bubbles) = page()?;
    let attributes = Window::default_attributes().with_canvas(Some(canvas));
    // Pictures in other people's pages leave nothing behind.
    let storage = if model.stands_alone { Storage::default() } else { Storage::of_user() };
    let handler = Handler::new(model, storage, AdapterChoice::default(), proxy.clone(), attributes);
    let bubble = Rc::new(RefCell::new(Bubble { handler, told, progress: Progress::Under, drawn: None }));
    bubbles.borrow_mut().push(bubble.clone());
    // Only the loop itself can open a window.
    let _ = proxy.send_event(Outside::Arrival);
    Ok(bubble)
}

/// Takes a canvas off the page.
pub fn remove(bubble: &Rc<RefCell<Bubble>>) {
    PAGE.with(|page| {
        if let Some((_, bubbles)) = page.get() {
            bubbles.borrow_mut().retain(|other| !Rc::ptr_eq(other, bubble));
        }
    });
}

fn page() -> Result<(EventLoopProxy<Outside>, Bubbles), JsError> {
    PAGE.with(|page| {
        if let Some(page) = page.get() {
            return Ok(page.clone());
        }
        let event_loop = EventLoop::with_user_event().build()?;
        let (proxy, bubbles) = (event_loop.create_proxy(), Bubbles::default());
        event_loop.spawn_app(Page { proxy: proxy.clone(), bubbles: bubbles.clone() });
        Ok(page.get_or_init(|| (proxy, bubbles)).clone())
    })
}

struct Page {
    proxy: EventLoopProxy<Outside>,
    bubbles: Bubbles,
}

impl Page {
    /// Hands something to each canvas, tells how far their pictures are, and sleeps until the first needs another frame.
    fn each(&mut self, event_loop: &ActiveEventLoop, mut act: impl FnMut(&mut Handler)) {
        // What is called may add a canvas.
        let bubbles = self.bubbles.borrow().clone();
        for bubble in &bubbles {
            let bubble = &mut *bubble.borrow_mut();
            act(&mut bubble.handler);
            bubble.tell(&self.proxy);
        }
        let next: Option<Instant> = bubbles.iter().filter_map(|bubble| bubble.borrow().handler.next).min();
        event_loop.set_control_flow(next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}

impl ApplicationHandler<Outside> for Page {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        self.each(event_loop, |handler| handler.resumed(event_loop));
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: StartCause) {
        if let StartCause::ResumeTimeReached { requested_resume, .. } = cause {
            self.each(event_loop, |handler| {
                if handler.next.is_some_and(|next| next <= requested_resume) {
                    handler.ask_for_redraw();
                }
            });
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Outside) {
        self.each(event_loop, |handler| {
            handler.resumed(event_loop);
            handler.user_event(event_loop, event.clone());
        });
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, window: WindowId, event: WindowEvent) {
        self.each(event_loop, |handler| {
            if handler.is_of(window) {
                handler.window_event(event_loop, window, event.clone());
            }
        });
    }
}

impl Bubble {
    /// Tells the page how far the picture is, if that has changed.
    fn tell(&mut self, proxy: &EventLoopProxy<Outside>) {
        let progress = match self.handler.progress() {
            Progress::Done if self.is_drawn(proxy) => Progress::Done,
            Progress::Done => Progress::Under,
            other => {
                self.drawn = None;
                other
            }
        };
        if progress == self.progress {
            return;
        }
        let (state, text) = match &progress {
            Progress::Under => ("loading", String::new()),
            Progress::Done => ("ready", String::new()),
            Progress::Failed(text) => ("error", text.clone()),
        };
        self.progress = progress;
        let told = self.told.clone();
        // Not at once: the page may call this canvas back, which is in use now.
        spawn_local(async move {
            let _ = told.call2(&JsValue::NULL, &state.into(), &text.into());
        });
    }

    /// Whether the device has drawn what was submitted when this was first asked.
    fn is_drawn(&mut self, proxy: &EventLoopProxy<Outside>) -> bool {
        let Some(gpu) = self.handler.gpu() else { return false };
        let drawn = self.drawn.get_or_insert_with(|| {
            let (drawn, proxy) = (Arc::new(AtomicBool::new(false)), proxy.clone());
            let told = drawn.clone();
            gpu.queue.on_submitted_work_done(move || {
                told.store(true, Ordering::Relaxed);
                let _ = proxy.send_event(Outside::Arrival);
            });
            drawn
        });
        drawn.load(Ordering::Relaxed)
    }
}
