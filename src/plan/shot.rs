//! One picture of a scene, as it is asked for.

use glam::DVec2;

use super::{Moment, Pace};
use crate::physics::{
    colour::Gamut,
    picture::{aperture_place, spread},
};

/// One of the many rays of light through a lens that make a picture: where it passes, and which part of each pixel it meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensSample {
    /// From the middle of the lens to the right and up, m.
    pub offset_m: DVec2,
    /// From each pixel's middle to the right and down, pixels.
    pub in_pixel: DVec2,
    /// How far an infinitely far background is blurred already, as a part of what the lens blurs it.
    pub defocus: f64,
    /// Whether bubbles are blurred by as much as the background: not in layers, whose depths and normals are sharp.
    pub blurs_bubbles: bool,
}

impl LensSample {
    /// All light, through the middle of the lens.
    pub const MIDDLE: Self = Self { offset_m: DVec2::ZERO, in_pixel: DVec2::ZERO, defocus: 1.0, blurs_bubbles: true };

    /// The k-th of a number of samples through an aperture, of a radius in m. A background that is blurred by as much as the samples are apart shows no
    /// single one of them.
    #[must_use]
    pub fn of(k: u32, count: u32, radius_m: f64, blades: u32) -> Self {
        let [u, v, x, y] = spread(k);
        Self {
            offset_m: radius_m * aperture_place(blades, [u, v]),
            in_pixel: DVec2::new(x, y) - 0.5,
            defocus: 1.0 / f64::from(count).sqrt(),
            blurs_bubbles: true,
        }
    }
}

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
    /// How much work may be done at once.
    pub pace: Pace,
}
