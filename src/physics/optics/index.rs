//! Refractive index of the film's liquid.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use thiserror::Error;

/// Refractive indices that a film without dispersion may have: 1 is no film at all, 4 is beyond every clear liquid and glass.
pub const INDEX_RANGE: RangeInclusive<f64> = 1.0..=4.0;

/// The wavelength (sodium D, nm) at which one number stands for a whole film, as in tables of refractive indices.
pub const REFERENCE_NM: f64 = 589.0;

/// Strengths A of the four Sellmeier terms of water at 20 °C.
const WATER_A: [f64; 4] = [0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688];
/// Resonances B of the four Sellmeier terms of water at 20 °C, µm².
const WATER_B: [f64; 4] = [5.101829712e-3, 1.821153936e-2, 2.620722293e-2, 10.69792721];

/// A film index that is none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FilmIndexError {
    /// Neither a known liquid nor a number.
    #[error("`{0}` is no film index; write `water` or a refractive index from 1 to 4")]
    Unknown(String),
    /// A number that no clear film has.
    #[error("refractive index {0} is out of range; write one from 1 to 4")]
    OutOfRange(f64),
}

/// What the film is made of, as far as light is concerned.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum FilmIndex {
    /// Water at 20 °C with its dispersion.
    #[default]
    Water,
    /// One index for all wavelengths, 1 to 4; [`FilmIndex::constant`] checks it.
    Constant(f64),
}

impl FilmIndex {
    /// A film without dispersion, `n` from 1 to 4.
    pub fn constant(n: f64) -> Result<Self, FilmIndexError> {
        if INDEX_RANGE.contains(&n) { Ok(Self::Constant(n)) } else { Err(FilmIndexError::OutOfRange(n)) }
    }

    /// Refractive index, relative to vacuum, at a vacuum wavelength of 182 to 1129 nm (the range of the fit for water).
    pub fn n(&self, wavelength_nm: f64) -> f64 {
        match self {
            Self::Water => water_index(wavelength_nm),
            Self::Constant(n) => *n,
        }
    }
}

/// n of water at 20.0 °C: n² − 1 = Σ A λ² / (λ² − B), λ in µm.
///
/// M. Daimon and A. Masumura, "Measurement of the refractive index of distilled water from the near-infrared region to the ultraviolet
/// region", Applied Optics 46, 3811 (2007). IAPWS R9-97 agrees within 1.04e-5 over 360 to 780 nm.
fn water_index(wavelength_nm: f64) -> f64 {
    let lambda2 = (wavelength_nm * 1e-3).powi(2);
    let terms = WATER_A.iter().zip(WATER_B).map(|(a, b)| a * lambda2 / (lambda2 - b));
    (1.0 + terms.sum::<f64>()).sqrt()
}

impl FromStr for FilmIndex {
    type Err = FilmIndexError;

    /// `water` (in any case) or a number.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        if text.eq_ignore_ascii_case("water") {
            return Ok(Self::Water);
        }
        text.parse().map_err(|_| FilmIndexError::Unknown(text.into())).and_then(Self::constant)
    }
}

impl fmt::Display for FilmIndex {
    /// What [`FromStr`] reads back to the same film.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Water => f.write_str("water"),
            Self::Constant(n) => write!(f, "{n}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn water_has_its_handbook_index_at_the_sodium_line() {
        // 1.33299 at 589.3 nm and 20 °C (CRC handbook) is relative to air, which has 1.00027; both are good to about 1e-5.
        assert!((FilmIndex::Water.n(589.3) - 1.33299 * 1.00027).abs() < 1e-5, "{}", FilmIndex::Water.n(589.3));
    }

    #[test]
    fn water_bends_blue_light_more() {
        assert!(FilmIndex::Water.n(400.0) - FilmIndex::Water.n(700.0) > 0.01);
    }

    #[test]
    fn reads_back_what_it_prints() {
        for film in [FilmIndex::Water, FilmIndex::Constant(1.33), FilmIndex::Constant(4.0), FilmIndex::Constant(1.0)] {
            assert_eq!(film.to_string().parse(), Ok(film));
        }
        assert_eq!(" Water ".parse(), Ok(FilmIndex::Water));
    }

    #[test]
    fn refuses_what_no_film_has() {
        for text in ["0.99", "4.01", "-1", "nan", "inf"] {
            assert!(matches!(text.parse::<FilmIndex>(), Err(FilmIndexError::OutOfRange(_))), "{text}");
        }
        assert_eq!("soap".parse::<FilmIndex>(), Err(FilmIndexError::Unknown("soap".into())));
    }
}
