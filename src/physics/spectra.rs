//! Spectra on the one wavelength grid that every integral here uses: 360 to 780 nm in steps of 1 nm.
//!
//! The grid is that fine because a film of a few micrometres makes narrow fringes: 81 samples alias (up to CIEDE2000 3.4 for films to
//! 3 µm near grazing), 421 do not.

mod error;
mod read;

use std::array;

use serde::{Deserialize, Serialize};

pub use error::SpectrumError;

/// First wavelength of the grid, nm.
pub const FIRST_NM: f64 = 360.0;
/// Last wavelength of the grid, nm.
pub const LAST_NM: f64 = FIRST_NM + (SAMPLES - 1) as f64;
/// First wavelength that a table must reach, nm: where the CIE begins its lamps. The first value goes on from there down to [`FIRST_NM`].
pub const FIRST_NEEDED_NM: f64 = 380.0;
/// Samples in the grid, 1 nm apart.
pub const SAMPLES: usize = 421;

/// Total power (sum over the grid) that a file may have: far wider than any unit needs, and no later sum overflows or underflows.
const POWER_RANGE: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// Refractive indices that a film may have: 1 is no film at all, 4 is beyond every clear liquid and glass.
pub const INDEX_RANGE: std::ops::RangeInclusive<f64> = 1.0..=4.0;

/// Wavelength of sample `i` in nm, vacuum.
pub fn wavelength_nm(i: usize) -> f64 {
    FIRST_NM + i as f64
}

/// A function of wavelength, sampled at 360, 361, …, 780 nm. What the values mean (relative power, reflectance) is the holder's business.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    #[serde(with = "samples")]
    samples: Box<[f64; SAMPLES]>,
}

/// All samples as bytes.
mod samples {
    use serde::{Deserializer, Serializer, de::Error};

    use super::SAMPLES;
    use crate::physics::bulk;

