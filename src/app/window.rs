//! The event loop: hands events to egui, redraws when something asks for it, and sleeps otherwise.

mod requests;

use std::{cell::RefCell, rc::Rc, sync::Arc};

#[cfg(not(target_arch = "wasm32"))]
use egui_winit::accesskit_winit;
use web_time::Instant;
#[cfg(not(target_arch = "wasm32"))]
use winit::event_loop::EventLoop;
use winit::{
    application::ApplicationHandler,
    event::{StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy},
    window::{Window, WindowAttributes, WindowId},
};

use super::{
    AppError, files::Files, frame::View, keeper::Keeper, model::Model, panels, producer::Producer, request::Request,
    stage::Stage, storage::Storage, style, system,
};
use crate::{
    gpu::{AdapterChoice, Gpu},
    output::tell,
};

/// What reaches the loop from outside the window.
#[cfg_attr(target_arch = "wasm32", derive(Clone))]
pub enum Outside {
    /// A screen reader asks for something.
    #[cfg(not(target_arch = "wasm32"))]
    Accessibility(accesskit_winit::Event),
    /// A worker has a result.
    Arrival,
    /// The device is open, or there is none.
    Stage,
}

#[cfg(not(target_arch = "wasm32"))]
impl From<accesskit_winit::Event> for Outside {
    fn from(event: accesskit_winit::Event) -> Self {
        Self::Accessibility(event)
    }
}

/// Runs the window until it is closed.
#[cfg(not(target_arch = "wasm32"))]
pub fn run(model: Model, choice: &AdapterChoice) -> Result<(), AppError> {
    let event_loop = EventLoop::with_user_event().build()?;
    let attributes = Window::default_attributes().with_visible(false);
    let mut handler = Handler::new(model, Storage::of_user(), choice.clone(), event_loop.create_proxy(), attributes);
    event_loop.run_app(&mut handler)?;
    handler.failure.map_or(Ok(()), Err)
}

/// A window, its model, and all that it is drawn with.
pub struct Handler {
    /// What is shown.
    pub model: Model,
    files: Files,
    keeper: Keeper,
    choice: AdapterChoice,
    proxy: EventLoopProxy<Outside>,
    attributes: WindowAttributes,
    /// A window that waits for its device.
    bare: Option<Bare>,
    /// Where the device arrives.
    arriving: Rc<RefCell<Option<Result<Stage, AppError>>>>,
    view: Option<View>,
    /// When the next redraw is due; never where nothing will change by itself.
    pub next: Option<Instant>,
    /// Whether the redraw that comes is one that was asked for here.
    asked: bool,
    /// Why the loop ends early.
    pub failure: Option<AppError>,
}

/// Wakes the loop, from any thread: something has arrived.
fn waker(proxy: &EventLoopProxy<Outside>) -> impl Fn() + Send + Sync + 'static {
    let proxy = proxy.clone();
    // A loop that has ended needs no waking.
    move || drop(proxy.send_event(Outside::Arrival))
}

/// A window without a device, and what its user does.
struct Bare {
    window: Arc<Window>,
    egui: egui_winit::State,
}

impl Handler {
    /// A window that is opened when the loop runs.
    pub fn new(
        mut model: Model,
        storage: Storage,
        choice: AdapterChoice,
        proxy: EventLoopProxy<Outside>,
        attributes: WindowAttributes,
    ) -> Self {
        let files = Files::new(waker(&proxy));
        let keeper = Keeper::new(storage, &mut model);
        Self {
            model,
            files,
            keeper,
            choice,
            proxy,
            attributes,
            bare: None,
            arriving: Rc::default(),
            view: None,
            next: None,
            asked: false,
            failure: None,
        }
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), AppError> {
        let attributes = self.attributes.clone().with_title(self.model.title());
        let window =
            Arc::new(event_loop.create_window(system::sized(event_loop, attributes, self.model.settings.window))?);
        let ctx = egui::Context::default();
        style::apply(&ctx);
        ctx.set_zoom_factor(self.model.settings.zoom.clamp(0.5, 4.0));
        let scale = Some(window.scale_factor() as f32);
        let root = egui::ViewportId::ROOT;
        #[cfg_attr(target_arch = "wasm32", allow(unused_mut, reason = "screen readers see a canvas there"))]
        let mut egui = egui_winit::State::new(ctx, root, &window, scale, window.theme(), None);
        // Screen readers must be connected before the window is seen.
        #[cfg(not(target_arch = "wasm32"))]
        egui.init_accesskit(event_loop, &window, self.proxy.clone());
        let instance = Gpu::instance_for(&self.choice, Box::new(event_loop.owned_display_handle()))?;
        self.open_device(instance, Bare { window, egui });
        Ok(())
    }

