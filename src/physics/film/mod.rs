//! Films in closed form: what they are made of, what they are at first, and flows that need no solver.

mod burst;
mod flow;
mod marble;
mod presets;
pub mod properties;
mod push;
mod random;
mod states;

pub use burst::{HOLE_MERIDIANS, HOLE_PARTS, Hole, Rim, burst_s, rim_delay};
pub use flow::{
    FlowError, FrozenFlow, FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES, PrescribedFlow, Vortex, Wave,
};
pub use push::{FrozenPush, Push, gained};
pub use random::Random;
pub use states::{InitialFilm, Profile};
