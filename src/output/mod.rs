//! What goes out: pictures and tables, each file written whole or not at all, and the terminal's lines.

mod atomic;
mod error;
mod exr;
mod exr_channels;
mod film_table;
mod frame_rate;
mod icc;
mod ktx2;
mod metadata;
mod picture;
mod png;
pub mod read_back;
mod signals;
mod stream;
mod table;

pub use atomic::{check_target, write_atomically};
pub use error::OutputError;
pub use exr::{ExrPicture, ExrPrimaries};
pub use exr_channels::ExrChannels;
pub use film_table::{FilmTableFile, TABLE_LAYERS, TableFormat, TablePrecision};
pub use frame_rate::{FrameRate, FrameRateError};
pub use metadata::Metadata;
pub use picture::{Picture, bt709_from_bt2020, save_display, save_radiance, write_text};
pub use png::PngPicture;
pub use signals::watch_signals;
pub use stream::{StreamError, print, tell};
pub use table::CsvWriter;
