//! The film model as a list: the operations of a step, in order.
//!
//! Each operation is a pass on the device, with the shader's name, and a function in f64 here. [`Film`](super::Film) and `gpu::film` both go through
//! these lists, and `tests/gpu/film_model.rs` compares what comes out.

/// What is done to a film in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// The logarithm of the thickness where it is now: `flow_thickness`.
    FeelThickness,
    /// What the air around it stirs: `flow_gusts`.
    BlowAir,
    /// What pushes it: `flow_push`.
    Push,
    /// Vorticity and stream function move on by a step: `flow_force`, `flow_trace`, the multigrid solves of viscosity and of ψ, `flow_mirror` and
    /// `flow_pin`.
    StepFlow,
    /// Where the liquid of each cell was when the step began: `trace_flow`, or `trace_step` for flows in closed form.
    TraceStep,
    /// The flow map with the step: `compose_map`.
    ComposeMap,
    /// Whether the map is too distorted to go on: `decide_remap`. If it is, the list [`REMAP`] follows.
    DecideRemap,
}

/// A step of a film that moves by itself. The flow lives half a step ahead of the thickness: it is moved first, by the thickness of now, and
/// then moves the thickness.
pub const FREE_STEP: [Operation; 7] = [
    Operation::FeelThickness,
    Operation::BlowAir,
    Operation::Push,
    Operation::StepFlow,
    Operation::TraceStep,
    Operation::ComposeMap,
    Operation::DecideRemap,
];

/// A step of a film that is moved by a flow in closed form.
pub const PRESCRIBED_STEP: [Operation; 3] = [Operation::TraceStep, Operation::ComposeMap, Operation::DecideRemap];

/// The operations on a film at a remap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RemapOperation {
    /// The tracer is looked up through the map: `sample_tracer`.
    SampleTracer,
    /// It spreads: `diffuse`.
    Diffuse,
    /// Its liquid is restored, and it is the tracer from now on: `conserve` and `balance_film`.
    Settle,
    /// Film leaves at the rim, and is counted: `drain`, `conserve`.
    Drain,
    /// Evaporation ends at black film, and thin film becomes black: `blacken`, `conserve`.
    Blacken,
    /// The map is the identity: `reset_map`.
    ResetMap,
}

/// A remap, for the ticks since the one before.
pub const REMAP: [RemapOperation; 6] = [
    RemapOperation::SampleTracer,
    RemapOperation::Diffuse,
    RemapOperation::Settle,
    RemapOperation::Drain,
    RemapOperation::Blacken,
    RemapOperation::ResetMap,
];
