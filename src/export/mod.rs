//! Files that take long: pictures of any size, sequences and video, and maps of a film. The command line and the window ask for them in the same
//! way: options in plain data, a [`Painter`] that draws, and an [`Observer`] who sees how far the work is, and may stop it.

#[cfg(feature = "gui")]
mod job;
pub mod map;
mod options;
mod painter;
mod progress;
mod sequence;

pub use options::{Format, MAX_SAMPLES, PictureOptions, Quality, parse_size};
pub use painter::Painter;
pub use progress::{Observer, Part, Progress};
pub use sequence::{Sequence, SequenceTarget};
#[cfg(feature = "gui")]
pub use {job::Job, options::check_size};
