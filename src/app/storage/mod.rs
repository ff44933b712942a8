//! What outlives the window: its settings, and work that is not saved yet. [`Storage`] alone knows where the system keeps such things.

#[cfg_attr(target_arch = "wasm32", path = "browser.rs")]
#[cfg_attr(not(target_arch = "wasm32"), path = "desktop.rs")]
mod places;

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use places::Storage;
#[cfg(target_arch = "wasm32")]
pub use places::name_tabs;

/// Scenes that are remembered as opened lately.
const RECENT: usize = 10;

/// What the window keeps from one run to the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Width and height of the window, points.
    pub window: [f64; 2],
    /// Size of letters and widgets, over the normal one.
    pub zoom: f32,
    /// Whether panels are light rather than dark.
    pub is_light: bool,
    /// Whether the hints have done their work.
    pub knows_hints: bool,
    /// Scene files opened or saved lately, the last one first.
    pub recent: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { window: [1280.0, 800.0], zoom: 1.0, is_light: false, knows_hints: false, recent: Vec::new() }
    }
}

impl Settings {
    /// Notes that a scene file was opened or saved.
    pub fn remember(&mut self, path: &str) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(RECENT);
    }
}

/// Work that is not saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unsaved {
    /// The scene's name.
    pub name: String,
    /// The file that it is saved to.
    pub file: Option<PathBuf>,
    /// Folder that relative paths in it start from.
    pub folder: PathBuf,
    /// The tick that was shown.
    pub tick: u64,
    /// The scene's TOML.
    pub scene: String,
}
