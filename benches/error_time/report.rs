//! Tables of measurements.

/// A table on the terminal and in a CSV file.
pub struct Report {
    name: &'static str,
    csv: String,
}

impl Report {
    /// An empty table; its heading goes to the terminal.
    pub fn new(name: &'static str, columns: &[&str]) -> Self {
        println!("\n{name}\n{}", columns.iter().map(|column| format!("{column:>16}")).collect::<String>());
        Self { name, csv: columns.join(",") + "\n" }
    }

    /// Adds a row, of numbers in the order of the columns.
    pub fn row(&mut self, numbers: &[f64]) {
        let shown =
            |number: &f64| if number.fract() == 0.0 { format!("{number:>16}") } else { format!("{number:>16.5}") };
        println!("{}", numbers.iter().map(shown).collect::<String>());
        self.csv += &(numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n");
    }

    /// Writes the CSV file.
    pub fn save(&self) -> anyhow::Result<()> {
        let path = format!("{}/error_time_{}.csv", env!("CARGO_TARGET_TMPDIR"), self.name);
        std::fs::write(&path, &self.csv)?;
        println!("written to {path}");
        Ok(())
    }
}
