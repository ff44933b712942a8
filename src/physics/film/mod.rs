//! Film states and motions in closed form: what a film is at first, and flows that need no solver.

mod flow;
mod marble;
mod presets;
mod random;
mod states;

pub use flow::{
    FlowError, FrozenFlow, FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES, PrescribedFlow, Vortex, Wave,
};
pub use states::{InitialFilm, Profile};
