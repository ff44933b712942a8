//! The page of the scene format, as tests read it.

/// A key as the page describes it.
#[allow(dead_code, reason = "each test reads its own columns")]
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its table: `bubble.film`, or `kind = "stir"` for a kind of event.
    pub section: &'static str,
    pub key: &'static str,
    /// As TOML, or `absent`.
    pub default: &'static str,
    /// `0 ..= 1`, words in quotes, or a kind of value: `finite`, `whole`, `a name`.
    pub range: &'static str,
    pub meaning: &'static str,
}

/// All keys of the page.
pub fn documented() -> Vec<Row> {
    let mut section = "";
    let mut rows = Vec::new();
    for line in include_str!("../../assets/scenes/README.md").lines() {
        if let Some(header) = line.strip_prefix("## ") {
            section = section_of(header);
        }
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if let ["", key, default, range, meaning, ""] = cells[..]
            && key.starts_with('`')
        {
            rows.push(Row { section, key: key.trim_matches('`'), default: default.trim_matches('`'), range, meaning });
        }
    }
    rows
}

/// The section that a heading is about. Keys of a kind of event stand below the last thing named: `kind = "stir"`.
pub fn section_of(header: &str) -> &str {
    header.trim_matches('`').rsplit('`').next().unwrap_or_default().trim_matches(['[', ']'])
}
