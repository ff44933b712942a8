//! What is true: optics, colour, the sphere's grid, transport and film motion in f64 on the CPU.
//!
//! Each formula stands here once more than in the shaders, on purpose: this copy is the truth, WGSL is the fast copy, and tests tie
//! the two together.

pub mod bubble;
pub(crate) mod bulk;
pub mod colour;
pub mod curve;
pub mod environment;
pub mod film;
pub mod flow;
pub mod optics;
pub mod picture;
pub mod spectra;
pub mod sphere;
pub mod table;
pub mod timeline;
pub mod transport;
