//! Spectra and refractive indices from tables.

use super::{FIRST_NEEDED_NM, FIRST_NM, INDEX_RANGE, LAST_NM, SpectrumError};
use crate::physics::table::{self, Block, Table};

/// The largest extinction coefficient of a film that counts as clear: 1 µm of it takes a fifth of the light.
const MAX_EXTINCTION: f64 = 0.01;

/// Units that wavelengths come in, and nanometres in each.
const UNITS: [(&str, f64); 4] = [("nanometres", 1.0), ("micrometres", 1e3), ("ångströms", 0.1), ("metres", 1e9)];

/// One line of a table.
#[derive(Debug)]
pub(super) struct Row {
    line: usize,
    wavelength_nm: f64,
    values: Vec<f64>,
}

/// One column of values by wavelength in nm.
pub(super) fn points(rows: &[Row], column: usize) -> Vec<(f64, f64)> {
    rows.iter().map(|row| (row.wavelength_nm, row.values[column])).collect()
}

/// Rows with a number of values each, none negative, that cover the needed range.
pub(super) fn values(
    file: &str,
    text: &str,
    columns: usize,
    notes: &mut Vec<String>,
) -> Result<Vec<Row>, SpectrumError> {
    let table = Table::parse(text);
    let (block, others) = table.blocks.split_first().ok_or_else(|| SpectrumError::Empty { file: file.into() })?;
    if let Some(second) = others.first() {
        return Err(second_block(file, second));
    }
    let rows = covering(file, parse_block(file, &table, block, columns..=columns)?, block, notes)?;
    let negative = |row: &&Row| row.values.iter().any(|value| *value < 0.0);
    match rows.iter().find(negative) {
        Some(row) => {
            let value = row.values.iter().copied().fold(0.0, f64::min);
            Err(SpectrumError::Negative { file: file.into(), line: row.line, value })
        }
        None => Ok(rows),
    }
}

/// Rows of refractive indices, the first of their values.
pub(super) fn index(file: &str, text: &str, notes: &mut Vec<String>) -> Result<Vec<Row>, SpectrumError> {
    let table = Table::parse(text);
    let (extinctions, mut indices): (Vec<&Block>, Vec<&Block>) =
        table.blocks.iter().partition(|block| is_extinction(block));
    if indices.is_empty() {
        indices.clone_from(&extinctions);
    }
    let block = indices.first().ok_or_else(|| SpectrumError::Empty { file: file.into() })?;
    if let Some(second) = indices.get(1) {
        return Err(second_block(file, second));
    }
    let rows = covering(file, parse_block(file, &table, block, 1..=2)?, block, notes)?;
    if let Some(row) = rows.iter().find(|row| !INDEX_RANGE.contains(&row.values[0])) {
        return Err(SpectrumError::Index { file: file.into(), line: row.line, value: row.values[0] });
    }
    let mut extinction: Vec<(usize, f64)> =
        rows.iter().filter_map(|row| Some((row.line, *row.values.get(1)?))).collect();
    for block in extinctions {
        let rows = in_nm(parse_block(file, &table, block, 1..=1)?, block).0;
        extinction.extend(visible(rows).into_iter().map(|row| (row.line, row.values[0])));
    }
    leave_out(file, &table, &extinction, notes)?;
    Ok(rows)
}

/// Whether a block is of extinction coefficients, as `wl,k` says.
fn is_extinction(block: &Block) -> bool {
    block.heading.get(1).is_some_and(|name| name.eq_ignore_ascii_case("k"))
}

/// Checks that extinction coefficients, with their lines, belong to a clear film, and notes that they are left out.
fn leave_out(file: &str, table: &Table, k: &[(usize, f64)], notes: &mut Vec<String>) -> Result<(), SpectrumError> {
    let Some(&(line, k)) = k.iter().max_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(()) };
    if k > MAX_EXTINCTION {
        let hint = table.separator.hint();
        return Err(SpectrumError::Absorbing { file: file.into(), line, k, hint });
    }
    notes.push(format!("{file}: extinction coefficients k, at most {k}, are ignored, as films are clear here"));
    Ok(())
}