    pub fn serialize<S: Serializer>(samples: &[f64; SAMPLES], serializer: S) -> Result<S::Ok, S::Error> {
        bulk::serialize(samples, serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Box<[f64; SAMPLES]>, D::Error> {
        let samples: Vec<f64> = bulk::deserialize(deserializer)?;
        samples.try_into().map_err(|_| D::Error::custom("a spectrum of another length"))
    }
}

impl Spectrum {
    /// The spectrum whose sample at each wavelength (nm) is `value(wavelength_nm)`.
    pub fn from_fn(value: impl Fn(f64) -> f64) -> Self {
        Self { samples: Box::new(array::from_fn(|i| value(wavelength_nm(i)))) }
    }

    /// The same value at every wavelength.
    pub fn constant(value: f64) -> Self {
        Self::from_fn(|_| value)
    }

    /// Linear interpolation between `(wavelength_nm, value)` points with rising wavelengths; the first and last value go on outside.
    /// Without points the spectrum is zero.
    pub fn from_points(points: &[(f64, f64)]) -> Self {
        Self::from_fn(|nm| interpolate(points, nm))
    }

    /// As [`Spectrum::from_points`], but zero before the first point and after the last.
    pub fn within_points(points: &[(f64, f64)]) -> Self {
        let ends = points.first().zip(points.last());
        let is_within = |nm: f64| ends.is_some_and(|(first, last)| (first.0..=last.0).contains(&nm));
        Self::from_fn(|nm| if is_within(nm) { interpolate(points, nm) } else { 0.0 })
    }

    /// Reads a [table](super::table) of two columns, wavelength and value, in nm. Wavelengths in µm, Å or m are understood where they
    /// alone cover what is needed.
    ///
    /// Wavelengths must rise or fall, and cover 380 to 780 nm; where they begin above 360 nm the first value goes on to there. Values
    /// must be finite, not negative and not all zero. `name` is the file's name, for messages; what a user should know of how the file
    /// was read is added to `notes`, a line each.
    pub fn from_csv(name: &str, text: &str, notes: &mut Vec<String>) -> Result<Self, SpectrumError> {
        let [spectrum] = Self::columns_from_csv(name, text, notes)?;
        Ok(spectrum)
    }

    /// As [`Spectrum::from_csv`] for a file with `N` columns of values after the wavelength.
    pub fn columns_from_csv<const N: usize>(
        name: &str,
        text: &str,
        notes: &mut Vec<String>,
    ) -> Result<[Self; N], SpectrumError> {
        let rows = read::values(name, text, N, notes)?;
        let columns = array::from_fn(|column| Self::from_points(&read::points(&rows, column)));
        columns.iter().try_for_each(|spectrum: &Self| spectrum.check_power(name))?;
        Ok(columns)
    }

    /// As [`Spectrum::from_csv`] for a refractive index, n from 1 to 4 within 360 to 780 nm. A third column, or a second block, of
    /// extinction coefficients k is checked to belong to a clear film, and left out.
    pub fn index_from_csv(name: &str, text: &str, notes: &mut Vec<String>) -> Result<Self, SpectrumError> {
        let rows = read::index(name, text, notes)?;
        Ok(Self::from_points(&read::points(&rows, 0)))
    }

    /// Sample `i` of 0..421, at `360 + i` nm.
    ///
    /// # Panics
    /// If `i` is outside the grid, as indexing a slice does.
    pub fn at(&self, i: usize) -> f64 {
        self.samples[i]
    }

    /// The value at a wavelength, linear between the samples; the first and last go on outside.
    pub fn at_nm(&self, wavelength_nm: f64) -> f64 {
        let position = (wavelength_nm - FIRST_NM).clamp(0.0, (SAMPLES - 1) as f64);
        let left = (position as usize).min(SAMPLES - 2);
        let t = position - left as f64;
        self.samples[left] * (1.0 - t) + self.samples[left + 1] * t
    }

    /// All samples, by rising wavelength.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.samples.iter().copied()
    }

    /// Refuses a spectrum that has no power to divide by; `name` is for the message.
    pub(crate) fn check_power(&self, name: &str) -> Result<(), SpectrumError> {
        let total: f64 = self.iter().sum();
        if POWER_RANGE.contains(&total) { Ok(()) } else { Err(SpectrumError::Power { file: name.into(), total }) }
    }
}

fn interpolate(points: &[(f64, f64)], nm: f64) -> f64 {
    let right = points.partition_point(|&(x, _)| x <= nm);
    match (right.checked_sub(1).map(|left| points[left]), points.get(right)) {
        (Some((x0, y0)), Some(&(x1, y1))) => y0 + (y1 - y0) * (nm - x0) / (x1 - x0),
        (Some((_, y)), None) | (None, Some(&(_, y))) => y,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> SpectrumError {
        Spectrum::from_csv("lamp.csv", text, &mut Vec::new()).expect_err("must be refused")
    }

    #[test]
    fn grid_ends_at_780_nm() {
        assert_eq!((wavelength_nm(0), wavelength_nm(SAMPLES - 1), LAST_NM), (360.0, 780.0, 780.0));
    }

    #[test]
    fn interpolates_linearly_and_hits_the_points() {
        let text = "# made up\nwavelength_nm,power\n350,0\n360,1\n570,3\n\n790,25\n";
        let spectrum = Spectrum::from_csv("lamp.csv", text, &mut Vec::new()).expect("valid");
        for (i, expected) in [(0, 1.0), (105, 2.0), (210, 3.0), (320, 14.0), (420, 24.0)] {
            assert!((spectrum.at(i) - expected).abs() < 1e-14, "sample {i}: {} instead of {expected}", spectrum.at(i));
        }
        assert_eq!(spectrum.iter().len(), SAMPLES);
    }

    #[test]
    fn reads_what_spreadsheets_write() {
        let text = "\u{feff}nm,power\r\n360, 1\r\n780 ,1\r\n";
        assert_eq!(Spectrum::from_csv("lamp.csv", text, &mut Vec::new()), Ok(Spectrum::constant(1.0)));
    }

    #[test]
    fn reads_between_its_samples() {
        let spectrum = Spectrum::from_fn(|nm| nm);
        for nm in [360.0, 360.25, 589.592, 780.0] {
            assert!((spectrum.at_nm(nm) - nm).abs() < 1e-12, "{nm}");
        }
        assert_eq!((spectrum.at_nm(0.0), spectrum.at_nm(1e9)), (360.0, 780.0));
    }

    #[test]
    fn points_outside_the_table_hold_the_end_values() {
        let spectrum = Spectrum::from_points(&[(400.0, 2.0), (500.0, 4.0)]);
        assert_eq!((spectrum.at(0), spectrum.at(SAMPLES - 1)), (2.0, 4.0));
        assert_eq!(Spectrum::from_points(&[]), Spectrum::constant(0.0));
    }

    #[test]
    fn a_spectrum_can_end_at_its_points() {
        let spectrum = Spectrum::within_points(&[(400.0, 2.0), (500.0, 4.0)]);
        let values = [399.0, 400.0, 450.0, 500.0, 501.0].map(|nm| spectrum.at_nm(nm));
        assert_eq!(values, [0.0, 2.0, 3.0, 4.0, 0.0]);
        assert_eq!(Spectrum::within_points(&[]), Spectrum::constant(0.0));
    }

    #[test]
    fn each_mistake_is_named_with_its_file_and_line() {
        let cases = [
            ("360,1\n400,NaN\n780,1", "lamp.csv, line 2: `NaN` is not a finite number"),
            ("nan,1\n780,1", "lamp.csv, line 1: `nan` is not a finite number"),
            ("nm,power\n360,1\n400,inf\n780,1", "lamp.csv, line 3: `inf` is not a finite number"),
            ("360,1\nfoo,1\n780,1", "lamp.csv, line 2: `foo` is not a finite number"),
            ("# c\n360,1\n400,-0.5\n780,1", "lamp.csv, line 3: -0.5 is negative"),
            ("360,1\n500,1\n400,1\n780,1", "lamp.csv, line 3: 400 nm follows 500 nm"),
            ("360,1\n360,1\n780,1", "lamp.csv, line 2: 360 nm follows 360 nm"),
            ("360,1\n780,1,1", "lamp.csv, line 2: 3 column(s) instead of 2"),
            ("360\n780", "lamp.csv, line 1: 1 column(s) instead of 2"),
            ("390,1\n780,1", "lamp.csv: covers 390 to 780 nm, but must cover 380 to 780 nm"),
            ("360,1\n730,1", "lamp.csv: covers 360 to 730 nm, but must cover 380 to 780 nm"),
            ("nm,power\n", "lamp.csv: has no data"),
            ("360,0\n780,0", "lamp.csv: has no usable power"),
            ("360,1e300\n780,1e300", "lamp.csv: has no usable power"),
        ];
        let index = |text| {
            Spectrum::index_from_csv("glass.csv", text, &mut Vec::new()).expect_err("must be refused").to_string()
        };
        assert!(index("nm,n\n360,1.5\n780,0.9").starts_with("glass.csv, line 3: refractive index 0.9"));
        assert!(index("360,1.5\n500,NaN").starts_with("glass.csv, line 2: `NaN` is not"));
        for (text, expected) in cases {
            let message = refusal(text).to_string();
            assert!(message.starts_with(expected), "`{message}` instead of `{expected}…`");
        }
    }
}
