//! The film of a bubble: what it is made of, what it is at first, what moves it, and how its thickness changes.
//!
//! # The model
//!
//! A film is a sheet of liquid of thickness h on a sphere of radius R, a few hundred nanometres on some centimetres. Lengths along it are counted in
//! radii, so that the sphere is the unit sphere and velocities are angular.
//!
//! | symbol | what it is | unit | in the code |
//! |---|---|---|---|
//! | x, n | place on the unit sphere, which is also its outward normal | – | `x`, `direction` |
//! | t, dt | time, length of a step | s | `time_s`, `dt_s` |
//! | h | total thickness, along the normal | nm | `thickness_nm` |
//! | e | what has evaporated since the beginning | nm | `evaporated_nm` |
//! | φ | thickness as if nothing had evaporated | nm | tracer + `level_nm` |
//! | M | where the liquid at x was at the last remap | – | `map` |
//! | u | velocity of the film, over R | rad/s | `velocity` |
//! | ψ | stream function | rad²/s | `psi` |
//! | ζ | vorticity | 1/s | `zeta` |
//! | G | gravity less the bubble's acceleration, over R | 1/s² | `gravity` |
//! | α | drag of the air | 1/s | `drag`, `air_drag` |
//! | ν | kinematic viscosity of the film as a fluid of two dimensions, over R² | 1/s | `viscosity` |
//! | D | diffusivity of thickness, over R² | 1/s | `diffusion` |
//! | c | ρ/12μ: what gravity and h³ are multiplied by in the flux of drainage | s/m² | `drainage`, `flux` |
//! | h_b, h_c, k | black film, the thickness at which film begins to collapse to it, and how fast it does | nm, nm, 1/s | `black_nm`, `onset_nm`, `rate` |
//! | ρ, μ, μ_s | density and viscosity of the liquid, shear viscosity of a surface | kg/m³, Pa s, Pa s m | [`properties`] |
//!
//! Liquid neither stretches nor shrinks in the plane of the film, for the film's tension answers to either at once (its Mach number is below 0.1):
//!
//! ```text
//! div u = 0,     u = n × ∇ψ                                                                          (1)
//! ```
//!
//! What is left of the balance of forces is its curl. Weight turns film that is not equally thick at one height, air holds it back and stirs it,
//! viscosity smooths it, and pushes F from outside act on it ([`Push`]):
//!
//! ```text
//! Dζ/Dt = n·(∇ ln h × G) + ν (Δ + 2) ζ − n·curl(α u) + α₀ n·curl u_air + F,     Δψ = ζ               (2)
//! ν = (μ/ρ + 2 μ_s/(ρ h)) / R²                                                                       (3)
//! α = α₀ + A √|u| / h                                                                                (4)
//! ```
//!
//! The numerics of (2) to (4) are in [`flow`](crate::physics::flow), equations (F1) to (F10). A film has one ν, by (3) with its mean thickness at the
//! start where a scene gives μ_s (`surface_viscosity_upa_s_m`), or as the scene gives it (`viscosity_mm2_s`), and
//! in (2) the air's own motion acts by a mean α₀.
//!
//! Thickness goes with the liquid, and evaporates, spreads by what the cells do not resolve, drains between still surfaces, leaves at rims, and turns
//! black:
//!
//! ```text
//! Dh/Dt = −ė + D Δh − ∇·(c h³ G_t) − k r(h̄) (h − h_b)                                             (5)
//! ```
//!
//! Each term is an operation of [`model`], in a file of its own with its equation: the flow map (M1), (M2) for D/Dt; (M7) for ė; (M6) for D; (D1) and
//! (D2) for drainage and [`Regeneration`]; (B1) and (B2) for black film and its [`Nucleus`]; and (M3), (M4) for what all of them leave as it is, the
//! amount of liquid. All but the first act at remaps, for the time since the one before.
//!
//! A step, from t to t + dt, is [`FREE_STEP`](model::FREE_STEP), and a remap is [`REMAP`](model::REMAP).
//!
//! # Beside Huang et al. 2020
//!
//! "Chemomechanical simulation of soap film flow on spherical bubbles" (ACM Transactions on Graphics 39(4)) solves for velocity, thickness and the
//! surfactant's concentration Γ of a film that can be compressed. Their h is half of the thickness.
//!
//! - Their momentum equation has the surface's tension −(M/h) ∇Γ, the air's drag (Cr/h)(u_air − u), gravity along the film and viscosity. Equation (2)
//!   is its curl for M → ∞, the limit of a film of no Mach number: ∇Γ then is what it takes to keep div u at 0, and what is left of
//!   (1/h) ∇Γ after it has balanced gravity is the term with ∇ ln h. Their drag goes as 1/h too; (4) adds the root of the speed, for a boundary layer.
//! - Their thickness equation is (5) with h div u, which is 0 here, and evaporation, and without spreading, drainage, rims and black film.
//! - Their surfactant equation has no counterpart: Γ follows from the others in this limit, as pressure does in water.
//! - They solve on a spherical grid with poles; here it is a cubed sphere without ([`sphere`](crate::physics::sphere)).
//!
//! Left out here: compression waves and the Marangoni flow that is not weight's answer, surface elasticity and the diffusion of surfactant, viscosity
//! that depends on the place, the disjoining pressure as a force, and how the bubble's wobble acts on the flow.
//!
//! # Modules
//!
//! Closed forms first: [`InitialFilm`] (the elastic rest state, and freshly blown film), [`PrescribedFlow`], [`properties`], [`Hole`] (the burst) and its [`Droplet`]s, then the
//! forces ([`Push`]) and laws ([`FlowLaw`]) of a film that moves by itself, and the [`model`].

mod boundary;
mod burst;
mod evaporation;
mod flow;
mod law;
mod marble;
pub mod model;
mod nucleation;
mod presets;
pub mod properties;
mod push;
mod pushes;
mod random;
mod regeneration;
mod rest;
mod seed;
mod spray;
mod states;
mod thinning;

pub use boundary::Boundary;
pub use burst::{HOLE_MERIDIANS, HOLE_PARTS, Hole, Rim, burst_s, rim_delay};
pub use evaporation::Evaporation;
pub use flow::{
    FlowError, FrozenFlow, FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES, PrescribedFlow, Vortex, Wave,
};
pub use law::{FlowLaw, FreeFlow, Split};
pub use nucleation::{NUCLEATION_NM, Nucleus, nuclei};
pub use presets::Flow;
pub use push::{FrozenPush, Push, gained};
pub use pushes::Pushes;
pub use random::{Random, fold_seed, pcg3d};
pub use regeneration::{PATCH_THICKNESS, Patch, Regeneration, patch_speed};
pub use rest::{ASKING_S, STEADY, resting_speed, rests};
pub use seed::{Seed, SeedGrids, Seeded};
pub use spray::{Droplet, droplets};
pub use states::{InitialFilm, Profile};
pub use thinning::{Thinning, thins_at_tick};

pub use crate::physics::sphere::Cap;
