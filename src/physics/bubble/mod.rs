//! The bubble as a whole: where its center is, its shape, and its lives.

mod center;
mod life;
mod shape;

pub use center::{CenterPath, SETTLING_S};
pub use life::{Age, Bursting, Course, Life, LifeCycle, Opening};
pub use shape::{DraggedShape, Oscillator, Shape, reach};
