//! Refractive index of the film's liquid.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::liquids::{glycerol_solution_index, water_index, water_index_at};
use crate::physics::spectra::{INDEX_RANGE, Spectrum, SpectrumError};

/// The wavelength (sodium D, nm) at which one number stands for a whole film, as in tables of refractive indices.
pub const REFERENCE_NM: f64 = 589.0;

/// A film index that is none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FilmIndexError {
    /// Neither a known liquid nor a number.
    #[error(
        "`{0}` is not a film; write `water`, `water 25C`, `glycerol 30%`, a refractive index from 1 to 4, or a file like `n.csv`"
    )]
    Unknown(String),
    /// A number that no clear film has.
    #[error("refractive index {0} is out of range; use 1 to 4")]
    OutOfRange(f64),
    /// Ice or steam.
    #[error("water of {0} °C is out of range; use 0 to 40 °C")]
    Temperature(f64),
    /// More than all.
    #[error("{0} % of glycerol is out of range; use 0 to 100 %")]
    Share(f64),
}

/// What the film is made of, as far as light is concerned.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum FilmIndex {
    /// Water at 20 °C with its dispersion.
    #[default]
    Water,
    /// Water at a temperature in °C, 0 to 40; [`FilmIndex::water_at`] checks it.
    WaterAt(f64),
    /// Glycerol in water at 20 °C, per cent by mass; [`FilmIndex::glycerol`] checks it.
    Glycerol(f64),
    /// One index for all wavelengths, 1 to 4; [`FilmIndex::constant`] checks it.
    Constant(f64),
    /// An index for each wavelength, 1 to 4, and the name of the file it came from.
    Table(String, Arc<Spectrum>),
}

impl FilmIndex {
    /// A film without dispersion, `n` from 1 to 4.
    pub fn constant(n: f64) -> Result<Self, FilmIndexError> {
        if INDEX_RANGE.contains(&n) { Ok(Self::Constant(n)) } else { Err(FilmIndexError::OutOfRange(n)) }
    }

    /// Water at 0 to 40 °C.
    pub fn water_at(celsius: f64) -> Result<Self, FilmIndexError> {
        if (0.0..=40.0).contains(&celsius) {
            Ok(Self::WaterAt(celsius))
        } else {
            Err(FilmIndexError::Temperature(celsius))
        }
    }

    /// Glycerol in water at 20 °C, 0 to 100 per cent by mass.
    pub fn glycerol(percent: f64) -> Result<Self, FilmIndexError> {
        if (0.0..=100.0).contains(&percent) { Ok(Self::Glycerol(percent)) } else { Err(FilmIndexError::Share(percent)) }
    }

    /// Reads a table of wavelengths and indices, see [`Spectrum::index_from_csv`]; `name` is the file's name.
    pub fn from_csv(name: &str, text: &str, notes: &mut Vec<String>) -> Result<Self, SpectrumError> {
        Ok(Self::Table(name.into(), Arc::new(Spectrum::index_from_csv(name, text, notes)?)))
    }

    /// Refractive index, relative to vacuum, at a vacuum wavelength of 360 to 780 nm.
    pub fn n(&self, wavelength_nm: f64) -> f64 {
        match self {
            Self::Water => water_index(wavelength_nm),
            Self::WaterAt(celsius) => water_index_at(*celsius, wavelength_nm),
            Self::Glycerol(percent) => glycerol_solution_index(0.01 * percent, wavelength_nm),
            Self::Constant(n) => *n,
            Self::Table(_, table) => table.at_nm(wavelength_nm),
        }
    }
}

/// The number before a unit, if the text ends in the unit.
fn measured(text: &str, unit: &str) -> Option<f64> {
    text.strip_suffix(unit).and_then(|number| number.trim().parse().ok())
}

impl FromStr for FilmIndex {
    type Err = FilmIndexError;

    /// `water`, `water 25C`, `glycerol 30%` (in any case) or a number.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let lower = text.trim().to_ascii_lowercase();
        if lower == "water" {
            return Ok(Self::Water);
        }
        let after = |name: &str, unit: &str| measured(lower.strip_prefix(name)?, unit);
        if let Some(celsius) = after("water", "c") {
            return Self::water_at(celsius);
        }
        if let Some(percent) = after("glycerol", "%") {
            return Self::glycerol(percent);
        }
        lower.parse().map_err(|_| FilmIndexError::Unknown(text.trim().into())).and_then(Self::constant)
    }
}

impl fmt::Display for FilmIndex {
    /// What [`FromStr`] reads back to the same film; the file's name for a table.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Water => f.write_str("water"),
            Self::WaterAt(celsius) => write!(f, "water {celsius}C"),
            Self::Glycerol(percent) => write!(f, "glycerol {percent}%"),
            Self::Constant(n) => write!(f, "{n}"),
            Self::Table(name, _) => f.write_str(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_back_what_it_prints() {
        let films = [FilmIndex::Water, FilmIndex::WaterAt(25.5), FilmIndex::Glycerol(30.0), FilmIndex::Constant(1.33)];
        for film in films {
            assert_eq!(film.to_string().parse(), Ok(film));
        }
        assert_eq!(" Water ".parse(), Ok(FilmIndex::Water));
        assert_eq!("Water25 C".parse(), Ok(FilmIndex::WaterAt(25.0)));
    }

    #[test]
    fn refuses_what_no_film_has() {
        for text in ["0.99", "4.01", "-1", "nan", "inf"] {
            assert!(matches!(text.parse::<FilmIndex>(), Err(FilmIndexError::OutOfRange(_))), "{text}");
        }
        assert_eq!("soap".parse::<FilmIndex>(), Err(FilmIndexError::Unknown("soap".into())));
        assert_eq!("water 41C".parse::<FilmIndex>(), Err(FilmIndexError::Temperature(41.0)));
        assert!(matches!("water nanC".parse::<FilmIndex>(), Err(FilmIndexError::Temperature(_))));
        assert_eq!("glycerol 101%".parse::<FilmIndex>(), Err(FilmIndexError::Share(101.0)));
    }

    #[test]
    fn tables_are_read_between_their_lines() {
        let film = FilmIndex::from_csv("n.csv", "nm,n\n360,1.5\n780,1.4\n", &mut Vec::new()).expect("valid");
        assert!((film.n(570.0) - 1.45).abs() < 1e-12);
        assert_eq!(film.to_string(), "n.csv");
    }
}