fn second_block(file: &str, block: &Block) -> SpectrumError {
    SpectrumError::SecondBlock { file: file.into(), line: block.line, heading: block.heading.join(",") }
}

/// All rows of a block, each with a number of values in a range.
fn parse_block(
    file: &str,
    table: &Table,
    block: &Block,
    columns: std::ops::RangeInclusive<usize>,
) -> Result<Vec<Row>, SpectrumError> {
    let parse = |row: &table::Row| {
        let end = row.fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        let fields = row.fields[..end].iter().map(|field| parse_field(file, row.line, field));
        let fields: Vec<f64> = fields.collect::<Result<_, _>>()?;
        match fields.split_first() {
            Some((&wavelength_nm, values)) if columns.contains(&values.len()) => {
                Ok(Row { line: row.line, wavelength_nm, values: values.to_vec() })
            }
            _ => Err(SpectrumError::Columns {
                file: file.into(),
                line: row.line,
                found: fields.len(),
                expected: 1 + columns.start(),
                hint: table.separator.hint(),
            }),
        }
    };
    block.rows.iter().map(parse).collect()
}

fn parse_field(file: &str, line: usize, text: &str) -> Result<f64, SpectrumError> {
    let finite = text.parse().ok().filter(|value: &f64| value.is_finite());
    finite.ok_or_else(|| SpectrumError::NotFinite { file: file.into(), line, text: text.into(), hint: hint(text) })
}

/// The likeliest reason why a field is not a number.
fn hint(text: &str) -> &'static str {
    let has_digit = text.contains(|c: char| c.is_ascii_digit());
    if text.is_empty() {
        "a field is empty: fill it in, or leave the line out"
    } else if has_digit && text.contains(',') {
        "decimal marks are either all commas or all points, without thousands separators"
    } else if has_digit && text.contains([';', ' ', '\t']) {
        "separate the columns of all lines in the same way"
    } else if has_digit {
        "write the number alone, without a unit"
    } else {
        "words belong in a heading, or in lines that start with #"
    }
}

/// Rows in nm by rising wavelength, of what is visible alone, and checked to cover it.
fn covering(file: &str, rows: Vec<Row>, block: &Block, notes: &mut Vec<String>) -> Result<Vec<Row>, SpectrumError> {
    let (mut rows, unit) = in_nm(rows, block);
    if rows.windows(2).all(|pair| pair[0].wavelength_nm > pair[1].wavelength_nm) {
        rows.reverse();
    }
    check_order(file, &rows)?;
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Err(SpectrumError::Empty { file: file.into() });
    };
    let (first_nm, last_nm) = (first.wavelength_nm, last.wavelength_nm);
    if !covers(first_nm, last_nm) {
        let hint = if overlaps(first_nm, last_nm) {
            "add the missing end"
        } else {
            "write wavelengths in nanometres or micrometres in the first column"
        };
        return Err(SpectrumError::TooShort { file: file.into(), first_nm, last_nm, hint });
    }
    if unit != UNITS[0].0 {
        notes.push(format!("{file}: wavelengths are taken as {unit}: {first_nm} to {last_nm} nm"));
    }
    if first_nm > FIRST_NM {
        notes.push(format!("{file}: the value at {first_nm} nm is also used down to {FIRST_NM} nm"));
    }
    Ok(visible(rows))
}

/// Rows in nm, and the unit that they were in: the one that the heading tells, or nm, or another, whichever covers what is needed; or
/// else whichever has some of it.
fn in_nm(mut rows: Vec<Row>, block: &Block) -> (Vec<Row>, &'static str) {
    let ends = |nm: f64| {
        let wavelengths = rows.iter().map(|row| to_nm(row.wavelength_nm, nm));
        wavelengths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), nm| (low.min(nm), high.max(nm)))
    };
    let told = block.heading.first().and_then(|name| told_unit(name)).map(|index| UNITS[index]);
    let units = || told.into_iter().chain(UNITS);
    let fits = |test: fn(f64, f64) -> bool| units().find(|(_, nm)| test(ends(*nm).0, ends(*nm).1));
    let (unit, nm) = fits(covers).or_else(|| fits(overlaps)).unwrap_or(UNITS[0]);
    for row in &mut rows {
        row.wavelength_nm = to_nm(row.wavelength_nm, nm);
    }
    (rows, unit)
}

