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
    keeper::Keeper,
    model::Model,
    request::{Question, Request, Target},
    stage::Stage,
    storage::Storage,
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
pub fn run(mut model: Model, choice: &AdapterChoice) -> Result<(), AppError> {
    let event_loop = EventLoop::with_user_event().build()?;
    let proxy = event_loop.create_proxy();
    let waker = proxy.clone();
    // A loop that has ended needs no waking.
    let files = Files::new(move || drop(waker.send_event(Outside::Arrival)));
    let keeper = Keeper::new(Storage::of_user(), &mut model);
    let mut handler = Handler {
        model,
        files,
        keeper,
        choice: choice.clone(),
        proxy,
        view: None,
        next: None,
        asked: false,
        failure: None,
    };
    event_loop.run_app(&mut handler)?;
    handler.failure.map_or(Ok(()), Err)
}

struct Handler {
    model: Model,
    files: Files,
    keeper: Keeper,
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
        let [width, height] = self.model.settings.window;
        let attributes = Window::default_attributes()
            .with_inner_size(LogicalSize::new(width, height))
            .with_min_inner_size(LogicalSize::new(320, 240));
        let attributes = attributes.with_title(self.model.title()).with_visible(false);
        let window = Arc::new(event_loop.create_window(attributes)?);
        let ctx = egui::Context::default();
        style::apply(&ctx);
        ctx.set_zoom_factor(self.model.settings.zoom.clamp(0.5, 4.0));
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
        let kept = self.keeper.keep(&mut self.model, Instant::now());
        self.next = [self.next, kept].into_iter().flatten().min();
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
            Request::Save => self.model.file.iter().for_each(|file| self.files.save_scene(file.clone(), &self.model)),
            Request::Typed(target, text) => self.typed(target, text),
            Request::Left(fate) => {
                if let Some(work) = self.keeper.decide(fate) {
                    self.files.take_up(&mut self.model, work);
                }
            }
            Request::Quit => event_loop.exit(),
        }
        self.ask_for_redraw();
    }

    fn arrive(&mut self) {
        for arrival in self.files.collect(&mut self.model) {
            match arrival {
                Arrival::Scene => {
                    let path = self.model.file.as_ref().and_then(|file| std::path::absolute(file).ok());
                    path.iter().for_each(|path| self.model.settings.remember(&path.display().to_string()));
                }
                Arrival::TakenUp => self.keeper.taken_up(&mut self.model),
                Arrival::Saved => {}
                Arrival::NotSaved => self.model.once_saved = None,
                Arrival::Chosen(target, path) => self.chosen(target, path),
            }
        }
        self.ask_for_redraw();
    }

    fn chosen(&mut self, target: Target, path: PathBuf) {
        let Some(view) = &mut self.view else { return };
        match target {
            Target::SaveScene => self.files.save_scene(with_ending(path, "toml"), &self.model),
            Target::SavePng => view.capture(&mut self.model, false, with_ending(path, "png")),
            Target::SaveExr => view.capture(&mut self.model, true, with_ending(path, "exr")),
            Target::SaveCsv => {
                let csv = self.model.probe.pinned.as_ref().map(|(reading, _)| reading.csv());
                csv.into_iter().for_each(|csv| self.files.save_text(with_ending(path.clone(), "csv"), csv));
            }
            Target::OpenScene | Target::OpenEnvironment => self.open_file(&path),
        }
    }

    /// Takes a typed path; one that would replace a file must be typed twice, as the dialogs of systems ask too.
    fn typed(&mut self, target: Target, text: String) {
        let path = with_ending(from_home(&text), target.file_type().1[0]);
        let replaces = format!("{} is there already; Enter replaces it", path.display());
        let wrong = match (target.is_read(), path.exists(), self.model.question.take()) {
            (true, false, _) => format!("there is no file {}", path.display()),
            (false, true, Some(Question::Path(_, _, wrong))) if wrong.as_ref() != Some(&replaces) => replaces,
            _ => return self.chosen(target, path),
        };
        self.model.question = Some(Question::Path(target, text, Some(wrong)));
    }

    /// Opens a file that was chosen or dropped, by its ending.
    fn open_file(&mut self, path: &Path) {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("").to_ascii_lowercase();
        let Some(name) = std::path::absolute(path).ok().and_then(|path| path.to_str().map(str::to_owned)) else {
            return self.model.messages.problem(format!("{}: this file name is not UTF-8; rename it", path.display()));
        };
        match ending.as_str() {
            "toml" => self.model.ask_for(Request::LoadScene(name)),
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

/// A path as people type it, where `~` stands for their home.
fn from_home(text: &str) -> PathBuf {
    let text = text.trim();
    let in_home = text.strip_prefix("~/").and_then(|rest| Some(std::env::home_dir()?.join(rest)));
    in_home.unwrap_or_else(|| PathBuf::from(text))
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