    /// Opens a device for a window. A browser has none at once, and what is done in the window meanwhile is kept.
    fn open_device(&mut self, instance: wgpu::Instance, bare: Bare) {
        let ctx = bare.egui.egui_ctx().clone();
        let opening = Stage::open(instance, self.choice.clone(), bare.window.clone(), ctx, waker(&self.proxy));
        let (arriving, proxy) = (self.arriving.clone(), self.proxy.clone());
        system::finish(async move {
            *arriving.borrow_mut() = Some(opening.await);
            // A loop that has ended needs no device.
            let _ = proxy.send_event(Outside::Stage);
        });
        self.bare = Some(bare);
    }

    /// Takes the device that has arrived.
    fn take_device(&mut self) -> Result<(), AppError> {
        let Some(stage) = self.arriving.borrow_mut().take() else { return Ok(()) };
        let (stage, Some(Bare { window, mut egui })) = (stage?, self.bare.take()) else { return Ok(()) };
        let gpu = &stage.gpu;
        [gpu, &stage.drawing.gpu].into_iter().for_each(|gpu| gpu.when_lost(waker(&self.proxy)));
        self.model.costs.adapter = format!("{}, {}", gpu.adapter_name(), gpu.driver());
        tell(format_args!("adapter: {}", self.model.costs.adapter));
        egui.set_max_texture_side(gpu.device.limits().max_texture_dimension_2d as usize);
        window.set_visible(true);
        let producer = Producer::new(waker(&self.proxy));
        self.view = Some(View::new(window, egui, stage, producer));
        Ok(())
    }

    /// Opens another device if the device is lost, and everything on it with it.
    fn recover(&mut self) {
        let Some(view) = self.view.take_if(|view| view.is_lost()) else { return };
        log::warn!("recreating everything on the graphics device");
        let instance = view.stage.gpu.instance.clone();
        panels::gallery::forget(view.egui.egui_ctx());
        panels::textures::forget(view.egui.egui_ctx());
        self.open_device(instance, Bare { window: view.window, egui: view.egui });
        self.model.messages.note("The graphics device was lost and has been reopened");
    }

    /// How far the picture is that the model asks for.
    #[cfg(target_arch = "wasm32")]
    pub fn progress(&self) -> super::frame::Progress {
        use super::frame::Progress;
        match (&self.failure, &self.view) {
            (Some(error), _) => Progress::Failed(error.to_string()),
            (None, Some(view)) if self.model.loading.is_none() => view.progress.clone(),
            _ => Progress::Under,
        }
    }

    /// Whether events of a window are for this one.
    #[cfg(target_arch = "wasm32")]
    pub fn is_of(&self, window: WindowId) -> bool {
        let own = self.view.as_ref().map(|view| &view.window).or(self.bare.as_ref().map(|bare| &bare.window));
        own.is_some_and(|own| own.id() == window)
    }

    /// The device, once it is open.
    #[cfg(target_arch = "wasm32")]
    pub fn gpu(&self) -> Option<&Gpu> {
        self.view.as_ref().map(|view| &view.stage.gpu)
    }

