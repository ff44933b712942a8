//! Files coming in: environments and texts, each read whole or refused with one line that says what to do.

mod chromaticities;
mod environment;
mod error;
mod exr;
mod light;
mod own;
mod panic_guard;
mod radiance;
mod scene;
mod text;

pub use environment::{MAX_ENVIRONMENT_HEIGHT, MAX_ENVIRONMENT_WIDTH, read_environment};
pub use error::InputError;
pub use light::{load_environment, load_illuminant};
pub use scene::{LoadError, LoadedScene, load_liquid, load_scene, load_scene_with};
pub use text::{MAX_TEXT_BYTES, read_table_text, read_text};
