//! Spectra on the one wavelength grid that every integral here uses: 360 to 780 nm in steps of 1 nm.
//!
//! The grid is that fine because a film of a few micrometres makes narrow fringes: 81 samples alias (up to CIEDE2000 3.4 for films to
//! 3 µm near grazing), 421 do not.

use std::array;

use thiserror::Error;

/// First wavelength of the grid, nm.
pub const FIRST_NM: f64 = 360.0;
/// Last wavelength of the grid, nm.
pub const LAST_NM: f64 = FIRST_NM + (SAMPLES - 1) as f64;
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

/// Why a spectrum was refused. Each message is one line that names the file (and the line in it, counted from 1).
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpectrumError {
    /// A line does not have the right number of columns.
    #[error(
        "{file}, line {line}: {found} column(s) instead of {expected}; write the wavelength in nm, then the values, separated by commas"
    )]
    Columns {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Columns found.
        found: usize,
        /// Columns wanted, the wavelength included.
        expected: usize,
    },
    /// Text that is no number, or a number that is not finite.
    #[error("{file}, line {line}: `{text}` is not a finite number")]
    NotFinite {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The field as it stands there.
        text: String,
    },
    /// A negative value.
    #[error("{file}, line {line}: {value} is negative; a spectrum holds zero or positive values")]
    Negative {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The value.
        value: f64,
    },
    /// A refractive index that no film has.
    #[error("{file}, line {line}: a refractive index of {value} is no film's; write one from 1 to 4")]
    Index {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The value.
        value: f64,
    },
    /// Wavelengths that do not rise.
    #[error(
        "{file}, line {line}: {wavelength_nm} nm follows {previous_nm} nm; sort the lines by rising wavelength, each once"
    )]
    Unordered {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Wavelength of this line.
        wavelength_nm: f64,
        /// Wavelength of the line before.
        previous_nm: f64,
    },
    /// The table has no lines of data.
    #[error("{file}: holds no data; write lines of `wavelength_nm,value` from {FIRST_NM} to {LAST_NM} nm")]
    Empty {
        /// The file.
        file: String,
    },
    /// The table does not cover the grid.
    #[error("{file}: covers {first_nm} to {last_nm} nm, needed are {FIRST_NM} to {LAST_NM} nm; add the missing ends")]
    TooShort {
        /// The file.
        file: String,
        /// First wavelength found.
        first_nm: f64,
        /// Last wavelength found.
        last_nm: f64,
    },
    /// No usable power in the visible range.
    #[error(
        "{file}: has no usable power between {FIRST_NM} and {LAST_NM} nm (the sum is {total:e}, needed is 1e-30 to 1e30)"
    )]
    Power {
        /// The file.
        file: String,
        /// Sum over the grid.
        total: f64,
    },
    /// Power where nobody sees it.
    #[error(
        "{file}: cannot be seen: next to all of its power between {FIRST_NM} and {LAST_NM} nm is ultraviolet or infrared"
    )]
    Unseen {
        /// The file.
        file: String,
    },
}

/// A function of wavelength, sampled at 360, 361, …, 780 nm. What the values mean (relative power, reflectance) is the holder's business.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    samples: Box<[f64; SAMPLES]>,
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

    /// Reads lines `wavelength_nm,value`. Empty lines, lines that start with `#` and one line of column names on top are skipped.
    /// Wavelengths must rise and cover 360 to 780 nm; values must be finite, not negative and not all zero. `name` is the file's name,
    /// for messages only.
    pub fn from_csv(name: &str, text: &str) -> Result<Self, SpectrumError> {
        let [spectrum] = Self::columns_from_csv(name, text)?;
        Ok(spectrum)
    }

    /// As [`Spectrum::from_csv`] for a file with `N` columns of values after the wavelength.
    pub fn columns_from_csv<const N: usize>(name: &str, text: &str) -> Result<[Self; N], SpectrumError> {
        let rows = parse_rows::<N>(name, text)?;
        check_coverage(name, &rows)?;
        let columns = array::from_fn(|column| {
            let points: Vec<_> = rows.iter().map(|row| (row.wavelength_nm, row.values[column])).collect();
            Self::from_points(&points)
        });
        columns.iter().try_for_each(|spectrum| spectrum.check_power(name))?;
        Ok(columns)
    }

    /// As [`Spectrum::from_csv`] for a refractive index, `wavelength_nm,n` with n from 1 to 4.
    pub fn index_from_csv(name: &str, text: &str) -> Result<Self, SpectrumError> {
        let rows = parse_rows::<1>(name, text)?;
        if let Some(row) = rows.iter().find(|row| !INDEX_RANGE.contains(&row.values[0])) {
            return Err(SpectrumError::Index { file: name.into(), line: row.line, value: row.values[0] });
        }
        check_coverage(name, &rows)?;
        Ok(Self::from_points(&rows.iter().map(|row| (row.wavelength_nm, row.values[0])).collect::<Vec<_>>()))
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

/// One line of a table.
struct Row<const N: usize> {
    line: usize,
    wavelength_nm: f64,
    values: [f64; N],
}

fn interpolate(points: &[(f64, f64)], nm: f64) -> f64 {
    let right = points.partition_point(|&(x, _)| x <= nm);
    match (right.checked_sub(1).map(|left| points[left]), points.get(right)) {
        (Some((x0, y0)), Some(&(x1, y1))) => y0 + (y1 - y0) * (nm - x0) / (x1 - x0),
        (Some((_, y)), None) | (None, Some(&(_, y))) => y,
        (None, None) => 0.0,
    }
}

fn parse_rows<const N: usize>(file: &str, text: &str) -> Result<Vec<Row<N>>, SpectrumError> {
    let mut rows: Vec<Row<N>> = Vec::new();
    for (line, content) in data_lines(text) {
        let row = parse_row(file, line, content)?;
        if let Some(previous) = rows.last().filter(|previous| previous.wavelength_nm >= row.wavelength_nm) {
            let (wavelength_nm, previous_nm) = (row.wavelength_nm, previous.wavelength_nm);
            return Err(SpectrumError::Unordered { file: file.into(), line, wavelength_nm, previous_nm });
        }
        rows.push(row);
    }
    Ok(rows)
}

/// The lines that hold data, with their numbers from 1.
fn data_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let mut lines = (1..).zip(lines).filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).peekable();
    lines.next_if(|(_, line)| is_heading(line));
    lines
}

