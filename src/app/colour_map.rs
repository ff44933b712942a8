//! Viridis: colours for numbers, as equally spaced as people see them (S. van der Walt and N. Smith, matplotlib 1.5).

use glam::DVec3;

/// Coefficients of a polynomial in the part of the scale, sRGB 0 to 1: the fit of M. Zucker, "Perceptually uniform color maps", shadertoy.com/view/WlfXRN
/// (public domain).
const VIRIDIS: [DVec3; 7] = [
    DVec3::new(0.2777273272234177, 0.005407344544966578, 0.3340998053353061),
    DVec3::new(0.1050930431085774, 1.404613529898575, 1.384590162594685),
    DVec3::new(-0.3308618287255563, 0.214847559468213, 0.09509516302823659),
    DVec3::new(-4.634230498983486, -5.799100973351585, -19.33244095627987),
    DVec3::new(6.228269936347081, 14.17993336680509, 56.69055260068105),
    DVec3::new(4.776384997670288, -13.74514537774601, -65.35303263337234),
    DVec3::new(-5.435455855934631, 4.645852612178535, 26.3124352495832),
];

/// The colour of a part of the scale, 0 to 1, 8 bits of sRGB.
#[must_use]
pub fn viridis(part: f64) -> [u8; 3] {
    let part = part.clamp(0.0, 1.0);
    let colour = VIRIDIS.iter().rev().fold(DVec3::ZERO, |sum, coefficient| sum * part + *coefficient);
    colour.to_array().map(|channel| (255.0 * channel.clamp(0.0, 1.0)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::colour::{BT709, srgb_decode};

    /// Five colours of the published table of 256, at equal distances.
    const TABLE: [[u8; 3]; 5] = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

    #[test]
    fn the_polynomial_is_the_published_table() {
        for (stop, expected) in TABLE.iter().enumerate() {
            let found = viridis(stop as f64 / 4.0);
            // Where the fit is worst, at the dark end.
            assert!(found.iter().zip(expected).all(|(a, b)| a.abs_diff(*b) <= 4), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn lightness_rises_all_along() {
        let luminance = |part: u32| {
            let linear = viridis(f64::from(part) / 100.0).map(|channel| srgb_decode(f64::from(channel) / 255.0));
            BT709.luminance_weights().dot(DVec3::from_array(linear))
        };
        assert!((1..=100).all(|part| luminance(part) > luminance(part - 1)));
    }
}
