//! From RGB light to a spectrum.
//!
//! Environments are RGB and the film is spectral, so a light (r, g, b), linear BT.709, stands for the spectrum
//! L(λ) = S(λ) (r ρ_r(λ) + g ρ_g(λ) + b ρ_b(λ)), with S the scene's illuminant. It is linear in (r, g, b), so that what a film does to
//! RGB light is exactly a 3×3 matrix. The idea is from I. Mallett and C. Yuksel, "Spectral Primary Decomposition for Rendering with
//! sRGB Reflectance" (EGSR 2019).

use std::sync::LazyLock;

use glam::{DMat3, DVec3};

use super::ColourWeights;
use crate::physics::spectra::Spectrum;

/// Three smooth spectra ρ, nonnegative and with the sum 1 at every wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Uplift {
    rho: [Spectrum; 3],
}

static BT709: LazyLock<Uplift> = LazyLock::new(|| {
    let text = include_str!("../../../assets/spectra/uplift_bt709.csv");
    // The text is part of the program, and tests parse it.
    Uplift {
        rho: Spectrum::columns_from_csv("uplift_bt709.csv", text, &mut Vec::new())
            .expect("the built-in uplift is valid"),
    }
});

impl Uplift {
    /// The spectra that reproduce the BT.709 primaries under D65. "Reproduce" is within 5.3e-5 of XYZ, with each of X, Y, Z scaled so that
    /// (1, 1, 1) is the integrated white of D65, which differs from its rounded chromaticity by 2e-4.
    pub fn bt709() -> &'static Self {
        &BT709
    }

    /// (ρ_r, ρ_g, ρ_b) at a wavelength.
    pub fn at_nm(&self, wavelength_nm: f64) -> DVec3 {
        DVec3::from_array(self.rho.each_ref().map(|rho| rho.at_nm(wavelength_nm)))
    }

    /// The matrix from linear BT.709 light to the XYZ of the light that remains after reflection with `reflectance[i]` at wavelength `i` of
    /// the weights. Under an illuminant other than D65 nothing is adapted: white light has that illuminant's white.
    pub fn light_matrix(&self, weights: &ColourWeights, reflectance: &[f64]) -> DMat3 {
        let column = |rho: &Spectrum| weights.integrate(|i| rho.at_nm(weights.wavelengths_nm()[i]) * reflectance[i]);
        let [r, g, b] = self.rho.each_ref().map(column);
        DMat3::from_cols(r, g, b)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BT709 as BT709_SPACE, BUILT_IN, Illuminant};
    use super::*;
    use crate::physics::spectra::{SAMPLES, wavelength_nm};

    #[test]
    fn reproduces_the_primaries_under_d65() {
        let weights = ColourWeights::new(&Illuminant::default());
        let primaries = BT709_SPACE.to_xyz();
        let target = DMat3::from_diagonal(weights.white() / (primaries * DVec3::ONE)) * primaries;
        let found = Uplift::bt709().light_matrix(&weights, &[1.0; SAMPLES]);
        // The fit's own residual is 5.26e-5.
        assert!(found.abs_diff_eq(target, 5.3e-5), "{found} instead of {target}");
    }

    #[test]
    fn white_light_is_the_illuminant_itself() {
        for name in BUILT_IN.iter().map(|light| light.name) {
            let weights = ColourWeights::new(&name.parse().expect("built in"));
            let mirror = Uplift::bt709().light_matrix(&weights, &vec![1.0; weights.as_slice().len()]) * DVec3::ONE;
            assert!((mirror - weights.white()).abs().max_element() < 1e-13, "{name}");
        }
    }

    #[test]
    fn spectra_are_nonnegative_and_sum_to_one() {
        for i in 0..SAMPLES {
            let rho = Uplift::bt709().at_nm(wavelength_nm(i));
            assert!(rho.min_element() >= 0.0 && (rho.element_sum() - 1.0).abs() < 1e-14, "sample {i}: {rho}");
        }
    }
}
