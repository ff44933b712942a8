//! Files coming in: environments and texts, each read whole or refused with a one-line message that says what to do.

mod chromaticities;
mod environment;
mod error;
mod exr;
#[cfg_attr(target_arch = "wasm32", path = "page_file.rs")]
mod file;
mod lesson;
mod light;
#[cfg(target_arch = "wasm32")]
mod made_elsewhere;
mod own;
mod panic_guard;
mod picture;
mod plate;
mod radiance;
mod scene;
mod text;

pub use environment::read_environment;
pub use error::{InputError, LoadError, MAX_ENVIRONMENT_HEIGHT, MAX_ENVIRONMENT_WIDTH};
#[cfg(target_arch = "wasm32")]
pub use file::keep_file;
pub use lesson::{Opened, load_step, open};
pub use light::{load_environment, load_illuminant, load_illuminant_of};
#[cfg(target_arch = "wasm32")]
pub use made_elsewhere::{LightNamed, MadeEnvironment, keep_environment};
pub use plate::read_plate;
pub use scene::{LoadedScene, light_of_scene, load_liquid, load_scene, load_scene_with};
pub use text::{MAX_TEXT_BYTES, read_table_text, read_text};
