//! The light that the film is seen in.

use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{BUILT_IN, BuiltIn, Line, Observer};
use crate::physics::spectra::{FIRST_NM, SAMPLES, Spectrum, SpectrumError, wavelength_nm};

/// Second radiation constant hc/k, nm K (CODATA 2018).
const SECOND_RADIATION_NM_K: f64 = 1.438_776_877e7;

/// Temperatures of black bodies whose light has a shape in f64 and a use: embers to the bluest stars, K.
const TEMPERATURES_K: std::ops::RangeInclusive<f64> = 800.0..=100_000.0;

/// The smallest luminous efficiency, 1 at 555 nm, that a light may have, as at 372 nm and 775 nm. A mirror shows every light at Y = 1,
/// and fainter ones would be nothing but XYZ far from any colour.
const MIN_SEEN: f64 = 2e-5;

/// A name of no built-in illuminant.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum UnknownIlluminant {
    /// No light of that name.
    #[error("unknown illuminant `{0}`; known are {known}, a black body like `3000 K`, or a file like `lamp.csv`", known = BuiltIn::names())]
    Name(String),
    /// A black body too cold or too hot.
    #[error("a black body of {0} K is out of range; use 800 K to 100000 K")]
    Temperature(f64),
}

/// A light source: its name and relative spectral power, continuous and in lines. The unit of power is free, as every integral divides it
/// out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Illuminant {
    name: String,
    spectrum: Spectrum,
    lines: Vec<Line>,
}

impl Illuminant {
    /// A light source of one's own; refuses a spectrum without power in the visible range, or with none that is seen.
    pub fn new(name: impl Into<String>, spectrum: Spectrum) -> Result<Self, SpectrumError> {
        let name = name.into();
        spectrum.check_power(&name)?;
        let observer = Observer::cie_1931_2deg();
        let seen: f64 = spectrum.iter().enumerate().map(|(i, power)| power * observer.at_nm(wavelength_nm(i)).y).sum();
        if seen < MIN_SEEN * spectrum.iter().sum::<f64>() {
            return Err(SpectrumError::Unseen { file: name });
        }
        Ok(Self { name, spectrum, lines: Vec::new() })
    }

    /// Reads a light source from the text of a CSV file, see [`Spectrum::from_csv`]; `name` is the file's name.
    pub fn from_csv(name: &str, text: &str, notes: &mut Vec<String>) -> Result<Self, SpectrumError> {
        Spectrum::from_csv(name, text, notes).and_then(|spectrum| Self::new(name, spectrum))
    }

    /// A black body (M. Planck 1901), 800 to 100 000 K.
    pub fn black_body(temperature_k: f64) -> Result<Self, UnknownIlluminant> {
        if !TEMPERATURES_K.contains(&temperature_k) {
            return Err(UnknownIlluminant::Temperature(temperature_k));
        }
        let exponent = |nm: f64| SECOND_RADIATION_NM_K / (nm * temperature_k);
        // Relative to 560 nm, so that no temperature leaves the range of powers.
        let power = |nm: f64| (560.0 / nm).powi(5) * exponent(560.0).exp_m1() / exponent(nm).exp_m1();
        Ok(Self { name: format!("{temperature_k} K"), spectrum: Spectrum::from_fn(power), lines: Vec::new() })
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Relative spectral power of the continuous part.
    pub fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    /// Its lines, which stand beside the continuous part and are never spread over a grid.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// Whether all of its light has nearly one hue, so that there is no white to balance to: lines within ten nanometres alone.
    pub fn is_monochromatic(&self) -> bool {
        let ends = self.lines.iter().fold([f64::INFINITY, 0.0], |[low, high], line| {
            [line.wavelength_nm.min(low), line.wavelength_nm.max(high)]
        });
        self.spectrum.iter().all(|power| power == 0.0) && ends[1] - ends[0] < 10.0
    }

    /// This light with its continuous part as lines, `per_nm` per nanometre: integrals then resolve fringes finer than the grid, which
    /// films of more than some 10 µm have.
    #[must_use]
    pub(super) fn as_lines(&self, lines_per_nm: usize) -> Self {
        let power = |nm: f64| self.spectrum.at_nm(nm) / lines_per_nm as f64;
        let line = |k: usize| FIRST_NM + k as f64 / lines_per_nm as f64;
        let continuous = (0..=(SAMPLES - 1) * lines_per_nm).map(line);
        let continuous = continuous.map(|wavelength_nm| Line { wavelength_nm, power: power(wavelength_nm) });
        let lines = continuous.chain(self.lines.iter().copied()).collect();
        Self { name: self.name.clone(), spectrum: Spectrum::constant(0.0), lines }
    }
}

impl From<&BuiltIn> for Illuminant {
    fn from(built_in: &BuiltIn) -> Self {
        let (spectrum, lines) = built_in.light();
        Self { name: built_in.name.into(), spectrum, lines }
    }
}

impl Default for Illuminant {
    /// D65, the white of the RGB spaces in use here.
    fn default() -> Self {
        Self::from(&BUILT_IN[0])
    }
}

impl FromStr for Illuminant {
    type Err = UnknownIlluminant;

