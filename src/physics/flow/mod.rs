//! The film's own motion (model T2): vorticity and stream function on the cubed sphere, driven by buoyancy, held back by air and viscosity.
//!
//! On the unit sphere, with lengths in radii and h the thickness,
//!
//! ```text
//! Dζ/Dt = n·(∇ ln h × G) + ν (Δ + 2) ζ − n·curl(αu),     Δψ = ζ,     u = n × ∇ψ
//! ```
//!
//! ν is the kinematic viscosity over R², in 1/s, G gravity over R, in 1/s², α the drag of the air, in 1/s. The film is nearly
//! incompressible in its plane (its Mach number is below 0.1), so u is free of divergence. This is the f64 twin of what the GPU runs, and cases with known
//! answers for both.

mod cases;
mod measure;
mod multigrid;
mod operators;
mod oscillation;
mod solver;

pub use cases::{FlowCase, FlowCaseError, FlowCaseKind, Mode};
pub use measure::{Invariants, invariants, relative_l2};
pub use multigrid::{
    MAX_COARSEST_SWEEPS, Multigrid, SWEEPS, Shift, coarser, coarsest_weights, is_coarsest, sweep_weights,
};
pub use operators::{CellMetric, Order, laplacian, turned_gradient};
pub use oscillation::{Oscillation, fit_oscillation};
pub use solver::{
    AIR_DRAG, CORRECTED_TURN, FOLLOWED_TURN, FlowForces, FlowSolver, MIN_AIR_SPEED, POISSON_CYCLES, VISCOUS_CYCLES,
    VISCOUS_STAGE, advected, stable_step_s,
};
