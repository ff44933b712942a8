//! The bubble as a whole: where its centre is.

mod centre;

pub use centre::{CentrePath, SETTLING_S};