    /// A name of [`BUILT_IN`] in any case, or a temperature like `3000 K`.
    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let upper = name.trim().to_ascii_uppercase();
        if let Some(temperature) = upper.strip_suffix('K').and_then(|number| number.trim().parse().ok()) {
            return Self::black_body(temperature);
        }
        let known = BuiltIn::named(name.trim()).ok_or_else(|| UnknownIlluminant::Name(name.into()))?;
        Ok(known.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(name: &str) -> Illuminant {
        name.parse().expect("built in")
    }

    #[test]
    fn tables_are_the_published_ones() {
        let power = |name: &str, nm: usize| light(name).spectrum().at(nm - 360);
        // CIE tables give D illuminants and A the value 100 at 560 nm; 562 nm lies on the straight line to 565 nm.
        for name in ["D65", "D50", "A"] {
            assert_eq!(power(name, 560), 100.0, "{name}");
        }
        assert!((power("D65", 562) - (100.0 + 0.4 * (98.1671 - 100.0))).abs() < 1e-12);
        assert_eq!(power("E", 400), power("E", 700));
        assert!(power("FL11", 545) > 5.0 * power("FL11", 560), "the green band of FL11");
    }

    #[test]
    fn illuminant_a_is_a_black_body() {
        // CIE A is Planck's law at 2848 K with the radiation constant of its day, 1.4350e-2 m K: 2855.5 K with today's.
        let body = Illuminant::black_body(2848.0 * 1.438_776_877 / 1.4350).expect("in range");
        for i in (0..421).step_by(10) {
            let (tabulated, computed) = (light("A").spectrum().at(i), 100.0 * body.spectrum().at(i));
            assert!((tabulated / computed - 1.0).abs() < 2e-5, "sample {i}: {tabulated} {computed}");
        }
        assert_eq!(light("2856 k").name(), "2856 K");
        assert_eq!("500 K".parse::<Illuminant>(), Err(UnknownIlluminant::Temperature(500.0)));
        assert!(matches!("nan K".parse::<Illuminant>(), Err(UnknownIlluminant::Temperature(_))));
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let message = "D66".parse::<Illuminant>().expect_err("unknown").to_string();
        assert!(message.starts_with("unknown illuminant `D66`; known are D65, D50, A, E, FL2,"), "{message}");
    }

    #[test]
    fn darkness_is_no_illuminant() {
        let error = Illuminant::new("night", Spectrum::constant(0.0)).expect_err("dark");
        assert!(error.to_string().starts_with("night: has no usable power"), "{error}");
        let lamp = |points: &[(f64, f64)]| Illuminant::new("lamp", Spectrum::from_points(points));
        let unseen = [[(360.0, 1.0), (365.0, 0.0)], [(776.0, 0.0), (780.0, 1.0)]].map(|points| lamp(&points));
        for light in unseen {
            assert!(light.expect_err("unseen").to_string().starts_with("lamp: cannot be seen"));
        }
        assert!(
            lamp(&[(390.0, 0.0), (395.0, 1.0), (400.0, 0.0)]).is_ok() && lamp(&[(720.0, 0.0), (780.0, 1.0)]).is_ok()
        );
    }
}
