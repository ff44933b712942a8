//! One picture of a scene, as it is asked for.

use super::{Moment, Pace};
use crate::physics::colour::Gamut;

/// One picture of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Width and height in pixels, both above zero.
    pub size: [u32; 2],
    /// When it is taken.
    pub moment: Moment,
    /// Whether radiance is kept as f32.
    pub full_precision: bool,
    /// Colours that the display, or the file, has.
    pub gamut: Gamut,
    /// Whether films are replaced by the yardstick of the frame's cost.
    pub yardstick: bool,
    /// How much work may be done at once.
    pub pace: Pace,
}
