//! The bubble as a whole: where its center is, its shape, and its lives; and swarms of bubbles.

mod center;
mod life;
mod shape;
mod swarm;

pub use center::{CenterPath, SETTLING_S};
pub use life::{Age, Bursting, Course, Life, LifeCycle, Opening, Renewal};
pub use shape::{DraggedShape, Oscillator, Shape, reach};
pub use swarm::{Lending, Member, Origin, Swarm};
