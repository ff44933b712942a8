//! Tables of numbers in text, as spreadsheets, instruments and data bases write them.
//!
//! Columns are separated by commas, semicolons, tabs or spaces, whatever most lines have. Numbers may have decimal commas where no other
//! number of the table has a decimal point. Fields may stand in quotes. Empty lines, and lines that start with `#`, `%` or `!`, are
//! skipped. A line without any number is a heading, and begins a block of its own.

/// A table, as blocks of lines under one heading each.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The blocks that have rows; or, if none has, the last heading; or nothing.
    pub blocks: Vec<Block>,
    /// What its columns are separated by.
    pub separator: Separator,
}

/// Rows under one heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Line of the heading, from 1; the line of the first row if there is none.
    pub line: usize,
    /// Names of the columns, if there is a heading.
    pub heading: Vec<String>,
    /// The rows in the order of the text.
    pub rows: Vec<Row>,
}

/// The fields of one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Line in the text, from 1.
    pub line: usize,
    /// Fields without the spaces and quotes around them; numbers have decimal points.
    pub fields: Vec<String>,
}

/// What columns are separated by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
    /// Any number of spaces and tabs.
    Spaces,
}

impl Table {
    /// Reads a table. Whatever the text is, it has some separator and some rows; what is not a number stays as text.
    pub fn parse(text: &str) -> Self {
        let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
        let skipped = |line: &str| line.is_empty() || line.starts_with(['#', '%', '!']);
        let mut lines: Vec<(usize, &str)> = (1..).zip(text.lines()).filter(|(_, line)| !skipped(line.trim())).collect();
        let told = lines.first().and_then(|(_, line)| told_separator(line));
        if told.is_some() {
            lines.remove(0);
        }
        let separator = told.unwrap_or_else(|| Separator::of(&lines));
        let rows = lines.into_iter().map(|(line, content)| Row { line, fields: separator.split(content) });
        let mut rows: Vec<Row> = rows.filter(|row| row.fields.iter().any(|field| !field.is_empty())).collect();
        use_decimal_points(&mut rows);
        Self { blocks: blocks(rows), separator }
    }
}

impl Separator {
    /// The likeliest reason for other columns than were meant.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Comma => "columns are separated by commas here: if those are the decimal marks, use semicolons",
            Self::Semicolon => "columns are separated by semicolons here",
            Self::Tab => "columns are separated by tabs here",
            Self::Spaces => "columns are separated by spaces here",
        }
    }

    /// The separator of most lines that begin with a number; of most lines, if none does.
    fn of(lines: &[(usize, &str)]) -> Self {
        let starts_with_number = |line: &&str| {
            line.trim_start_matches([' ', '\t', '"'])
                .starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
        };
        let mut rows: Vec<&str> =
            lines.iter().map(|(_, line)| line.trim_matches(' ')).filter(starts_with_number).collect();
        if rows.is_empty() {
            rows = lines.iter().map(|(_, line)| line.trim_matches(' ')).collect();
        }
        let most = |test: &dyn Fn(&str) -> bool| 2 * rows.iter().filter(|row| test(row)).count() > rows.len();
        if most(&|row| row.contains('\t')) {
            Self::Tab
        } else if most(&|row| row.contains(';')) {
            Self::Semicolon
        } else if most(&|row| row.contains(',')) && !most(&|row| has_decimal_commas_and_spaces(row)) {
            Self::Comma
        } else if most(&|row| row.contains(' ')) {
            Self::Spaces
        } else {
            Self::Comma
        }
    }

    fn split(self, line: &str) -> Vec<String> {
        let mut quoted = false;
        // Tabs at the ends stand beside empty fields.
        let fields = line.trim_matches(' ').split(|character: char| {
            quoted ^= character == '"';
            !quoted && self.is(character)
        });
        let fields = fields.map(|field| field.trim().trim_matches('"').trim().replace("\"\"", "\""));
        fields.filter(|field| self != Self::Spaces || !field.is_empty()).collect()
    }

    fn is(self, character: char) -> bool {
        match self {
            Self::Comma => character == ',',
            Self::Semicolon => character == ';',
            Self::Tab => character == '\t',
            Self::Spaces => character.is_whitespace(),
        }
    }
}

/// The separator that a spreadsheet tells in a first line like `sep=;`.
fn told_separator(line: &str) -> Option<Separator> {
    match line.trim_end_matches(['\r', '\n']).to_ascii_lowercase().strip_prefix("sep=")? {
        "," => Some(Separator::Comma),
        ";" => Some(Separator::Semicolon),
        "\t" => Some(Separator::Tab),
        _ => None,
    }
}

/// Whether a line is like `300 1,3533`, where the comma is no separator.
fn has_decimal_commas_and_spaces(row: &str) -> bool {
    let fields = Separator::Spaces.split(row);
    fields.len() > 1 && fields.iter().all(|field| is_number(field)) && !row.contains('.')
}

/// Whether a field is a number, with a decimal point or a decimal comma.
fn is_number(field: &str) -> bool {
    field.parse::<f64>().is_ok() || with_point(field).is_some()
}

