//! One picture of a scene, as it is asked for.

use glam::DVec2;

use super::{Moment, Pace};
use crate::physics::{
    colour::Gamut,
    picture::{aperture_place, spread},
};

/// How much wider discs in an aperture are than those that would cover its area once. Against 16 x 16 samples, pictures of a blurred park of 2 x 2, 3 x 3
/// and 4 x 4 are at 31.3, 34.8 and 37.2 dB (PSNR) with 1.3, at 35.1, 35.9 and 38.7 with this; wider discs blur the edges of the whole one.
const DISC_WIDENING: f64 = 1.8;

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

    /// The k-th of a number of samples through points of an aperture, of a radius in m.
    #[must_use]
    pub fn point(k: u32, count: u32, radius_m: f64, blades: u32) -> Self {
        let [u, v, x, y] = spread(k, count);
        Self {
            offset_m: radius_m * aperture_place(blades, [u, v]),
            in_pixel: DVec2::new(x, y) - 0.5,
            defocus: 0.0,
            blurs_bubbles: true,
        }
    }

    /// The k-th of a number of samples through discs in an aperture, which overlap: their mean shows no single one of them. They keep so far within that a
    /// point out of focus is spread as far, by root mean square, as through the whole aperture.
    #[must_use]
    pub fn disc(k: u32, count: u32, radius_m: f64, blades: u32) -> Self {
        let point = Self::point(k, count, radius_m, blades);
        let defocus = (DISC_WIDENING / f64::from(count).sqrt()).min(1.0);
        Self { offset_m: (1.0 - defocus * defocus).sqrt() * point.offset_m, defocus, ..point }
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
