//! The light that the film is seen in.

use std::str::FromStr;

use thiserror::Error;

use crate::physics::spectra::{Spectrum, SpectrumError};

const D65: &str = include_str!("../../../assets/spectra/illuminant_d65.csv");
const D50: &str = include_str!("../../../assets/spectra/illuminant_d50.csv");
const A: &str = include_str!("../../../assets/spectra/illuminant_a.csv");

/// A name that is no built-in illuminant's.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("unknown illuminant `{name}`; known are {}", Illuminant::NAMES.join(", "))]
pub struct UnknownIlluminant {
    /// The name asked for.
    pub name: String,
}

/// A light source: its name and relative spectral power. The unit of power is free, as every integral divides it out.
#[derive(Clone, Debug, PartialEq)]
pub struct Illuminant {
    name: String,
    spectrum: Spectrum,
}

impl Illuminant {
    /// Names of the built-in illuminants, which [`FromStr`] takes in any case: CIE daylights D65 and D50, CIE A (tungsten, 2856 K) and
    /// E (equal power at every wavelength).
    pub const NAMES: [&str; 4] = ["D65", "D50", "A", "E"];

    /// A light source of one's own; refuses a spectrum without power in the visible range.
    pub fn new(name: impl Into<String>, spectrum: Spectrum) -> Result<Self, SpectrumError> {
        let name = name.into();
        spectrum.check_power(&name)?;
        Ok(Self { name, spectrum })
    }

    /// Reads a light source from the text of a CSV file, see [`Spectrum::from_csv`]; `name` is the file's name.
    pub fn from_csv(name: &str, text: &str) -> Result<Self, SpectrumError> {
        Spectrum::from_csv(name, text).and_then(|spectrum| Self::new(name, spectrum))
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Relative spectral power.
    pub fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    fn built_in(name: &str, text: &str) -> Self {
        // The text is part of the program, and a test below parses every built-in.
        Self::from_csv(name, text).expect("built-in illuminants are valid")
    }
}

impl Default for Illuminant {
    /// D65, the white of the RGB spaces in use here.
    fn default() -> Self {
        Self::built_in("D65", D65)
    }
}

impl FromStr for Illuminant {
    type Err = UnknownIlluminant;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name.trim().to_ascii_uppercase().as_str() {
            "D65" => Ok(Self::default()),
            "D50" => Ok(Self::built_in("D50", D50)),
            "A" => Ok(Self::built_in("A", A)),
            "E" => Ok(Self { name: "E".into(), spectrum: Spectrum::constant(1.0) }),
            _ => Err(UnknownIlluminant { name: name.into() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_known_in_any_case() {
        for name in Illuminant::NAMES {
            assert_eq!(name.to_lowercase().parse::<Illuminant>().expect("built in").name(), name);
        }
    }

    #[test]
    fn tables_are_the_published_ones() {
        let power = |name: &str, nm: usize| name.parse::<Illuminant>().expect("built in").spectrum().at(nm - 360);
        // CIE tables give D illuminants and A the value 100 at 560 nm; 562 nm lies on the straight line to 565 nm.
        for name in ["D65", "D50", "A"] {
            assert_eq!(power(name, 560), 100.0, "{name}");
        }
        assert!((power("D65", 562) - (100.0 + 0.4 * (98.1671 - 100.0))).abs() < 1e-12);
        assert_eq!(power("E", 400), power("E", 700));
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let message = "D66".parse::<Illuminant>().expect_err("unknown").to_string();
        assert_eq!(message, "unknown illuminant `D66`; known are D65, D50, A, E");
    }

    #[test]
    fn darkness_is_no_illuminant() {
        let error = Illuminant::new("night", Spectrum::constant(0.0)).expect_err("dark");
        assert!(error.to_string().starts_with("night: has no usable power"), "{error}");
    }
}