/// A number that has a decimal comma between digits, with a point in its place.
fn with_point(field: &str) -> Option<String> {
    let (whole, fraction) = field.split_once(',')?;
    let between_digits =
        whole.ends_with(|c: char| c.is_ascii_digit()) && fraction.starts_with(|c: char| c.is_ascii_digit());
    let number = format!("{whole}.{fraction}");
    (between_digits && number.parse::<f64>().is_ok()).then_some(number)
}

/// Writes points for decimal commas, unless any number has a point: then a comma is something else.
fn use_decimal_points(rows: &mut [Row]) {
    let mut fields = rows.iter().flat_map(|row| &row.fields);
    if fields.any(|field| field.contains('.') && field.parse::<f64>().is_ok()) {
        return;
    }
    for field in rows.iter_mut().flat_map(|row| &mut row.fields) {
        if let Some(number) = with_point(field) {
            *field = number;
        }
    }
}

/// A heading has words and no number; `nan` and `inf` are numbers to the parser.
fn is_heading(row: &Row) -> bool {
    row.fields.iter().any(|field| field.contains(char::is_alphabetic))
        && !row.fields.iter().any(|field| is_number(field))
}

fn blocks(rows: Vec<Row>) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    for row in rows {
        if is_heading(&row) {
            blocks.push(Block { line: row.line, heading: row.fields, rows: Vec::new() });
        } else if let Some(block) = blocks.last_mut() {
            block.rows.push(row);
        } else {
            blocks.push(Block { line: row.line, heading: Vec::new(), rows: vec![row] });
        }
    }
    if blocks.iter().any(|block| !block.rows.is_empty()) {
        blocks.retain(|block| !block.rows.is_empty());
    } else {
        blocks = blocks.pop().into_iter().collect();
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The fields of the only block's rows.
    fn rows(text: &str) -> Vec<Vec<String>> {
        let mut table = Table::parse(text);
        assert_eq!(table.blocks.len(), 1, "{text}");
        table.blocks.remove(0).rows.into_iter().map(|row| row.fields).collect()
    }

    #[test]
    fn one_table_in_many_hands_is_one_table() {
        for text in [
            "nm,n\n300,1.3533\n800,1.25\n",
            "nm;n\n300;1,3533\n800;1,25\n",
            "nm;n\r\n300;1.3533\r\n800;1.25\r\n",
            "sep=;\nnm;n\n300;1,3533\n800;1,25\n",
            "\u{feff}nm\tn\n300\t1,3533\n800\t1,25\n",
            "nm n\n300 1.3533\n800 1.25\n",
            "  300   1,3533\n  800   1,25\n",
            "nm, n\n300 , 1.3533\n800 , 1.25\n",
            "\"nm\",\"n\"\n\"300\",\"1,3533\"\n\"800\",\"1,25\"\n",
            "# from a book\n\n% and\n! more\n300,1.3533\n\n# and on\n800,1.25",
            "nm,n\r300,1.3533\r800,1.25\r",
            "title\nnm,n\nnm,1/1\n300,1.3533\n800,1.25\n,\n",
        ] {
            assert_eq!(rows(text), [["300", "1.3533"], ["800", "1.25"]], "{text:?}");
        }
    }

    #[test]
    fn lines_are_counted_from_one_with_all_that_is_skipped() {
        let table = Table::parse("\u{feff}# comment\r\nnm;n\r\n\r\n300;1\r\n\r\nnm;k\r\n300;0\r\n");
        let lines = |block: &Block| (block.line, block.rows[0].line);
        assert_eq!(table.blocks.iter().map(lines).collect::<Vec<_>>(), [(2, 4), (6, 7)]);
        assert_eq!(table.blocks[1].heading, ["nm", "k"]);
        assert_eq!(table.separator, Separator::Semicolon);
    }

    #[test]
    fn commas_beside_points_are_left_alone() {
        assert_eq!(rows("300.5;1,353\n"), [["300.5", "1,353"]]);
        assert_eq!(rows("300;1,353,5\n"), [["300", "1,353,5"]]);
        assert_eq!(rows("300,1,3533\n"), [["300", "1", "3533"]], "nobody can tell");
    }

    #[test]
    fn empty_fields_stay_where_they_stand() {
        assert_eq!(rows("a,b,c\n1,,\n1,2,\"x, \"\"y\"\"\"\n"), [vec!["1", "", ""], vec!["1", "2", "x, \"y"]]);
        assert_eq!(rows("a\tb\tc\n1\t\t\n"), [["1", "", ""]]);
        assert_eq!(Table::parse("a,b\n").blocks[0].heading, ["a", "b"]);
        assert_eq!(Table::parse("").blocks, []);
    }

    #[test]
    fn a_line_without_any_number_is_a_heading_and_nan_is_a_number() {
        for (text, rows) in [("nan,1\n", 1), ("inf\n", 1), ("foo,1\n", 1), ("foo,bar\n", 0), ("380,5;1,5e-3\n", 1)] {
            assert_eq!(Table::parse(text).blocks[0].rows.len(), rows, "{text}");
        }
    }
}
