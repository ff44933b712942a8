//! Tables of numbers as CSV.

use std::io::{self, Write};

/// Writes a table row by row: comma-separated, a header of column names, numbers in the shortest form that reads back to the
/// same bits.
#[derive(Debug)]
pub struct CsvWriter<W> {
    writer: W,
    columns: usize,
}

impl<W: Write> CsvWriter<W> {
    /// Begins a table with its header. Names with commas, quotes or line ends are quoted (RFC 4180).
    ///
    /// # Errors
    /// The writer's.
    pub fn new(mut writer: W, columns: &[impl AsRef<str>]) -> io::Result<Self> {
        let names: Vec<_> = columns.iter().map(|name| quoted(name.as_ref())).collect();
        writeln!(writer, "{}", names.join(","))?;
        Ok(Self { writer, columns: columns.len() })
    }

    /// Writes one row. NaN and infinities are written `NaN`, `inf` and `-inf`.
    ///
    /// # Errors
    /// The writer's, and a row whose number of values differs from the number of columns.
    pub fn row(&mut self, values: &[f64]) -> io::Result<()> {
        if values.len() != self.columns {
            let reason = format!("a row of {} values for a table of {} columns", values.len(), self.columns);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        }
        for (i, value) in values.iter().enumerate() {
            let separator = if i == 0 { "" } else { "," };
            write!(self.writer, "{separator}{value}")?;
        }
        writeln!(self.writer)
    }
}

fn quoted(name: &str) -> String {
    let special = name.contains([',', '"', '\n', '\r']);
    if special { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(columns: &[&str], rows: &[&[f64]]) -> io::Result<String> {
        let mut bytes = Vec::new();
        let mut csv = CsvWriter::new(&mut bytes, columns)?;
        rows.iter().try_for_each(|row| csv.row(row))?;
        Ok(String::from_utf8(bytes).unwrap())
    }

    #[test]
    fn has_a_header_and_plain_numbers() {
        let text = table(&["x", "y"], &[&[1.0, -0.25], &[f64::NAN, f64::INFINITY]]).unwrap();
        assert_eq!(text, "x,y\n1,-0.25\nNaN,inf\n");
    }

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let values = [0.1, 1.0 / 3.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, -0.0, 123_456_789.123_456_78];
        let text = table(&["a"; 7], &[&values]).unwrap();
        let read: Vec<f64> = text.lines().nth(1).unwrap().split(',').map(|number| number.parse().unwrap()).collect();
        assert_eq!(read.len(), values.len());
        assert!(read.iter().zip(&values).all(|(read, value)| read.to_bits() == value.to_bits()), "{text}");
    }

    #[test]
    fn odd_names_are_quoted() {
        assert_eq!(table(&["a,b", "say \"c\""], &[]).unwrap(), "\"a,b\",\"say \"\"c\"\"\"\n");
    }

    #[test]
    fn rows_of_the_wrong_length_are_refused() {
        assert!(table(&["x", "y"], &[&[1.0]]).is_err());
    }
}
