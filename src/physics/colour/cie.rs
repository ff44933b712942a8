//! The CIE 1931 2° standard observer, and integrals over its colour matching functions.

use std::array;
use std::sync::LazyLock;

use glam::DVec3;

use super::Illuminant;
use crate::physics::spectra::{SAMPLES, Spectrum};

/// A standard observer: the colour matching functions x̄, ȳ, z̄.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    matching: [Spectrum; 3],
}

static CIE_1931_2DEG: LazyLock<Observer> = LazyLock::new(|| {
    let text = include_str!("../../../assets/spectra/cie_1931_2deg.csv");
    // The text is part of the program, and every test of colour parses it.
    let matching = Spectrum::columns_from_csv("cie_1931_2deg.csv", text).expect("the built-in observer is valid");
    Observer { matching }
});

impl Observer {
    /// The CIE 1931 2° standard observer.
    pub fn cie_1931_2deg() -> &'static Self {
        &CIE_1931_2DEG
    }

    /// (x̄, ȳ, z̄) at sample `i` of 0..421.
    pub fn at(&self, i: usize) -> DVec3 {
        DVec3::from_array(self.matching.each_ref().map(|function| function.at(i)))
    }
}

/// What reflectance 1 at one wavelength contributes to XYZ under an illuminant: S (x̄, ȳ, z̄) / Σ S ȳ for each of the 421 samples.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourWeights {
    weights: Box<[DVec3; SAMPLES]>,
}

impl ColourWeights {
    /// The weights of `illuminant` for the CIE 1931 2° observer.
    pub fn new(illuminant: &Illuminant) -> Self {
        let observer = Observer::cie_1931_2deg();
        let power = illuminant.spectrum();
        let luminance: f64 = (0..SAMPLES).map(|i| power.at(i) * observer.at(i).y).sum();
        Self { weights: Box::new(array::from_fn(|i| power.at(i) / luminance * observer.at(i))) }
    }

    /// XYZ of a perfect mirror; Y = 1 but for rounding.
    pub fn white(&self) -> DVec3 {
        self.weights.iter().sum()
    }

    /// XYZ of what reflects the fraction `reflectance(i)` at sample `i` (360 + i nm).
    pub fn integrate(&self, mut reflectance: impl FnMut(usize) -> f64) -> DVec3 {
        self.weights.iter().enumerate().map(|(i, &weight)| weight * reflectance(i)).sum()
    }

    /// The weights by rising wavelength, for upload to a GPU.
    pub fn as_slice(&self) -> &[DVec3] {
        self.weights.as_slice()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn white(name: &str) -> DVec3 {
        ColourWeights::new(&name.parse().expect("built in")).white()
    }

    #[test]
    fn a_perfect_mirror_shows_the_illuminants_white() {
        // The usual five digits (CIE 015, ASTM E308), for E the equal areas of the matching functions. Sums at 1 nm over 360..780 nm
        // differ from those of other steps and ranges by up to 4e-4.
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
