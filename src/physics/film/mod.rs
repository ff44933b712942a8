//! Films in closed form: what they are made of, what they are at first, and flows that need no solver.

mod flow;
mod marble;
mod presets;
pub mod properties;
mod push;
mod random;
mod states;

pub use flow::{
    FlowError, FrozenFlow, FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES, PrescribedFlow, Vortex, Wave,
};
pub use push::{FrozenPush, Push, gained};
pub use states::{InitialFilm, Profile};
