//! Films in closed form: what they are made of, what they are at first, and flows that need no solver.

mod boundary;
mod burst;
mod flow;
mod law;
mod marble;
pub mod model;
mod presets;
pub mod properties;
mod push;
mod random;
mod regeneration;
mod states;

pub use boundary::Boundary;
pub use burst::{HOLE_MERIDIANS, HOLE_PARTS, Hole, Rim, burst_s, rim_delay};
pub use flow::{
    FlowError, FrozenFlow, FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES, PrescribedFlow, Vortex, Wave,
};
pub use law::{FlowLaw, FreeFlow, Split, evaporated_nm};
pub use presets::Flow;
pub use push::{FrozenPush, Push, gained};
pub use random::Random;
pub use regeneration::{PATCH_THICKNESS, Patch, Regeneration, patch_speed};
pub use states::{InitialFilm, Profile};

pub use crate::physics::sphere::Cap;
