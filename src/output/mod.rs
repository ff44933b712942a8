//! Files going out: pictures and tables, each written whole or not at all.

mod atomic;
mod error;
mod exr;
mod icc;
mod metadata;
mod picture;
mod png;
pub mod read_back;
mod table;

pub use atomic::write_atomically;
pub use error::OutputError;
pub use exr::{ExrPicture, ExrPrimaries};
pub use metadata::Metadata;
pub use picture::{Picture, bt709_from_bt2020, save_display, save_radiance, write_text};
pub use png::PngPicture;
pub use table::CsvWriter;
