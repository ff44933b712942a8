//! What can go wrong in a studio.

use std::fmt;

use super::{MAX_THICKNESS_NM, MAX_TICKS};
use crate::{
    gpu::GpuError,
    input::LoadError,
    output::OutputError,
    scene::SceneError,
    verify::{reference::ReferenceError, reference_film::ReferenceFilmError},
};

/// Why there is no picture, no film or no colour. Each message is one line that says what is wrong and what to do.
#[derive(thiserror::Error)]
pub enum Error {
    /// The scene, or a file that it names, cannot be loaded.
    #[error(transparent)]
    Scene(#[from] LoadError),
    /// The scene cannot be drawn as it stands.
    #[error(transparent)]
    Shot(#[from] SceneError),
    /// There is no usable adapter, or it failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] OutputError),
    /// A film cannot be read.
    #[error(transparent)]
    Film(#[from] ReferenceError),
    /// The film model in f64 does not take a film.
    #[error(transparent)]
    ReferenceFilm(#[from] ReferenceFilmError),
    /// A picture without pixels.
    #[error("a picture of {}x{} pixels is empty: give at least one pixel in width and height", .0[0], .0[1])]
    Size([u32; 2]),
    /// A time before the film's start, or none at all.
    #[error("{0} s is not a time of a film: give a finite number of seconds, 0 or more")]
    Time(f64),
    /// A time that takes too long to reach.
    #[error("{time_s} s are {ticks} ticks of this scene; at most {MAX_TICKS} can be simulated")]
    TooLate {
        /// The time, s.
        time_s: f64,
        /// Ticks until then.
        ticks: u64,
    },
    /// The scene has fewer bubbles.
    #[error("there is no bubble {index}: the scene has {count}, counted from 0")]
    NoBubble {
        /// The bubble asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// The bubble has burst, and the next one is not blown yet.
    #[error("bubble {bubble} has no film at {time_s} s: it has burst, and the next bubble is not blown yet")]
    NoFilm {
        /// The bubble asked for.
        bubble: usize,
        /// The time, s.
        time_s: f64,
    },
    /// A thickness that no film here has.
    #[error("a thickness of {0} nm is out of range: give 0 to {MAX_THICKNESS_NM} nm")]
    Thickness(f64),
    /// No cosine of an angle at which light meets a film.
    #[error("{0} is not the cosine of an angle of incidence: give 0 to 1, where 1 is along the normal")]
    Cosine(f64),
    /// The device kept no picture.
    #[error("nothing was drawn; please report this scene")]
    NothingDrawn,
}

impl fmt::Debug for Error {
    /// The message: it is what a program shows whose `main` returns this error.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
