//! RGB spaces with the white of D65, and the sRGB transfer function.

use std::sync::LazyLock;

use glam::{DMat3, DVec2, DVec3};

/// Chromaticity (x, y) of the white point of all spaces here, as ITU-R BT.709, BT.2020 and IEC 61966-2-1 round D65.
const WHITE: DVec2 = DVec2::new(0.3127, 0.3290);

/// Linear BT.709, which has the primaries of sRGB (ITU-R BT.709-6).
pub static BT709: LazyLock<RgbSpace> =
    LazyLock::new(|| RgbSpace::new([(0.640, 0.330), (0.300, 0.600), (0.150, 0.060)]));

/// Linear BT.2020, the working space of pictures (ITU-R BT.2020-2).
pub static BT2020: LazyLock<RgbSpace> =
    LazyLock::new(|| RgbSpace::new([(0.708, 0.292), (0.170, 0.797), (0.131, 0.046)]));

/// Linear Display P3 (SMPTE EG 432-1 primaries with D65).
pub static DISPLAY_P3: LazyLock<RgbSpace> =
    LazyLock::new(|| RgbSpace::new([(0.680, 0.320), (0.265, 0.690), (0.150, 0.060)]));

/// A linear RGB space: its matrices to and from XYZ, where RGB (1, 1, 1) has Y = 1. Nothing is adapted or clamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RgbSpace {
    to_xyz: DMat3,
    from_xyz: DMat3,
}

impl RgbSpace {
    /// From the chromaticities of red, green and blue (SMPTE RP 177): the primaries are scaled so that they add up to the white.
    fn new(primaries: [(f64, f64); 3]) -> Self {
        let [r, g, b] = primaries.map(|(x, y)| chromaticity_to_xyz(DVec2::new(x, y)));
        let unscaled = DMat3::from_cols(r, g, b);
        let to_xyz = unscaled * DMat3::from_diagonal(unscaled.inverse() * chromaticity_to_xyz(WHITE));
        Self { to_xyz, from_xyz: to_xyz.inverse() }
    }

    /// The matrix from RGB to XYZ.
    pub fn to_xyz(&self) -> DMat3 {
        self.to_xyz
    }

    /// The matrix from XYZ to RGB.
    pub fn from_xyz(&self) -> DMat3 {
        self.from_xyz
    }

    /// The matrix from this space's RGB to the RGB of `other`.
    pub fn matrix_to(&self, other: &Self) -> DMat3 {
        other.from_xyz * self.to_xyz
    }

    /// What each of R, G, B adds to the luminance Y; the sum is 1.
    pub fn luminance_weights(&self) -> DVec3 {
        self.to_xyz.row(1)
    }
}

/// XYZ with Y = 1 of a chromaticity (x, y).
fn chromaticity_to_xyz(xy: DVec2) -> DVec3 {
    DVec3::new(xy.x, xy.y, 1.0 - xy.x - xy.y) / xy.y
}

/// The matrix from linear BT.709 (sRGB primaries) to linear BT.2020.
pub fn bt709_to_bt2020() -> DMat3 {
    BT709.matrix_to(&BT2020)
}

/// The matrix from linear BT.2020 to linear BT.709 (sRGB primaries); results may be negative.
pub fn bt2020_to_bt709() -> DMat3 {
    BT2020.matrix_to(&BT709)
}

/// sRGB value of a linear component (IEC 61966-2-1). 0..1 maps to 0..1; the curve continues above 1, and is odd below 0.
pub fn srgb_encode(linear: f64) -> f64 {
    let size = linear.abs();
    let encoded = if size <= 0.0031308 { 12.92 * size } else { 1.055 * size.powf(1.0 / 2.4) - 0.055 };
    encoded.copysign(linear)
}

/// Linear component of an sRGB value, the inverse of [`srgb_encode`].
pub fn srgb_decode(encoded: f64) -> f64 {
    let size = encoded.abs();
    let linear = if size <= 0.04045 { size / 12.92 } else { ((size + 0.055) / 1.055).powf(2.4) };
    linear.copysign(encoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spaces() -> [&'static RgbSpace; 3] {
        [&BT709, &BT2020, &DISPLAY_P3]
    }

    #[test]
    fn white_is_white_in_every_space() {
        let white = DVec3::new(0.3127 / 0.3290, 1.0, 0.3583 / 0.3290);
        for space in spaces() {
            assert!((space.to_xyz() * DVec3::ONE - white).abs().max_element() < 1e-14);
            assert!((space.luminance_weights().element_sum() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn matrices_are_inverses() {
        for space in spaces() {
            assert!((space.from_xyz() * space.to_xyz()).abs_diff_eq(DMat3::IDENTITY, 1e-14));
        }
        assert!((bt709_to_bt2020() * bt2020_to_bt709()).abs_diff_eq(DMat3::IDENTITY, 1e-14));
    }

    #[test]
    fn luminance_weights_are_the_published_ones() {
        // Rounded as ITU-R prints them.
        let published = [(&BT709, DVec3::new(0.2126, 0.7152, 0.0722)), (&BT2020, DVec3::new(0.2627, 0.6780, 0.0593))];
        for (space, expected) in published {
            assert!((space.luminance_weights() - expected).abs().max_element() < 5.1e-5);
        }
    }

    #[test]
    fn bt709_to_bt2020_is_that_of_bt2087() {
        let rows = [[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]];
        for (i, row) in rows.into_iter().enumerate() {
            // Recommendation ITU-R BT.2087 prints four digits.
            assert!((bt709_to_bt2020().row(i) - DVec3::from_array(row)).abs().max_element() < 5.1e-5);
        }
    }

    #[test]
    fn srgb_curve_is_odd_and_inverts() {
        for linear in [-2.0, -0.5, -0.001, 0.0, 0.002, 0.0031308, 0.0032, 0.18, 1.0, 7.5] {
            // The standard's rounded constants leave a step of 3e-8 where the two pieces meet.
            assert!((srgb_decode(srgb_encode(linear)) - linear).abs() < 1e-7, "{linear}");
            assert_eq!(srgb_encode(-linear), -srgb_encode(linear));
        }
        assert!((srgb_encode(0.18) - 0.461356).abs() < 1e-6);
        assert!((srgb_encode(1.0) - 1.0).abs() < 1e-15);
    }
}
