//! Integrals over the colour matching functions of the CIE 1931 2° standard observer.

use glam::DVec3;

use super::{Illuminant, Observer};
use crate::physics::spectra::wavelength_nm;

/// What reflectance 1 at one wavelength contributes to XYZ under an illuminant, S (x̄, ȳ, z̄) / Σ S ȳ: for each of the 421 samples of the
/// continuous spectrum, and for each line where it stands. Wavelengths without power are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourWeights {
    wavelengths_nm: Vec<f64>,
    weights: Vec<DVec3>,
}

impl ColourWeights {
    /// The weights of `illuminant` for the CIE 1931 2° observer.
    pub fn new(illuminant: &Illuminant) -> Self {
        let observer = Observer::cie_1931_2deg();
        let continuous = illuminant.spectrum().iter().enumerate().map(|(i, power)| (wavelength_nm(i), power));
        let lines = illuminant.lines().iter().map(|line| (line.wavelength_nm, line.power));
        let (wavelengths_nm, mut weights): (Vec<f64>, Vec<DVec3>) = continuous
            .chain(lines)
            .filter(|(_, power)| *power > 0.0)
            .map(|(nm, power)| (nm, power * observer.at_nm(nm)))
            .unzip();
        let luminance: f64 = weights.iter().map(|weight| weight.y).sum();
        weights.iter_mut().for_each(|weight| *weight /= luminance);
        Self { wavelengths_nm, weights }
    }

    /// XYZ of a perfect mirror; Y = 1 but for rounding.
    pub fn white(&self) -> DVec3 {
        self.weights.iter().sum()
    }

    /// XYZ of what reflects the fraction `reflectance(i)` at wavelength `i` of [`Self::wavelengths_nm`].
    pub fn integrate(&self, mut reflectance: impl FnMut(usize) -> f64) -> DVec3 {
        self.weights.iter().enumerate().map(|(i, &weight)| weight * reflectance(i)).sum()
    }

    /// Where the light has power, nm: the continuous spectrum's wavelengths rising, then the lines'.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The weight of each wavelength.
    pub fn as_slice(&self) -> &[DVec3] {
        &self.weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::spectra::Spectrum;

    fn white(name: &str) -> DVec3 {
        ColourWeights::new(&name.parse().expect("built in")).white()
    }

    #[test]
    fn a_perfect_mirror_shows_the_illuminants_white() {
        // The usual five digits (CIE 015, ASTM E308), for E the equal areas of the matching functions. Sums at 1 nm over 360..780 nm
        // differ from sums over other steps and ranges by up to 4e-4.
        let published = [
            ("D65", DVec3::new(0.95047, 1.0, 1.08883)),
            ("D50", DVec3::new(0.96422, 1.0, 0.82521)),
            ("A", DVec3::new(1.09850, 1.0, 0.35585)),
            ("E", DVec3::new(1.0, 1.0, 1.0)),
        ];
        for (name, expected) in published {
            let error = (white(name) - expected).abs().max_element();
            assert!(error < 4e-4, "{name}: {} instead of {expected}", white(name));
        }
    }

    #[test]
    fn the_white_of_d65_has_its_six_digits() {
        assert!((white("D65") - DVec3::new(0.950469, 1.0, 1.088830)).abs().max_element() < 5e-7);
    }

    #[test]
    fn lines_count_where_they_stand() {
        let weights = ColourWeights::new(&"sodium".parse().expect("built in"));
        assert_eq!(weights.wavelengths_nm(), [588.995, 589.592]);
        let (observer, white) = (Observer::cie_1931_2deg(), weights.white());
        let expected = (2.0 * observer.at_nm(588.995) + observer.at_nm(589.592)) / 3.0;
        assert!((white - expected / expected.y).abs().max_element() < 1e-14, "{white}");
    }

    #[test]
    fn a_grey_furnace_stays_grey() {
        let weights = ColourWeights::new(&Illuminant::default());
        // Sums of 421 terms of the same sign round by at most 421 half-ulps.
        assert!((weights.integrate(|_| 0.25) - 0.25 * weights.white()).abs().max_element() < 1e-13);
    }

    #[test]
    fn the_unit_of_power_does_not_matter() {
        let dim = Illuminant::new("dim", Spectrum::constant(1e-12)).expect("has power");
        assert!((ColourWeights::new(&dim).white() - white("E")).abs().max_element() < 1e-13);
    }
}
