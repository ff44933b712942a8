//! What can be wrong with a table of a spectrum.

use thiserror::Error;

use super::{FIRST_NEEDED_NM, FIRST_NM, LAST_NM};

/// Why a spectrum was refused. Each message is one line that names the file (and the line in it, counted from 1).
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpectrumError {
    /// A line does not have the right number of columns.
    #[error(
        "{file}, line {line}: {found} column(s) instead of {expected}; write a wavelength and its value in each line ({hint})"
    )]
    Columns {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Columns found.
        found: usize,
        /// Columns needed, including the wavelength.
        expected: usize,
        /// The likeliest reason.
        hint: &'static str,
    },
    /// A field that does not hold a finite number.
    #[error("{file}, line {line}: `{text}` is not a finite number; {hint}")]
    NotFinite {
        /// File it stands in.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The field as it stands there.
        text: String,
        /// The likeliest reason.
        hint: &'static str,
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
    #[error("{file}, line {line}: refractive index {value} is out of range; use 1 to 4")]
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
    #[error("{file}: has no data; write lines of `wavelength_nm,value` from {FIRST_NEEDED_NM} to {LAST_NM} nm")]
    Empty {
        /// The file.
        file: String,
    },
    /// The table does not cover the grid.
    #[error("{file}: covers {first_nm} to {last_nm} nm, but must cover {FIRST_NEEDED_NM} to {LAST_NM} nm; {hint}")]
    TooShort {
        /// The file.
        file: String,
        /// First wavelength found.
        first_nm: f64,
        /// Last wavelength found.
        last_nm: f64,
        /// What may be wrong.
        hint: &'static str,
    },
    /// A second table in the same file.
    #[error("{file}, line {line}: a second block begins here, under `{heading}`; keep one block in the file")]
    SecondBlock {
        /// The file.
        file: String,
        /// Line of its heading, from 1.
        line: usize,
        /// The heading.
        heading: String,
    },
    /// A material that is not clear.
    #[error("{file}, line {line}: an extinction coefficient k of {k} is too large for a clear film; {hint}")]
    Absorbing {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The coefficient.
        k: f64,
        /// The likeliest reason.
        hint: &'static str,
    },
    /// No usable power in the visible range.
    #[error(
        "{file}: has no usable power between {FIRST_NM} and {LAST_NM} nm (the sum is {total:e}, and must be 1e-30 to 1e30)"
    )]
    Power {
        /// The file.
        file: String,
        /// Sum over the grid.
        total: f64,
    },
    /// Power where nobody sees it.
    #[error(
        "{file}: cannot be seen: almost all of its power between {FIRST_NM} and {LAST_NM} nm is ultraviolet or infrared"
    )]
    Unseen {
        /// The file.
        file: String,
    },
}
