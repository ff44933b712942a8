//! Chromaticity: colour without brightness, in the diagrams of 1931 and 1976.

use glam::{DVec2, DVec3};

use super::{Observer, RgbSpace};

/// Chromaticity (x, y) of CIE 1931; (0, 0) for black.
#[must_use]
pub fn chromaticity_xy(xyz: DVec3) -> DVec2 {
    over(xyz.truncate(), xyz.element_sum())
}

/// Chromaticity (u′, v′) of CIE 1976, `4X / (X + 15Y + 3Z)` and `9Y / (X + 15Y + 3Z)`, in which equal distances look more alike; (0, 0) for black.
#[must_use]
pub fn chromaticity_uv(xyz: DVec3) -> DVec2 {
    over(DVec2::new(4.0 * xyz.x, 9.0 * xyz.y), xyz.dot(DVec3::new(1.0, 15.0, 3.0)))
}

fn over(parts: DVec2, sum: f64) -> DVec2 {
    if sum > 0.0 { parts / sum } else { DVec2::ZERO }
}

/// The spectral locus: XYZ of light of one wavelength, every nanometre from 380 to 700 nm, beyond which chromaticity hardly changes.
#[must_use]
pub fn spectral_locus() -> Vec<(f64, DVec3)> {
    let observer = Observer::cie_1931_2deg();
    (380..=700).map(f64::from).map(|nm| (nm, observer.at_nm(nm))).collect()
}

impl RgbSpace {
    /// XYZ of red, green and blue.
    #[must_use]
    pub fn primaries(&self) -> [DVec3; 3] {
        let matrix = self.to_xyz();
        [matrix.x_axis, matrix.y_axis, matrix.z_axis]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::colour::{BT709, DISPLAY_P3};

    #[test]
    fn primaries_have_the_published_chromaticities() {
        let red = chromaticity_xy(DISPLAY_P3.primaries()[0]);
        assert!((red - DVec2::new(0.680, 0.320)).abs().max_element() < 1e-12, "{red}");
        // EBU Tech. 3213 prints u′, v′ of the red of BT.709: 0.4507, 0.5229.
        let red = chromaticity_uv(BT709.primaries()[0]);
        assert!((red - DVec2::new(0.4507, 0.5229)).abs().max_element() < 5e-5, "{red}");
        assert_eq!(chromaticity_xy(DVec3::ZERO), DVec2::ZERO);
    }

    #[test]
    fn the_locus_is_that_of_the_tables() {
        // CIE 15, chromaticities of the spectrum at 520 and 600 nm.
        let locus = spectral_locus();
        let at = |nm: f64| chromaticity_xy(locus.iter().find(|(known, _)| *known == nm).expect("every nanometre").1);
        assert!((at(520.0) - DVec2::new(0.07430, 0.83380)).abs().max_element() < 1e-4, "{}", at(520.0));
        assert!((at(600.0) - DVec2::new(0.62704, 0.37249)).abs().max_element() < 1e-4, "{}", at(600.0));
    }
}
