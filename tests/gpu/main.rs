//! Tests of what the GPU computes against what is true, and of the crate's own rules. See `support` for the adapter they run on.

#[path = "../support/mod.rs"]
mod support;

mod backends;
mod benchmarks;
mod boundaries;
mod breaking;
mod bursting;
mod company;
mod extremes;
mod far;
mod faults;
mod film_model;
mod flow;
mod fuzz;
mod grammar;
mod history;
mod interaction;
mod lamps;
mod layers;
mod layouts;
mod lens;
mod optics;
mod parts;
mod passes;
mod pictures;
mod shader_kinds;
mod shaders;
mod studio;
mod transport;
mod zoom;
