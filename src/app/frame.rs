//! One redraw: time, panels, picture, window, and when the next one is due.

mod overlays;
mod pictures;
mod readbacks;

use std::{sync::Arc, time::Duration};

use egui::{Rect, ViewportInfo};
use web_time::Instant;
use winit::{event_loop::ActiveEventLoop, window::Window};

use self::pictures::Pictures;
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
use super::reload::ShaderWatch;
use super::{
    capture::Capture,
    compare::Want,
    files::Files,
    film_reader::FilmReader,
    input,
    model::Model,
    paint::{Contents, Painted},
    panels,
    producer::Producer,
    request::Request,
    stage::Stage,
};
use crate::{gpu::readback::Readback, plan::TonemapKey};

/// Time between two looks at the clock while nothing but its reading changes.
const READING: Duration = Duration::from_millis(400);
/// Time between two pictures of a turntable.
const TURN: Duration = Duration::from_millis(16);
/// Time until a surface that had no frame is asked again.
const ASK_AGAIN: Duration = Duration::from_millis(50);

/// How far the window is with the picture that its model asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Progress {
    /// It is being made.
    Under,
    /// It is on the window.
    Done,
    /// It cannot be made.
    Failed(String),
}

/// The window with all that it needs to draw itself.
pub struct View {
    /// The window.
    pub window: Arc<Window>,
    /// What the user does, as egui sees it.
    pub egui: egui_winit::State,
    /// The device's side.
    pub stage: Stage,
    /// Whether the system asks for the window to be drawn again.
    pub exposed: bool,
    /// How far the picture is.
    pub progress: Progress,
    /// Size of the picture, pixels.
    pub picture_size: [u32; 2],
    title: String,
    info: ViewportInfo,
    captures: Vec<Capture>,
    pictures: Pictures,
    reader: FilmReader,
    /// What is laid over the picture was made of this.
    overlaid: Option<overlays::Overlaid>,
    /// The shown picture on its way back, what for, and its size.
    compared: Option<(Want, [u32; 2], Readback)>,
    /// What the picture shows.
    shown: Option<TonemapKey>,
    last_redraw: Instant,
    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    watch: Option<ShaderWatch>,
}

/// What one redraw found out about when the next is due.
struct Due {
    now: Instant,
    at: Option<Instant>,
}

impl Due {
    fn after(&mut self, wait: Duration) {
        // A wait beyond the end of time is none at all.
        self.at_latest(self.now.checked_add(wait));
    }

    fn at_latest(&mut self, instant: Option<Instant>) {
        self.at = [self.at, instant].into_iter().flatten().min();
    }
}

impl View {
    /// A view on a new window.
    pub fn new(window: Arc<Window>, egui: egui_winit::State, stage: Stage, producer: Producer) -> Self {
        Self {
            window,
            egui,
            stage,
            exposed: true,
            progress: Progress::Under,
            picture_size: [1, 1],
            title: String::new(),
            info: ViewportInfo::default(),
            captures: Vec::new(),
            pictures: Pictures::new(producer),
            reader: FilmReader::default(),
            overlaid: None,
            compared: None,
            shown: None,
            last_redraw: Instant::now(),
            #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
            watch: ShaderWatch::of_source(),
        }
    }

    /// Draws what has changed, and returns when there will be more to draw.
    pub fn redraw(&mut self, event_loop: &ActiveEventLoop, model: &mut Model, files: &Files) -> Option<Instant> {
        let size = <[u32; 2]>::from(self.window.inner_size());
        if size.contains(&0) {
            return None;
        }
        self.check(model);
        self.tell_system(model);
        let mut due = Due { now: Instant::now(), at: None };
        let mut output = self.run_panels(event_loop, model, &mut due);
        // After the panels: what is changed there happens at the tick that its user sees.
        let first_tick = self.pass_time(model, due.now);
        let moves = self.draw_picture(model, first_tick, &mut due);
        self.read_back(model, files, &mut due);
        self.stage.painter.update_textures(&self.stage.gpu, &mut output.full.textures_delta);
        let painted = if self.pictures.have_panels() { self.paint(&mut output, size, moves) } else { Painted::Done };
        self.schedule(model, painted, moves, &mut due);
        due.at
    }

    /// The title follows the scene, and the settings the window's size.
    fn tell_system(&mut self, model: &mut Model) {
        let title = model.title();
        if self.title != title {
            self.window.set_title(&title);
            self.title = title;
        }
        if !model.presents {
            let size = self.window.inner_size().to_logical::<f64>(self.window.scale_factor());
            model.settings.window = [size.width, size.height];
        }
    }

    /// Lets film time pass, unless the films are behind it; returns the tick before.
    fn pass_time(&mut self, model: &mut Model, now: Instant) -> u64 {
        let wall_s = now.duration_since(std::mem::replace(&mut self.last_redraw, now)).as_secs_f64();
        let first_tick = model.clock.tick;
        model.advance(wall_s);
        first_tick
    }

