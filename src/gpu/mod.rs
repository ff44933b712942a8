//! How: one module for each pass, named like its shader in `shaders/pass/`, and the [`Renderer`] that walks a [`Plan`](crate::plan::Plan).
//!
//! Nothing here decides whether a pass runs: a pass is recorded from its key alone, and the plan says which.

mod abilities;
pub mod add_light;
pub mod bake_table;
pub mod bands;
pub mod blacken;
pub mod compose_map;
pub mod conserve;
pub mod copies;
pub mod correct_error;
pub mod decide_remap;
pub mod device;
pub mod diffuse;
pub mod drain;
pub mod draw;
pub mod environment;
pub mod film;
pub mod flow;
#[cfg(not(target_arch = "wasm32"))]
pub mod flow_case;
pub mod flow_halo;
mod late_errors;
pub mod open_hole;
pub mod pipelines;
#[cfg(not(target_arch = "wasm32"))]
pub mod probe_colour;
pub mod read_film;
pub mod readback;
pub mod renderer;
pub mod reset_map;
pub mod rings;
pub mod sample_tracer;
pub mod settle_tracer;
pub mod shaders;
pub mod show_film;
pub mod timing;
pub mod tonemap;
pub mod trace_step;
#[cfg(not(target_arch = "wasm32"))]
pub mod transport_case;

pub use device::{AdapterChoice, Gpu, GpuError};
pub use renderer::Renderer;
