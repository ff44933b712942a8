//! How: [`passes`], one module for each, named like its shader in `shaders/pass/`, what composes them, and the [`Renderer`] that walks a
//! [`Plan`](crate::plan::Plan).
//!
//! Nothing here decides whether a pass runs: a pass is recorded from its key alone, and the plan says which. From the ground up: [`device`],
//! its pipelines and the recorder; [`kernel`], by which shaders are declared and called; grids and what else passes share; [`passes`];
//! [`flow`], [`film`] and [`draw`], which compose them.

mod abilities;
mod adapter;
pub mod composition;
pub mod control;
pub mod copies;
pub mod device;
pub mod draw;
pub mod environment;
mod error;
pub mod film;
mod film_atlas;
pub mod flow;
#[cfg(not(target_arch = "wasm32"))]
pub mod flow_case;
pub mod formats;
pub mod grid;
pub mod kernel;
mod late_errors;
pub mod panel_texture;
pub mod passes;
pub mod pipelines;
mod plate;
pub mod quadrature;
pub mod readback;
pub mod renderer;
pub mod rings;
pub mod shaders;
pub mod shown_film;
pub mod specialise;
pub mod target;
pub mod timing;
#[cfg(not(target_arch = "wasm32"))]
pub mod transport_case;
pub mod uniform_buffer;

pub use adapter::AdapterChoice;
pub use device::{Gpu, GpuError};
pub use renderer::Renderer;
