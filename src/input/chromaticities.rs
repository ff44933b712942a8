//! Colours of files that are not linear BT.2020.

use glam::{DMat3, DVec2, DVec3};

/// An RGB space: the CIE 1931 chromaticities (x, y) of its primaries and of its white.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RgbSpace {
    /// Red, green and blue.
    pub primaries: [DVec2; 3],
    /// The colour of (1, 1, 1).
    pub white: DVec2,
}

const D65: DVec2 = DVec2::new(0.3127, 0.3290);

/// ITU-R BT.709, which OpenEXR and Radiance files mean when they do not say.
pub(super) const BT709: RgbSpace =
    RgbSpace { primaries: [DVec2::new(0.640, 0.330), DVec2::new(0.300, 0.600), DVec2::new(0.150, 0.060)], white: D65 };

/// ITU-R BT.2020, the program's own.
pub(super) const BT2020: RgbSpace =
    RgbSpace { primaries: [DVec2::new(0.708, 0.292), DVec2::new(0.170, 0.797), DVec2::new(0.131, 0.046)], white: D65 };

/// Cone responses of the Bradford adaptation (ICC.1:2022, annex E.2).
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

impl RgbSpace {
    /// The matrix from linear RGB of this space to linear BT.2020, or `None` if the chromaticities span no colours.
    ///
    /// A white other than D65 is adapted (Bradford): environments are relative to the illuminant, so a file's white stays
    /// white.
    pub fn to_bt2020(self) -> Option<DMat3> {
        let adaptation = adapt(self.white, BT2020.white)?;
        let matrix = BT2020.to_xyz()?.inverse() * adaptation * self.to_xyz()?;
        matrix.is_finite().then_some(matrix)
    }

    /// The matrix from linear RGB to XYZ, white at Y = 1 (SMPTE RP 177).
    fn to_xyz(self) -> Option<DMat3> {
        let [red, green, blue] = self.primaries.map(xyz_of);
        let primaries = DMat3::from_cols(red?, green?, blue?);
        let scale = invert(primaries)? * xyz_of(self.white)?;
        Some(primaries * DMat3::from_diagonal(scale))
    }
}

/// XYZ of a chromaticity at Y = 1. ACES has a primary with y < 0, which is no light but a fine basis vector.
fn xyz_of(xy: DVec2) -> Option<DVec3> {
    let xyz = DVec3::new(xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y);
    xyz.is_finite().then_some(xyz)
}

fn adapt(from: DVec2, to: DVec2) -> Option<DMat3> {
    let (from, to) = (BRADFORD * xyz_of(from)?, BRADFORD * xyz_of(to)?);
    Some(BRADFORD.inverse() * DMat3::from_diagonal(to / from) * BRADFORD)
}

fn invert(matrix: DMat3) -> Option<DMat3> {
    // Real primaries have determinants of order 1.
    (matrix.determinant().abs() > 1e-9).then(|| matrix.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bt709_converts_as_itu_says() {
        // ITU-R BT.2087-0, table 2.
        let expected = DMat3::from_cols(
            DVec3::new(0.6274, 0.0691, 0.0164),
            DVec3::new(0.3293, 0.9195, 0.0880),
            DVec3::new(0.0433, 0.0114, 0.8956),
        );
        let matrix = BT709.to_bt2020().unwrap();
        assert!(matrix.abs_diff_eq(expected, 6e-5), "{matrix}");
    }

    #[test]
    fn white_stays_white_whatever_the_space() {
        let aces = RgbSpace {
            primaries: [DVec2::new(0.7347, 0.2653), DVec2::new(0.0, 1.0), DVec2::new(0.0001, -0.077)],
            white: DVec2::new(0.32168, 0.33767),
        };
        for space in [BT709, BT2020, aces] {
            let white = space.to_bt2020().unwrap() * DVec3::ONE;
            assert!(white.distance(DVec3::ONE) < 1e-12, "{white}");
        }
        assert!(BT2020.to_bt2020().unwrap().abs_diff_eq(DMat3::IDENTITY, 1e-12));
    }

    #[test]
    fn spaces_without_colours_are_refused() {
        let grey = RgbSpace { primaries: [D65; 3], white: D65 };
        let zero = RgbSpace { primaries: [DVec2::ZERO; 3], white: DVec2::ZERO };
        assert_eq!(grey.to_bt2020(), None);
        assert_eq!(zero.to_bt2020(), None);
    }
}
