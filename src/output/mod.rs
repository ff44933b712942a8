//! What goes out: pictures and tables, each file written whole or not at all, and the terminal's lines.

#[cfg(not(target_arch = "wasm32"))]
mod atomic;
#[cfg(target_arch = "wasm32")]
mod download;
mod error;
mod exr;
mod exr_channels;
#[cfg(not(target_arch = "wasm32"))]
mod film_table;
mod frame_rate;
mod icc;
#[cfg(not(target_arch = "wasm32"))]
mod ktx2;
mod metadata;
mod picture;
mod png;
pub mod read_back;
#[cfg(not(target_arch = "wasm32"))]
mod signals;
mod stream;
mod table;
#[cfg(not(target_arch = "wasm32"))]
mod video;

#[cfg(not(target_arch = "wasm32"))]
pub use atomic::{UnfinishedFile, abandon_files, check_target, write_atomically};
#[cfg(target_arch = "wasm32")]
pub use download::write_atomically;
pub use error::OutputError;
pub use exr::{ExrPicture, ExrPrimaries};
pub use exr_channels::ExrChannels;
#[cfg(not(target_arch = "wasm32"))]
pub use film_table::{FilmTableFile, TABLE_LAYERS, TableFormat, TablePrecision};
pub use frame_rate::{FrameRate, FrameRateError};
pub use metadata::Metadata;
pub use picture::{Picture, bt709_from_bt2020, save_display, save_radiance, write_text};
pub use png::PngPicture;
#[cfg(not(target_arch = "wasm32"))]
pub use signals::watch_signals;
pub use stream::{StreamError, print, tell};
pub use table::CsvWriter;
#[cfg(not(target_arch = "wasm32"))]
pub use video::{Video, VideoError, VideoFormat, VideoWriter};
