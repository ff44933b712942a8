//! The passes, one module each, named like its shader in `shaders/pass/`: the kernels with the structs that they read, and what records
//! them where that is more than a call. Nothing here knows of films or flows as a whole: [`film`](super::film) and [`flow`](super::flow)
//! compose passes.

pub mod add_light;
pub mod backdrop;
pub mod bake_table;
pub mod balance_film;
pub mod blacken;
pub mod bodies;
pub mod bubble;
pub mod compose_map;
pub mod conserve;
pub mod correct_error;
pub mod decide_remap;
pub mod diffuse;
pub mod drain;
pub mod finish;
pub mod flow_coarse;
pub mod flow_combine;
pub mod flow_correct;
pub mod flow_force;
pub mod flow_gusts;
pub mod flow_halo;
pub mod flow_measure;
pub mod flow_mirror;
pub mod flow_pin;
pub mod flow_push;
pub mod flow_residual;
pub mod flow_sweep;
pub mod flow_thickness;
pub mod flow_trace;
pub mod flow_velocity;
pub mod lay_plate;
pub mod open_hole;
pub mod pair_rows;
#[cfg(not(target_arch = "wasm32"))]
pub mod probe_colour;
pub mod read_film;
pub mod reset_map;
pub mod sample_tracer;
pub mod small_bubbles;
pub mod tonemap;
pub mod trace_flow;
pub mod trace_step;

use super::kernel::Kernel;

/// Every kernel, pass by pass: what tests hold against the shaders, of which they find each that is missing here.
#[must_use]
pub fn kernels() -> Vec<Kernel> {
    let passes = [
        add_light::kernels(),
        backdrop::kernels(),
        balance_film::kernels(),
        bake_table::kernels(),
        blacken::kernels(),
        bodies::kernels(),
        bubble::kernels(),
        compose_map::kernels(),
        conserve::kernels(),
        correct_error::kernels(),
        decide_remap::kernels(),
        diffuse::kernels(),
        drain::kernels(),
        finish::kernels(),
        flow_coarse::kernels(),
        flow_combine::kernels(),
        flow_correct::kernels(),
        flow_force::kernels(),
        flow_gusts::kernels(),
        flow_halo::kernels(),
        flow_pin::kernels(),
        flow_mirror::kernels(),
        flow_measure::kernels(),
        flow_push::kernels(),
        flow_residual::kernels(),
        flow_sweep::kernels(),
        flow_thickness::kernels(),
        flow_trace::kernels(),
        flow_velocity::kernels(),
        lay_plate::kernels(),
        open_hole::kernels(),
        pair_rows::kernels(),
        #[cfg(not(target_arch = "wasm32"))]
        probe_colour::kernels(),
        read_film::kernels(),
        reset_map::kernels(),
        sample_tracer::kernels(),
        small_bubbles::kernels(),
        tonemap::kernels(),
        trace_flow::kernels(),
        trace_step::kernels(),
    ];
    passes.into_iter().flatten().collect()
}
