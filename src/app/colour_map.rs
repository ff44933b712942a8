//! Colours for numbers, as equally spaced as people see them: viridis (S. van der Walt and N. Smith, matplotlib 1.5), and for numbers with a sign
//! the diverging map of K. Moreland, "Diverging color maps for scientific visualization", ISVC 2009.

use glam::DVec3;

use crate::physics::colour::{BT709, srgb_encode};

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

/// Cool and warm end of the diverging map: lightness and chroma together, saturation and hue, in the polar form of CIELAB.
const COOL: DVec3 = DVec3::new(80.0, 1.08, -1.1);
const WARM: DVec3 = DVec3::new(80.0, 1.08, 0.5);
/// Lightness of its grey middle.
const GREY: f64 = 88.0;
/// The colour of a part of a scale, 0 to 1, whose middle is neutral: blue below, red above, 8 bits of sRGB.
#[must_use]
pub fn diverging(part: f64) -> [u8; 3] {
    let part = part.clamp(0.0, 1.0);
    let (end, far) = if part < 0.5 { (COOL, 1.0 - 2.0 * part) } else { (WARM, 2.0 * part - 1.0) };
    // The hue of grey, chosen so that the way to it is as even as that of saturation.
    let spin = end.y * (GREY * GREY - end.x * end.x).sqrt() / (end.x * end.y.sin());
    let grey = DVec3::new(GREY, 0.0, if end.z > -std::f64::consts::FRAC_PI_3 { end.z + spin } else { end.z - spin });
    let [size, saturation, hue] = grey.lerp(end, far).to_array();
    let (lightness, chroma) = (size * saturation.cos(), size * saturation.sin());
    let y = (lightness + 16.0) / 116.0;
    let curves = DVec3::new(y + chroma * hue.cos() / 500.0, y, y - chroma * hue.sin() / 200.0);
    // All colours of the map are so light that CIELAB is a cube here.
    let white = BT709.to_xyz() * DVec3::ONE;
    let linear = BT709.from_xyz() * (white * curves.powf(3.0));
    linear.to_array().map(|channel| (255.0 * srgb_encode(channel.clamp(0.0, 1.0))).round() as u8)
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
    fn the_diverging_map_is_the_published_table() {
        for (part, expected) in
            [(0.0, [59, 76, 192]), (0.25, [141, 176, 254]), (0.5, [221, 221, 221]), (1.0, [180, 4, 38])]
        {
            let found = diverging(part);
            assert!(found.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 2), "{part}: {found:?} {expected:?}");
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
