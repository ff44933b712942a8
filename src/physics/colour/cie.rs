//! The CIE 1931 2° standard observer.

use std::sync::LazyLock;

use glam::DVec3;

use crate::physics::spectra::Spectrum;

/// A standard observer: the colour matching functions x̄, ȳ, z̄.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    matching: [Spectrum; 3],
}

static CIE_1931_2DEG: LazyLock<Observer> = LazyLock::new(|| {
    let text = include_str!("../../../assets/spectra/cie_1931_2deg.csv");
    // The text is part of the program, and every test of colour parses it.
    let matching =
        Spectrum::columns_from_csv("cie_1931_2deg.csv", text, &mut Vec::new()).expect("the built-in observer is valid");
    Observer { matching }
});

impl Observer {
    /// The CIE 1931 2° standard observer.
    pub fn cie_1931_2deg() -> &'static Self {
        &CIE_1931_2DEG
    }

    /// (x̄, ȳ, z̄) at a wavelength, linear between whole nanometres.
    pub fn at_nm(&self, wavelength_nm: f64) -> DVec3 {
        DVec3::from_array(self.matching.each_ref().map(|function| function.at_nm(wavelength_nm)))
    }
}
