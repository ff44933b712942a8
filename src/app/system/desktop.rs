//! What a desktop has: threads, file dialogs, paths.

use std::{
    io,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use crate::{
    app::model::Target,
    gpu::{AdapterChoice, Gpu, GpuError},
};

/// A dialog that ends sooner than this without an answer was never seen.
const UNSEEN: Duration = Duration::from_millis(250);

/// The device for a window: its own.
pub async fn device(
    instance: wgpu::Instance,
    choice: &AdapterChoice,
    surface: &wgpu::Surface<'_>,
) -> Result<Gpu, GpuError> {
    Gpu::on_instance(instance, choice, Some(surface)).await
}

/// Waits for a device that is being opened.
pub fn finish(opening: impl Future<Output = ()>) {
    pollster::block_on(opening);
}

/// Runs a piece of work that takes long on a thread of its own.
pub fn spawn(job: impl FnOnce() + Send + 'static) -> io::Result<()> {
    std::thread::Builder::new().name("soapfilm files".to_owned()).spawn(job).map(|_| ())
}

/// The path from the root.
pub fn whole_path(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// Asks for a file: `answer` gets its path, none if the user wants none, or why there is no dialog. The dialog is made here, on the window's
/// thread, as macOS demands, and waited for on another.
pub fn choose_file(
    target: Target,
    folder: &Path,
    stem: &str,
    window: &winit::window::Window,
    answer: impl FnOnce(Result<Option<PathBuf>, String>) + Send + 'static,
) {
    let dialog = rfd::AsyncFileDialog::new().set_parent(window).set_directory(folder);
    let (name, endings) = target.file_type();
    let dialog = dialog.add_filter(name, endings);
    if target.is_read() {
        wait_for(dialog.pick_file(), answer);
    } else {
        wait_for(dialog.set_file_name(format!("{stem}.{}", endings[0])).save_file(), answer);
    }
}

fn wait_for(
    chosen: impl Future<Output = Option<rfd::FileHandle>> + Send + 'static,
    answer: impl FnOnce(Result<Option<PathBuf>, String>) + Send + 'static,
) {
    let asked = Instant::now();
    let job = move || {
        let file = pollster::block_on(chosen);
        answer(if file.is_none() && asked.elapsed() < UNSEEN {
            let advice = "no file dialog could be opened: install xdg-desktop-portal or zenity, or drop files on the window";
            Err(advice.to_owned())
        } else {
            Ok(file.map(|file| file.path().to_owned()))
        });
    };
    if let Err(error) = spawn(job) {
        log::error!("no thread could be started: {error}");
    }
}
