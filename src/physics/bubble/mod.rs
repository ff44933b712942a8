//! The bubble as a whole: where its centre is, and its shape.

mod centre;
mod shape;

pub use centre::{CentrePath, SETTLING_S};
pub use shape::{Oscillator, Shape, reach};
