//! The bubble as a whole: where its centre is, its shape, and its lives.

mod centre;
mod life;
mod shape;

pub use centre::{CentrePath, SETTLING_S};
pub use life::{Age, Bursting, Course, Life, Lives, Opening};
pub use shape::{DraggedShape, Oscillator, Shape, reach};