/// Nanometres, free of the rounding that conversion brings.
fn to_nm(wavelength: f64, nm: f64) -> f64 {
    (wavelength * nm * 1e6).round() / 1e6
}

/// The index in [`UNITS`] of the unit that the name of a column tells. That of refractiveindex.info, `wl`, is in micrometres.
fn told_unit(name: &str) -> Option<usize> {
    let name = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if has(&["nm", "nano"]) {
        Some(0)
    } else if name == "wl" || has(&["µm", "μm", "um", "micro"]) {
        Some(1)
    } else {
        has(&["å", "angstrom", "ångström"]).then_some(2)
    }
}

fn covers(first_nm: f64, last_nm: f64) -> bool {
    first_nm <= FIRST_NEEDED_NM && LAST_NM <= last_nm
}

fn overlaps(first_nm: f64, last_nm: f64) -> bool {
    first_nm < LAST_NM && FIRST_NM < last_nm
}

fn check_order(file: &str, rows: &[Row]) -> Result<(), SpectrumError> {
    match rows.windows(2).find(|pair| pair[0].wavelength_nm >= pair[1].wavelength_nm) {
        Some([previous, row]) => Err(SpectrumError::Unordered {
            file: file.into(),
            line: row.line,
            wavelength_nm: row.wavelength_nm,
            previous_nm: previous.wavelength_nm,
        }),
        _ => Ok(()),
    }
}

