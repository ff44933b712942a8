//! What a desktop has: threads, file dialogs, paths.

use std::{
    io,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

use include_dir::{Dir, include_dir};
use winit::{
    dpi::LogicalSize,
    event_loop::ActiveEventLoop,
    window::{Window, WindowAttributes},
};

use crate::{
    app::request::Target,
    gpu::{AdapterChoice, Gpu, GpuError},
    plan::{Product, Work},
    scene::Light,
    verify::trial,
};

/// A dialog that ends sooner than this without an answer was never seen.
const UNSEEN: Duration = Duration::from_millis(250);

/// The device for a window: its own.
pub async fn device(
    instance: wgpu::Instance,
    choice: &AdapterChoice,
    surface: &wgpu::Surface<'_>,
) -> Result<Gpu, GpuError> {
    let gpu = Gpu::on_instance(instance, choice, Some(surface)).await?;
    trial(&gpu)?;
    Ok(gpu)
}

/// A window of a size in points, or as much of it as the screen holds.
pub fn sized(event_loop: &ActiveEventLoop, attributes: WindowAttributes, wanted: [f64; 2]) -> WindowAttributes {
    let screen = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
    let room = screen.map(|screen| screen.size().to_logical::<f64>(screen.scale_factor()));
    // Some systems do not tell how large it is.
    let room = room.filter(|room| room.width > 0.0 && room.height > 0.0);
    let [width, height] = room.map_or(wanted, |room| [wanted[0].min(room.width), wanted[1].min(room.height)]);
    attributes.with_inner_size(LogicalSize::new(width, height)).with_min_inner_size(LogicalSize::new(320, 240))
}

/// Ends the program.
pub fn end(event_loop: &ActiveEventLoop) {
    event_loop.exit();
}

/// Waits for a device that is being opened.
pub fn finish(opening: impl Future<Output = ()>) {
    pollster::block_on(opening);
}

/// Runs a piece of work that takes long on a thread of its own.
pub fn spawn(job: impl FnOnce() + Send + 'static) -> io::Result<()> {
    std::thread::Builder::new().name("soapfilm files".to_owned()).spawn(job).map(|_| ())
}

/// Runs work that loads the environment of a light on a thread of its own.
pub fn spawn_lit(
    _: impl FnOnce() -> Option<(Light, PathBuf)> + Send + 'static,
    job: impl FnOnce() + Send + 'static,
) -> io::Result<()> {
    spawn(job)
}

/// Does work on a thread of its own.
pub fn compute(work: Work, answer: impl FnOnce(Product) + Send + 'static) -> io::Result<()> {
    spawn(move || answer(work.done()))
}

/// Pictures of the presets, made by `./dev thumbnails`.
static THUMBNAILS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/thumbnails");

/// The small picture of a preset, a PNG file; empty if there is none. A desktop has it at once.
pub fn thumbnail(name: &str) -> Option<Arc<[u8]>> {
    Some(THUMBNAILS.get_file(format!("{name}.png")).map_or_else(Arc::default, |file| file.contents().into()))
}

/// Whether a file can be opened another time.
pub const FILES_LAST: bool = true;

/// The path from the root.
pub fn whole_path(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// The system has no dialog for files.
pub struct NoDialog;

/// Asks for a file: `answer` gets its path, or none if the user wants none. `name` is what a new file is called at first. The dialog is made here, on the window's
/// thread, as macOS demands, and waited for on another.
pub fn choose_file(
    target: Target,
    folder: &Path,
    name: String,
    window: &Window,
    answer: impl FnOnce(Result<Option<PathBuf>, NoDialog>) + Send + 'static,
) {
    let dialog = rfd::AsyncFileDialog::new().set_parent(window).set_directory(folder);
    let (kind, endings) = target.file_type();
    let dialog = if endings.is_empty() { dialog } else { dialog.add_filter(kind, endings) };
    if target.is_read() {
        wait_for(dialog.pick_file(), answer);
    } else {
        wait_for(dialog.set_file_name(name).save_file(), answer);
    }
}

fn wait_for(
    chosen: impl Future<Output = Option<rfd::FileHandle>> + Send + 'static,
    answer: impl FnOnce(Result<Option<PathBuf>, NoDialog>) + Send + 'static,
) {
    let asked = Instant::now();
    let job = move || {
        let file = pollster::block_on(chosen);
        let is_unseen = file.is_none() && asked.elapsed() < UNSEEN;
        answer(if is_unseen { Err(NoDialog) } else { Ok(file.map(|file| file.path().to_owned())) });
    };
    if let Err(error) = spawn(job) {
        log::error!("no thread could be started: {error}");
    }
}
