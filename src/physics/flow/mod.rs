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
mod force;
mod measure;
mod mirror_vorticity;
mod multigrid;
mod operators;
mod oscillation;
mod pinned_region;
mod solver;
mod trace;

pub use cases::{FlowCase, FlowCaseError, FlowCaseKind, Mode};
pub use force::{AIR_DRAG, FlowForces, MIN_AIR_SPEED, VISCOUS_STAGE};
pub use measure::{Invariants, invariants, relative_l2};
pub use mirror_vorticity::mirrored;
pub use multigrid::{
    MAX_COARSEST_SWEEPS, Multigrid, SWEEPS, Shift, coarser, coarsest_weights, is_coarsest, sweep_weights,
};
pub use operators::{CellMetric, Order, laplacian, laplacian_at, turned_gradient};
pub use oscillation::{Oscillation, fit_oscillation};
pub use pinned_region::PinnedRegion;
pub use solver::{
    CORRECTED_TURN, FOLLOWED_TURN, FlowSolver, POISSON_CYCLES, VISCOUS_CYCLES, stable_step_s,
};
pub use trace::{advected, origin};
