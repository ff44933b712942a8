//! The window: what is shown, the edits, keys and panels, and the loop that redraws when something changed and sleeps otherwise.
//!
//! | module | does |
//! |---|---|
//! | [`model`] | the state: scene, clock, messages, requests; knows neither window nor GPU |
//! | [`clock`], [`time_line`], [`orbit`], [`history`] | time, camera and events as pure functions of the model |
//! | [`panels`], [`keys`] | how people change the model |
//! | `edit`, [`undo`] | the one gate for changes of the scene, and what takes them back |
//! | [`files`], [`storage`], `keeper` | the system: dialogs, loading and saving; settings and unsaved work |
//! | `system` | what differs between desktops and browsers: threads, dialogs, paths |
//! | `exports` | the dialog for pictures, video and maps, and the queue of what is being made |
//! | [`request`] | what goes from the model to the system, and the questions that come before |
//! | [`compare`], [`mod@reference`] | a kept picture beside another one, and the reference picture in f64 |
//! | [`course`] | a lesson that is taken, and how its answers are judged |
//! | [`probe`], `film_reader` | numbers of the film under the pointer, and all that is known of a pinned point |
//! | [`overlay`], [`colour_map`] | false colour over the picture, and the profile of a film along a line |
//! | `figure` | a plot as a picture for a file |
//! | `window`, `frame`, `input` | the event loop, one redraw, and presses one by one |
//! | `producer`, `render_thread` | what a frame needs of the CPU, computed beside the window; pictures, drawn beside it |
//! | `step_pace` | how far films catch up in a frame |
//! | `stage`, `surface`, `paint`, `capture`, `reload` | the GPU's side: what must be recreated when a device is lost |

pub mod clock;
pub mod colour_map;
pub mod compare;
pub mod costs;
pub mod course;
mod edit;
#[cfg(not(target_arch = "wasm32"))]
mod exports;
pub mod files;
pub mod history;
pub mod keys;
#[cfg(any(target_arch = "wasm32", test))]
pub mod link;
pub mod messages;
pub mod model;
pub mod orbit;
pub mod overlay;
pub mod panels;
pub mod probe;
pub mod reference;
pub mod request;
pub mod storage;
pub mod time_line;
pub mod undo;

mod capture;
mod figure;
mod film_reader;
pub(crate) mod frame;
mod gizmo;
mod group;
mod input;
mod keeper;
mod lamps;
mod paint;
mod producer;
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
mod reload;
mod render_thread;
mod sight;
mod spectrum;
mod stage;
mod step_pace;
mod style;
mod surface;
#[cfg_attr(target_arch = "wasm32", path = "system/browser.rs")]
#[cfg_attr(not(target_arch = "wasm32"), path = "system/desktop.rs")]
pub(crate) mod system;
mod tools;
mod wand;
pub(crate) mod window;

use crate::gpu::GpuError;
#[cfg(not(target_arch = "wasm32"))]
use crate::{gpu::AdapterChoice, input::LoadedScene};

/// Why the window cannot be opened, or had to be closed.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// No display, or one that fails.
    #[error("no window can be opened here ({}); `soapfilm render` draws without one", without_place(.0))]
    EventLoop(winit::error::EventLoopError),
    /// The system refuses a window.
    #[error("the system refused to open a window: {}", without_place(.0))]
    Window(winit::error::OsError),
    /// The adapter cannot draw into the window.
    #[error("the graphics driver cannot draw into a window: {0}; choose another with --adapter or --backend")]
    Surface(String),
    /// No GPU, or a GPU that keeps failing.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

impl From<winit::error::EventLoopError> for AppError {
    fn from(error: winit::error::EventLoopError) -> Self {
        Self::EventLoop(error)
    }
}

impl From<winit::error::OsError> for AppError {
    fn from(error: winit::error::OsError) -> Self {
        Self::Window(error)
    }
}

/// The message of winit without the place in its source, which precedes the message of the system.
fn without_place(error: &dyn std::fmt::Display) -> String {
    let told = error.to_string();
    let place = told.strip_prefix("os error at ").and_then(|told| told.split_once(": "));
    place.map_or(told.as_str(), |(_, reason)| reason).trim_end_matches('.').to_owned()
}

/// Opens the window on a scene, and returns once it is closed.
///
/// # Errors
/// There is no display or no usable adapter, or the device was lost and no other could be opened.
#[cfg(not(target_arch = "wasm32"))]
pub fn run(loaded: LoadedScene, choice: &AdapterChoice) -> Result<(), AppError> {
    window::run(model::Model::new(loaded), choice)
}