    fn run_panels(&mut self, event_loop: &ActiveEventLoop, model: &mut Model, due: &mut Due) -> Output {
        let ctx = self.egui.egui_ctx().clone();
        let mut full = egui::FullOutput::default();
        let mut rect = Rect::NOTHING;
        for input in input::one_by_one(self.egui.take_egui_input(&self.window)) {
            full.append(ctx.run_ui(input, |ui| {
                let picture = panels::show(ui, model);
                rect = picture.rect;
                model.move_camera(&picture.gesture, f64::from(rect.aspect_ratio().max(0.01)));
            }));
        }
        let platform = std::mem::take(&mut full.platform_output);
        self.egui.handle_platform_output_with_event_loop(&self.window, event_loop, platform);
        if let Some(root) = full.viewport_output.get_mut(&egui::ViewportId::ROOT) {
            let commands = std::mem::take(&mut root.commands);
            if commands.contains(&egui::ViewportCommand::Close) {
                model.ask_for(Request::Quit);
            }
            // Nothing here asks for screenshots or the clipboard, so no action comes back.
            egui_winit::process_viewport_commands(&ctx, &mut self.info, commands, &self.window, &mut Vec::new());
            due.after(root.repaint_delay);
        }
        let (rect, size) =
            pixel_rect(rect, full.pixels_per_point, self.stage.gpu.device.limits().max_texture_dimension_2d);
        self.picture_size = size;
        Output { full, rect }
    }

    fn paint(&mut self, output: &mut Output, size: [u32; 2], moves: bool) -> Painted {
        let Stage { gpu, drawing, surface, painter } = &mut self.stage;
        let contents = Contents {
            shapes: std::mem::take(&mut output.full.shapes),
            picture: drawing.picture().map(|view| (view, output.rect)),
            is_new: std::mem::take(&mut self.exposed) || moves,
            size,
            pixels_per_point: output.full.pixels_per_point,
        };
        painter.paint(gpu, surface, self.egui.egui_ctx(), contents)
    }

    fn schedule(&mut self, model: &Model, painted: Painted, moves: bool, due: &mut Due) {
        if model.turntable_deg_s != 0.0 && model.scene.camera.keyframes.is_empty() {
            due.after(TURN);
        }
        if let Some(wait_s) = model.clock.until_next_s(&model.scene.motion) {
            let wait = Duration::from_secs_f64(wait_s);
            due.after(if moves || model.will_move() { wait } else { wait.max(READING) });
        }
        #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
        due.at_latest(self.watch.as_ref().map(ShaderWatch::next));
        match painted {
            Painted::Done => {}
            Painted::Later => due.after(ASK_AGAIN),
            // The system will say when the window can be seen again.
            Painted::Hidden => due.at = None,
        }
    }

    /// Whether the device is lost, and everything on it with it.
    pub fn is_lost(&self) -> bool {
        self.stage.drawing.is_lost()
    }

    /// Reports what the device has refused; reloads changed shaders.
    fn check(&mut self, model: &mut Model) {
        if let Err(error) = self.stage.drawing.check() {
            self.progress = Progress::Failed(error.to_string());
            model.messages.problem(error.to_string());
        }
        #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
        self.reload_shaders(model);
    }

    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    fn reload_shaders(&mut self, model: &mut Model) {
        let Some(folder) = self.watch.as_mut().and_then(|watch| watch.changed(Instant::now())) else { return };
        let library = crate::gpu::shaders::Library::Directory(folder.to_owned());
        let gpu = &self.stage.drawing.gpu;
        match gpu.pipelines.reload(&gpu.device, library) {
            Ok(()) => {
                self.pictures.forget();
                model.messages.withdraw("shader ");
                model.messages.note("Shaders reloaded");
            }
            Err(error) => model.messages.problem(error.to_string()),
        }
    }

    /// Loses the devices on purpose, to try out the recovery.
    #[cfg(debug_assertions)]
    pub fn lose_device(&self) {
        self.stage.gpu.device.destroy();
        self.stage.drawing.gpu.device.destroy();
    }
}

/// What the panels left to be painted.
struct Output {
    full: egui::FullOutput,
    rect: Rect,
}

/// The picture's place on whole pixels, in points, and its size in pixels, at least one and at most what a texture holds.
fn pixel_rect(rect: Rect, pixels_per_point: f32, max: u32) -> (Rect, [u32; 2]) {
    let pixels = |points: f32| (points * pixels_per_point).round().clamp(0.0, max as f32);
    let min = [pixels(rect.min.x), pixels(rect.min.y)];
    let size = [pixels(rect.max.x) - min[0], pixels(rect.max.y) - min[1]].map(|size| size.max(1.0));
    let points = |pixels: [f32; 2]| egui::vec2(pixels[0], pixels[1]) / pixels_per_point;
    (Rect::from_min_size(points(min).to_pos2(), points(size)), size.map(|size| size as u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn the_picture_stands_on_whole_pixels() {
        let rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(971.3, 799.9));
        let (placed, size) = pixel_rect(rect, 1.25, 8192);
        assert_eq!(size, [1214, 1000]);
        assert_eq!((placed.max * 1.25).round(), pos2(1214.0, 1000.0));
    }

    #[test]
    fn no_room_is_one_pixel() {
        for rect in [Rect::NOTHING, Rect::from_min_max(pos2(200.0, 0.0), pos2(150.0, 90.0))] {
            let (placed, size) = pixel_rect(rect, 1.0, 8192);
            assert!(size[0] == 1 && size[1] >= 1 && size[1] <= 90, "{size:?}");
            assert!(placed.is_finite());
        }
    }
}
