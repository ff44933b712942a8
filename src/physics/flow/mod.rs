//! The film's own motion: vorticity and stream function on the cubed sphere, driven by weight, held back by air and viscosity.
//!
//! On the unit sphere, with lengths in radii and h the thickness (with the symbols of [`film`](crate::physics::film)),
//!
//! ```text
//! Dζ/Dt = n·(∇ ln h × G) + ν (Δ + 2) ζ − n·curl(α u) + F,     Δψ = ζ,     u = n × ∇ψ                 (F1)
//! ```
//!
//! A step of vorticity from t − ½dt to t + ½dt, given ln h at t, is built up in this order:
//!
//! | equation | what is done | where |
//! |---|---|---|
//! | (F2) | forces and drag act exactly for half a step, before and after | `force.rs` |
//! | (F3) | liquid is traced back by the implicit midpoint rule, and ζ is looked up there | `trace.rs` |
//! | (F4) | it is traced in the velocity of the middle of the step, 1.5 u(t − ½dt) − 0.5 u(t − 3/2 dt), or by a trial | `solver.rs` |
//! | (F5) | viscosity acts by an L-stable rule of two implicit stages, S (S a + b), S = (1 − ε (Δ + 2))⁻¹ | `solver.rs` |
//! | (F6) | ψ and S are found by multigrid, for (Δ − k) ψ = f | `multigrid.rs` |
//! | (F7) | u = n × ∇ψ and Δ are differenced in panel coordinates | `operators.rs` |
//! | (F8) | steps are stable up to 2/√(\|G\| \|∇ ln h\|) | [`stable_step_s`] |
//! | (F9) | beyond a rim stands the image of ζ | `mirror_vorticity.rs` |
//! | (F10) | in a drop nothing flows | `pinned_region.rs` |
//!
//! This is the f64 twin of what the GPU runs, and cases with known answers for both: a Rossby–Haurwitz wave, jets, sloshing, viscous decay.

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
pub use solver::{CORRECTED_TURN, FOLLOWED_TURN, FlowSolver, POISSON_CYCLES, VISCOUS_CYCLES, stable_step_s};
pub use trace::{advected, origin};
