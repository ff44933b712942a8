//! Soap bubbles with correct thin-film interference, on wgpu.
//!
//! A picture takes three lines; [`studio`] does it, and also reads films and computes colours:
//!
//! ```no_run
//! let scene = soapfilm::load_scene("windows")?;
//! let mut studio = soapfilm::Studio::open()?;
//! studio.render(&scene, [1280, 720], 5.0)?.save("bubble.png")?;
//! # Ok::<(), soapfilm::Error>(())
//! ```
//!
//! The colours of the film come from spectral optics, the film flows, and the two are one field: the thickness that the simulation
//! moves is the thickness that the shader colours.
//!
//! # Layers
//!
//! `use` goes only downwards in this table, and nowhere in circles; a test holds the crate to it.
//!
//! | module | question it answers | knows nothing of |
//! |---|---|---|
//! | `web` | who asks in a browser: the page around the window; on `wasm32` alone | the command line |
//! | [`cli`], [`app`] | who asks: the command line, and the window | each other |
//! | `export` | files that take long, for both of them: large pictures, sequences, video; not on `wasm32` | the command line, windows |
//! | [`studio`] | the library's front door: a picture, a film or a colour in a few lines | the command line, windows |
//! | [`output`], [`input`] | files: pictures, tables and reports out; environments and spectra in | windows, GPUs |
//! | [`verify`] | whether it is right: measurements against references | windows, files |
//! | [`gpu`] | HOW: one module for each pass, named like its shader, what composes them, and the executor that walks a plan | windows, files |
//! | [`plan`] | WHEN: a pure function from a frame request and the state of the GPU to the passes in between | wgpu, windows, files |
//! | [`scene`] | WHAT is shown: plain data, TOML, presets, events | how it is computed or drawn |
//! | [`physics`] | what is TRUE: f64 on the CPU | wgpu, scene files |

#![warn(missing_docs)]
// They panic where a stream is closed or full: `output::print` and `output::tell` do not.
#![cfg_attr(not(test), warn(clippy::print_stdout, clippy::print_stderr))]

#[cfg(feature = "gui")]
pub mod app;
#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
#[cfg(not(target_arch = "wasm32"))]
mod export;
pub mod gpu;
pub mod input;
pub mod output;
mod parallel;
pub mod physics;
pub mod plan;
pub mod scene;
#[cfg(not(target_arch = "wasm32"))]
pub mod studio;
/// In a browser, what the window reads of films and pictures.
#[cfg(target_arch = "wasm32")]
pub mod studio {
    mod difference;
    mod sight;

    pub use difference::{Difference, difference};
    pub use sight::{FilmInFront, FilmView, FilmsRead, WallInSight, thickness_at, walls_in_sight};
}
#[cfg(not(target_arch = "wasm32"))]
pub mod verify;
/// In a browser, what the probe reads.
#[cfg(target_arch = "wasm32")]
pub mod verify {
    pub mod reference;
}
#[cfg(all(feature = "gui", target_arch = "wasm32"))]
pub mod web;
mod words;

pub use glam;
pub use gpu::AdapterChoice;
pub use input::{LoadedScene, load_scene};
pub use physics::environment::CubeMap;
pub use scene::Scene;
#[cfg(not(target_arch = "wasm32"))]
pub use studio::{Colour, Error, FilmCell, Picture, Radiance, Studio, colour};
pub use words::{UnknownWord, Words};
