//! The grid that every film lives on: an equiangular cubed sphere, its padded storage, and interpolation on it.
//!
//! ```text
//! panel  f   r   u      point = normalize(f + tan(a) r + tan(b) u)
//!   0   +x  +y  +z      a = (i + 1/2) D - pi/4,  b = (j + 1/2) D - pi/4,  D = pi / (2N)
//!   1   +y  -x  +z
//!   2   -x  -y  +z      cells are ordered panel, then j, then i
//!   3   -y  +x  +z      values live at cell centers: they are point values, not cell means
//!   4   +z  +y  -x
//!   5   -z  +y  +x
//! ```
//!
//! Source of the projection: Ronchi, Iacono & Paolucci 1996, "The cubed sphere", J. Comput. Phys. 124.

mod cap;
mod grid;
mod halo;
mod lagrange;
mod padded;

pub use cap::Cap;
pub use grid::{CubedSphere, GridError, HALO, PANELS, PanelPoint};
pub use halo::{HaloEntry, HaloTable};
pub use lagrange::{cubic_weights, quintic_weights};
pub use padded::{FieldValue, PaddedField};