/// Column names start with a letter; `nan` and `inf` do too, but are numbers to the parser and get its message.
fn is_heading(line: &str) -> bool {
    line.starts_with(char::is_alphabetic) && line.split(',').all(|field| field.trim().parse::<f64>().is_err())
}

fn parse_row<const N: usize>(file: &str, line: usize, content: &str) -> Result<Row<N>, SpectrumError> {
    let fields = content.split(',').map(|field| parse_field(file, line, field.trim()));
    let fields: Vec<f64> = fields.collect::<Result<_, _>>()?;
    let columns = || SpectrumError::Columns { file: file.into(), line, found: fields.len(), expected: N + 1 };
    let (&wavelength_nm, values) = fields.split_first().ok_or_else(columns)?;
    let values = <[f64; N]>::try_from(values).map_err(|_| columns())?;
    match values.iter().find(|value| **value < 0.0) {
        Some(&value) => Err(SpectrumError::Negative { file: file.into(), line, value }),
        None => Ok(Row { line, wavelength_nm, values }),
    }
}

fn parse_field(file: &str, line: usize, text: &str) -> Result<f64, SpectrumError> {
    let finite = text.parse().ok().filter(|value: &f64| value.is_finite());
    finite.ok_or_else(|| SpectrumError::NotFinite { file: file.into(), line, text: text.into() })
}

fn check_coverage<const N: usize>(file: &str, rows: &[Row<N>]) -> Result<(), SpectrumError> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Err(SpectrumError::Empty { file: file.into() });
    };
    let (first_nm, last_nm) = (first.wavelength_nm, last.wavelength_nm);
    if first_nm <= FIRST_NM && LAST_NM <= last_nm {
        Ok(())
    } else {
        Err(SpectrumError::TooShort { file: file.into(), first_nm, last_nm })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> SpectrumError {
        Spectrum::from_csv("lamp.csv", text).expect_err("must be refused")
    }

    #[test]
    fn grid_ends_at_780_nm() {
        assert_eq!((wavelength_nm(0), wavelength_nm(SAMPLES - 1), LAST_NM), (360.0, 780.0, 780.0));
    }

    #[test]
    fn interpolates_linearly_and_hits_the_points() {
        let text = "# made up\nwavelength_nm,power\n350,0\n360,1\n570,3\n\n790,25\n";
        let spectrum = Spectrum::from_csv("lamp.csv", text).expect("valid");
        for (i, expected) in [(0, 1.0), (105, 2.0), (210, 3.0), (320, 14.0), (420, 24.0)] {
            assert!((spectrum.at(i) - expected).abs() < 1e-14, "sample {i}: {} instead of {expected}", spectrum.at(i));
        }
        assert_eq!(spectrum.iter().len(), SAMPLES);
    }

    #[test]
    fn reads_what_spreadsheets_write() {
        let text = "\u{feff}nm,power\r\n360, 1\r\n780 ,1\r\n";
        assert_eq!(Spectrum::from_csv("lamp.csv", text), Ok(Spectrum::constant(1.0)));
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
            ("380,1\n780,1", "lamp.csv: covers 380 to 780 nm, needed are 360 to 780 nm"),
            ("360,1\n730,1", "lamp.csv: covers 360 to 730 nm, needed are 360 to 780 nm"),
            ("nm,power\n", "lamp.csv: holds no data"),
            ("360,0\n780,0", "lamp.csv: has no usable power"),
            ("360,1e300\n780,1e300", "lamp.csv: has no usable power"),
        ];
        let index = |text| Spectrum::index_from_csv("glass.csv", text).expect_err("must be refused").to_string();
        assert!(index("nm,n\n360,1.5\n780,0.9").starts_with("glass.csv, line 3: a refractive index of 0.9"));
        assert!(index("360,1.5\n500,NaN").starts_with("glass.csv, line 2: `NaN` is not"));
        for (text, expected) in cases {
            let message = refusal(text).to_string();
            assert!(message.starts_with(expected), "`{message}` instead of `{expected}…`");
        }
    }
}
