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

/// CIE XYZ as if it were RGB: primaries in the corners of the diagram, white of equal energy.
pub(super) const CIE_XYZ: RgbSpace =
    RgbSpace { primaries: [DVec2::X, DVec2::Y, DVec2::ZERO], white: DVec2::splat(1.0 / 3.0) };

/// Cone responses of the Bradford adaptation (ICC.1:2022, annex E.2).
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

impl RgbSpace {
    /// The space that a file states. Zeros state nothing: many programs write them that know no space. Primaries that are all zero are
    /// taken as BT.709, a white of zeros as D65.
    pub fn stated(primaries: [DVec2; 3], white: DVec2) -> Self {
        if primaries == [DVec2::ZERO; 3] {
            return BT709;
        }
        Self { primaries, white: if white == DVec2::ZERO { D65 } else { white } }
    }

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
        let [red, green, blue] = self.primaries.map(direction_of);
        let primaries = DMat3::from_cols(red, green, blue);
        let scale = invert(primaries)? * xyz_of(self.white)?;
        // White must be a sum of all three primaries.
        (scale.min_element() > 0.0).then(|| primaries * DMat3::from_diagonal(scale))
    }
}

/// XYZ of a chromaticity at X + Y + Z = 1. Primaries need not be light: the primaries of CIE XYZ have y = 0, and one of the ACES primaries has y < 0.
fn direction_of(xy: DVec2) -> DVec3 {
    DVec3::new(xy.x, xy.y, 1.0 - xy.x - xy.y)
}

/// XYZ of a white at Y = 1.
fn xyz_of(white: DVec2) -> Option<DVec3> {
    let xyz = direction_of(white) / white.y;
    xyz.is_finite().then_some(xyz)
}

fn adapt(from: DVec2, to: DVec2) -> Option<DMat3> {
    let (from, to) = (BRADFORD * xyz_of(from)?, BRADFORD * xyz_of(to)?);
    Some(BRADFORD.inverse() * DMat3::from_diagonal(to / from) * BRADFORD)
}

fn invert(matrix: DMat3) -> Option<DMat3> {
    // The determinant is twice the area of the primaries' triangle: 0.22 for BT.709. That of points on a line, rounded to f32, is 1e-8.
    (matrix.determinant().abs() > 1e-6).then(|| matrix.inverse())
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
        for space in [BT709, BT2020, CIE_XYZ, aces] {
            let white = space.to_bt2020().unwrap() * DVec3::ONE;
            assert!(white.distance(DVec3::ONE) < 1e-12, "{white}");
        }
        assert!(BT2020.to_bt2020().unwrap().abs_diff_eq(DMat3::IDENTITY, 1e-12));
    }

    #[test]
    fn xyz_is_a_space_like_others() {
        let to_bt2020 = CIE_XYZ.to_bt2020().unwrap();
        let adaptation = adapt(CIE_XYZ.white, D65).unwrap();
        let expected = BT2020.to_xyz().unwrap().inverse() * adaptation;
        assert!(to_bt2020.abs_diff_eq(expected, 1e-12), "{to_bt2020}");
    }

    #[test]
    fn zeros_state_nothing() {
        assert_eq!(RgbSpace::stated([DVec2::ZERO; 3], DVec2::ZERO), BT709);
        assert_eq!(RgbSpace::stated([DVec2::ZERO; 3], DVec2::splat(0.3)), BT709);
        assert_eq!(RgbSpace::stated(BT2020.primaries, DVec2::ZERO), BT2020);
        assert_eq!(RgbSpace::stated(CIE_XYZ.primaries, CIE_XYZ.white), CIE_XYZ);
    }

    #[test]
    fn spaces_without_colours_are_refused() {
        let grey = RgbSpace { primaries: [D65; 3], white: D65 };
        let zero = RgbSpace { primaries: [DVec2::ZERO; 3], white: DVec2::ZERO };
        let line = RgbSpace { primaries: [0.1, 0.2, 0.3].map(|x| DVec2::new(x, 2.0 * x)), white: D65 };
        let outside = RgbSpace { white: DVec2::new(0.7, 0.1), ..BT709 };
        let nan = RgbSpace { primaries: [DVec2::NAN; 3], white: D65 };
        for space in [grey, zero, line, outside, nan] {
            assert_eq!(space.to_bt2020(), None, "{space:?}");
        }
    }
}