    /// Requests another frame.
    pub fn ask_for_redraw(&mut self) {
        if let Some(view) = &self.view {
            self.asked = true;
            self.next = None;
            view.window.request_redraw();
        }
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) {
        self.recover();
        let Some(view) = &mut self.view else { return };
        // A redraw that the program did not request comes from the system, which has lost the contents of the window.
        view.exposed |= !std::mem::take(&mut self.asked);
        self.next = view.redraw(event_loop, &mut self.model, &self.files);
        let kept = self.keeper.keep(&mut self.model, Instant::now());
        self.next = [self.next, kept].into_iter().flatten().min();
        for request in std::mem::take(&mut self.model.requests) {
            self.serve(event_loop, request);
        }
        #[cfg(not(target_arch = "wasm32"))]
        self.export();
    }

    /// Begins the next export, if none is being done, on a device of its own: what fails there leaves the window alone.
    #[cfg(not(target_arch = "wasm32"))]
    fn export(&mut self) {
        let Some(gpu) = self.view.as_ref().map(|view| &view.stage.gpu) else { return };
        let Some((id, job, scene, watch)) = self.model.exports.begin_next() else { return };
        let gpu = gpu.clone();
        let open = Box::new(move || pollster::block_on(gpu.another()));
        self.files.export(id, move || job.run(scene, open, watch).map_err(|error| format!("{error:#}")));
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: AppError) {
        self.failure = Some(error);
        system::end(event_loop);
    }
}

impl ApplicationHandler<Outside> for Handler {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.view.is_none()
            && self.bare.is_none()
            && let Err(error) = self.open(event_loop)
        {
            self.fail(event_loop, error);
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            self.ask_for_redraw();
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Outside) {
        match event {
            Outside::Arrival => self.arrive(),
            Outside::Stage => match self.take_device() {
                Ok(()) => self.ask_for_redraw(),
                Err(error) => self.fail(event_loop, error),
            },
            #[cfg(not(target_arch = "wasm32"))]
            Outside::Accessibility(event) => {
                let Some(view) = &mut self.view else { return };
                match event.window_event {
                    accesskit_winit::WindowEvent::InitialTreeRequested => view.egui.egui_ctx().enable_accesskit(),
                    accesskit_winit::WindowEvent::ActionRequested(action) => {
                        view.egui.on_accesskit_action_request(action);
                    }
                    accesskit_winit::WindowEvent::AccessibilityDeactivated => view.egui.egui_ctx().disable_accesskit(),
                }
                self.ask_for_redraw();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(view) = &mut self.view else { return };
        match &event {
            WindowEvent::RedrawRequested => return self.redraw(event_loop),
            WindowEvent::CloseRequested => {
                self.model.ask_for(Request::Quit);
                return self.ask_for_redraw();
            }
            WindowEvent::DroppedFile(path) => {
                let path = path.clone();
                self.open_file(&path);
                return self.ask_for_redraw();
            }
            _ => {}
        }
        if view.egui.on_window_event(&view.window, &event).repaint {
            self.ask_for_redraw();
        }
        #[cfg(debug_assertions)]
        self.try_recovery(&event);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let flow = self.next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil);
        event_loop.set_control_flow(flow);
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.keeper.close(&mut self.model, self.failure.is_none());
        // Their threads end with the program: what they have begun must not stay behind.
        #[cfg(not(target_arch = "wasm32"))]
        if !self.model.exports.entries.is_empty() {
            crate::output::abandon_files();
        }
        // The surface must go before the display that it belongs to.
        self.view = None;
    }
}

#[cfg(debug_assertions)]
impl Handler {
    /// Debug builds lose the device at F12, so that people and tests can see it come back.
    fn try_recovery(&mut self, event: &WindowEvent) {
        use winit::keyboard::{Key, NamedKey};
        if let WindowEvent::KeyboardInput { event, .. } = event
            && event.logical_key == Key::Named(NamedKey::F12)
            && event.state.is_pressed()
        {
            self.lose_device();
        }
    }

    /// Loses the device.
    pub fn lose_device(&mut self) {
        if let Some(view) = &self.view {
            view.lose_device();
            self.ask_for_redraw();
        }
    }
}