/// The rows that interpolation from 360 to 780 nm needs: those within, and one beyond each end.
fn visible(mut rows: Vec<Row>) -> Vec<Row> {
    let above = rows.partition_point(|row| row.wavelength_nm < LAST_NM);
    rows.truncate(above + 1);
    let below = rows.partition_point(|row| row.wavelength_nm <= FIRST_NM);
    rows.split_off(below.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use crate::physics::spectra::{Spectrum, SpectrumError};

    fn read(text: &str) -> (Spectrum, Vec<String>) {
        let mut notes = Vec::new();
        let spectrum =
            Spectrum::from_csv("lamp.csv", text, &mut notes).unwrap_or_else(|error| panic!("{text}: {error}"));
        (spectrum, notes)
    }

    fn index(text: &str) -> Result<(Spectrum, Vec<String>), String> {
        let mut notes = Vec::new();
        let spectrum = Spectrum::index_from_csv("n.csv", text, &mut notes).map_err(|error| error.to_string())?;
        Ok((spectrum, notes))
    }

    #[test]
    fn units_are_told_apart_by_what_they_cover() {
        let (nanometres, notes) = read("300,1\n600,2\n900,4\n");
        assert_eq!(notes, [] as [&str; 0]);
        for (text, unit) in [
            ("wl,n\n0.3,1\n0.6,2\n0.9,4\n", "micrometres"),
            ("0.3,1\n0.6,2\n0.9,4\n", "micrometres"),
            ("wavelength_nm,n\n0.3,1\n0.6,2\n0.9,4\n", "micrometres"),
            ("A,n\n3000,1\n6000,2\n9000,4\n", "ångströms"),
            ("3e-7,1\n6e-7,2\n9e-7,4\n", "metres"),
        ] {
            let (spectrum, notes) = read(text);
            assert_eq!(spectrum, nanometres, "{text}");
            assert_eq!(notes, [format!("lamp.csv: wavelengths are taken as {unit}: 300 to 900 nm")], "{text}");
        }
        assert_eq!(read("wl,n\n300,1\n600,2\n900,4\n"), (nanometres, Vec::new()));
        // Both units would do: the heading tells.
        let wide = "0.1,1\n0.5,1\n1,2\n1000,2\n";
        assert_eq!(read(wide).1.len(), 0);
        assert_eq!(read(&format!("wl,n\n{wide}")).1.len(), 1);
        assert_eq!(read(&format!("λ (µm),n\n{wide}")).1.len(), 1);
    }

    #[test]
    fn wavelengths_may_fall() {
        assert_eq!(read("900,4\n600,2\n300,1\n"), read("300,1\n600,2\n900,4\n"));
    }

    #[test]
    fn the_first_value_goes_on_below_380_nm() {
        let (spectrum, notes) = read("380,2\n390,3\n780,1\n");
        assert_eq!((spectrum.at(0), spectrum.at(20), spectrum.at(30)), (2.0, 2.0, 3.0));
        assert_eq!(notes, ["lamp.csv: the value at 380 nm is also used down to 360 nm"]);
        assert_eq!(read("360,2\n780,1\n").1.len(), 0);
    }

    #[test]
    fn values_at_invisible_wavelengths_are_not_checked() {
        let (n, _) = index("10,0.98\n300,1.5\n800,1.25\n100000,0.1\n").expect("valid");
        assert_eq!(n, index("300,1.5\n800,1.25\n").expect("valid").0);
        assert_eq!(read("200,-0.1\n300,1\n800,1\n900,-0.1\n").0, Spectrum::constant(1.0));
    }

    #[test]
    fn extinction_of_clear_films_is_left_out() {
        let (plain, notes) = index("wl,n\n0.3,1.35\n0.8,1.25\n").expect("valid");
        assert_eq!(notes.len(), 1);
        let k = "n.csv: extinction coefficients k, at most 0.000003, are ignored, as films are clear here";
        for text in [
            "wl,n,k\n0.3,1.35,1e-6\n0.8,1.25,3e-6\n",
            "0.3;1,35;0,000001\n0.8;1,25;0,000003\n".replace("0.", "0,").as_str(),
            "wl,n\n0.3,1.35\n0.8,1.25\n\nwl,k\n0.3,1e-6\n0.8,3e-6\n20,0.4\n",
            "wl,k\n0.3,1e-6\n0.8,3e-6\n\nwl,n\n0.3,1.35\n0.8,1.25\n",
        ] {
            let (n, notes) = index(text).expect(text);
            assert_eq!(n, plain, "{text}");
            assert_eq!(notes[1..], [k], "{text}");
        }
    }

    #[test]
    fn likely_causes_are_named() {
        for (text, told) in [
            ("300,1,3533\n800,1,3247\n", "line 1: an extinction coefficient k of 3533"),
            ("300,1,3533\n800,1,3247\n", "if those are the decimal marks, use semicolons"),
            ("300,1.35,0.2\n800,1.3,0.2\n", "an extinction coefficient k of 0.2 is too large for a clear film"),
            (
                "wl,n\n0.3,1.35\n0.8,1.25\n\nwl,n\n0.3,1.3\n0.8,1.2\n",
                "line 5: a second block begins here, under `wl,n`",
            ),
            ("300.5;1,353\n800;1,353\n", "line 1: `1,353` is not a finite number; decimal marks are either"),
            ("300,1.353\n400;1.3\n800,1.35\n", "line 2: `400;1.3` is not a finite number; separate the columns"),
            ("300,1.353\n400 nm,1.3\n800,1.35\n", "line 2: `400 nm` is not a finite number"),
            ("300,1.353\nend,1.3\n800,1.35\n", "line 2: `end` is not a finite number; words belong"),
            ("300,1.353\n400,\n800,1.35\n", "line 2: 1 column(s) instead of 2"),
            ("0.4,1.35\n0.7,1.35\n", "covers 400 to 700 nm, but must cover 380 to 780 nm; add the missing end"),
            ("1.6,1.35\n3.2,1.35\n", "write wavelengths in nanometres or micrometres"),
        ] {
            let message = index(text).expect_err(text);
            assert!(message.starts_with("n.csv") && message.contains(told), "{message}");
        }
    }

    #[test]
    fn lamps_have_one_column_in_one_block() {
        for text in ["360,0,25\n780,0,5\n", "360,1\n780,1\nnm,k\n360,1\n780,1\n"] {
            let error = Spectrum::from_csv("lamp.csv", text, &mut Vec::new()).expect_err(text);
            assert!(matches!(error, SpectrumError::Columns { .. } | SpectrumError::SecondBlock { .. }), "{error}");
        }
    }
}
