//! The event loop: hands events to egui, redraws when something asks for it, and sleeps otherwise.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

use egui_winit::accesskit_winit;
use winit::{
    application::ApplicationHandler,
    dpi::LogicalSize,
    event::{StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy},
    window::{Window, WindowId},
};

use super::{
    AppError,
    files::{Arrival, Files},
    frame::View,
    model::{Model, Request, Target},
    stage::Stage,
    style,
};
use crate::{
    gpu::{AdapterChoice, Gpu},
    output::tell,
    scene::{Environment, Light},
};

/// What reaches the loop from outside the window.
enum Outside {
    /// A screen reader asks for something.
    Accessibility(accesskit_winit::Event),
    /// A worker has a result.
    Arrival,
}

impl From<accesskit_winit::Event> for Outside {
    fn from(event: accesskit_winit::Event) -> Self {
        Self::Accessibility(event)
    }
}

/// Runs the window until it is closed.
pub fn run(model: Model, choice: &AdapterChoice) -> Result<(), AppError> {
    let event_loop = EventLoop::with_user_event().build()?;
    let proxy = event_loop.create_proxy();
    let waker = proxy.clone();
    // A loop that has ended needs no waking.
    let files = Files::new(move || drop(waker.send_event(Outside::Arrival)));
    let mut handler =
        Handler { model, files, choice: choice.clone(), proxy, view: None, next: None, asked: false, failure: None };
    event_loop.run_app(&mut handler)?;
    handler.failure.map_or(Ok(()), Err)
}

struct Handler {
    model: Model,
    files: Files,
    choice: AdapterChoice,
    proxy: EventLoopProxy<Outside>,
    view: Option<View>,
    /// When the next redraw is due; never where nothing will change by itself.
    next: Option<Instant>,
    /// Whether the redraw that comes is one that was asked for here.
    asked: bool,
    /// Why the loop ends early.
    failure: Option<AppError>,
}

impl Handler {
    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<View, AppError> {
        let attributes = Window::default_attributes().with_inner_size(LogicalSize::new(1280, 800)).with_visible(false);
        let window = Arc::new(event_loop.create_window(attributes.with_title(title(&self.model)))?);
        let ctx = egui::Context::default();
        style::apply(&ctx);
        let scale = Some(window.scale_factor() as f32);
        let root = egui::ViewportId::ROOT;
        let mut egui = egui_winit::State::new(ctx, root, &window, scale, window.theme(), None);
        // Screen readers must be connected before the window is seen.
        egui.init_accesskit(event_loop, &window, self.proxy.clone());
        let instance = Gpu::instance_for(&self.choice, Box::new(event_loop.owned_display_handle()))?;
        let stage = Stage::new(instance, &self.choice, &window, egui.egui_ctx())?;
        let gpu = &stage.renderer.gpu;
        self.model.costs.adapter = format!("{}, {}", gpu.adapter_name(), gpu.driver());
        tell(format_args!("adapter: {}", self.model.costs.adapter));
        egui.set_max_texture_side(gpu.device.limits().max_texture_dimension_2d as usize);
        window.set_visible(true);
        Ok(View::new(window, egui, stage, self.choice.clone()))
    }

    fn ask_for_redraw(&mut self) {
        if let Some(view) = &self.view {
            self.asked = true;
            self.next = None;
            view.window.request_redraw();
        }
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) {
        let Some(view) = &mut self.view else { return };
        // A redraw that the program did not request comes from the system, which has lost the contents of the window.
        view.exposed |= !std::mem::take(&mut self.asked);
        match view.redraw(event_loop, &mut self.model, &self.files) {
            Ok(next) => self.next = next,
            Err(error) => self.fail(event_loop, error),
        }
        for request in std::mem::take(&mut self.model.requests) {
            self.serve(event_loop, request);
        }
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: AppError) {
        self.failure = Some(error);
        event_loop.exit();
    }

    fn serve(&mut self, event_loop: &ActiveEventLoop, request: Request) {
        let Some(view) = &self.view else { return };
        match request {
            Request::Ask(target) => self.files.ask(target, &self.model, &view.window),
            Request::LoadScene(name) => self.files.load_scene(&mut self.model, name),
            Request::LoadLight(light) => self.files.load_light(&mut self.model, light),
            Request::Quit => event_loop.exit(),
        }
        self.ask_for_redraw();
    }

    fn arrive(&mut self) {
        for arrival in self.files.collect(&mut self.model) {
            let Some(view) = &mut self.view else { return };
            match arrival {
                Arrival::Scene => view.window.set_title(&title(&self.model)),
                Arrival::Chosen(Target::SaveScene, path) => {
                    self.files.save_scene(
                        with_ending(path, "toml"),
                        self.model.scene.clone(),
                        self.model.folder.clone(),
                    );
                }
                Arrival::Chosen(Target::SavePng, path) => {
                    view.capture(&mut self.model, false, with_ending(path, "png"));
                }
                Arrival::Chosen(Target::SaveExr, path) => {
                    view.capture(&mut self.model, true, with_ending(path, "exr"));
                }
                Arrival::Chosen(Target::OpenScene | Target::OpenEnvironment, path) => self.open_file(&path),
            }
        }
        self.ask_for_redraw();
    }

    /// Opens a file that was chosen or dropped, by its ending.
    fn open_file(&mut self, path: &Path) {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("").to_ascii_lowercase();
        let Some(name) = std::path::absolute(path).ok().and_then(|path| path.to_str().map(str::to_owned)) else {
            return self.model.messages.problem(format!("{}: this file name is not UTF-8; rename it", path.display()));
        };
        match ending.as_str() {
            "toml" => self.files.load_scene(&mut self.model, name),
            "exr" | "hdr" => {
                let light =
                    Light { environment: Environment::File(name), constant: None, ..self.model.scene.light.clone() };
                self.files.load_light(&mut self.model, light);
            }
            _ => self
                .model
                .messages
                .problem(format!("{}: open a scene (.toml) or an environment (.exr, .hdr)", path.display())),
        }
    }
}

fn title(model: &Model) -> String {
    format!("soapfilm – {}", model.name)
}

/// A path that ends as its kind of file does, where the user gave no ending.
fn with_ending(path: PathBuf, ending: &str) -> PathBuf {
    if path.extension().is_some() { path } else { path.with_extension(ending) }
}

impl ApplicationHandler<Outside> for Handler {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.view.is_none() {
            match self.open(event_loop) {
                Ok(view) => self.view = Some(view),
                Err(error) => self.fail(event_loop, error),
            }
            self.ask_for_redraw();
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            self.ask_for_redraw();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, event: Outside) {
        match event {
            Outside::Arrival => self.arrive(),
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
            WindowEvent::CloseRequested => return event_loop.exit(),
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
        // The surface must go before the display that it belongs to.
        self.view = None;
    }
}

#[cfg(debug_assertions)]
impl Handler {
    /// Debug builds lose the device at F12, so that people and tests can see it come back.
    fn try_recovery(&mut self, event: &WindowEvent) {
        use winit::keyboard::{Key, NamedKey};
        if let (Some(view), WindowEvent::KeyboardInput { event, .. }) = (&self.view, event)
            && event.logical_key == Key::Named(NamedKey::F12)
            && event.state.is_pressed()
        {
            view.lose_device();
            self.ask_for_redraw();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_without_ending_gets_one() {
        assert_eq!(with_ending("a/b".into(), "png"), PathBuf::from("a/b.png"));
        assert_eq!(with_ending("a/b.PNG".into(), "png"), PathBuf::from("a/b.PNG"));
    }
}
