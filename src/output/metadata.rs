//! The metadata of a picture.

use super::FrameRate;

/// Keys and values that are stored in a picture's header, in this order: the scene, the time, the versions that made it. A frame of a
/// sequence also has its rate and its number.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Metadata {
    entries: Vec<(String, String)>,
    frame: Option<(FrameRate, u64)>,
}

impl Metadata {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// What every picture of a scene says: the program, the scene's name, and the time in seconds.
    pub fn of_scene(name: &str, time_s: f64) -> Self {
        Self::new()
            .with("Software", &format!("soapfilm {}", env!("CARGO_PKG_VERSION")))
            .with("Scene", name)
            .with("Time", &format!("{time_s} s"))
    }

    /// This and one entry more. Characters that would break the entry are replaced by spaces: line ends and other control
    /// characters, and in keys all that is not ASCII. Keys longer than 79 characters, the maximum in PNG, are cut; an
    /// empty key becomes `Comment`.
    pub fn with(mut self, key: &str, value: &str) -> Self {
        self.entries.push((clean_key(key), clean_value(value)));
        self
    }

    /// This, of that frame of a sequence.
    pub fn of_frame(self, rate: FrameRate, number: u64) -> Self {
        Self { frame: Some((rate, number)), ..self }
    }

    /// Rate and number of a frame of a sequence.
    pub fn frame(&self) -> Option<(FrameRate, u64)> {
        self.frame
    }

    /// All entries in order.
    pub fn entries(&self) -> impl Iterator<Item = (&str, &str)> {
        self.entries.iter().map(|(key, value)| (key.as_str(), value.as_str()))
    }

    /// The first value of `key`.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.entries().find_map(|(known, value)| (known == key).then_some(value))
    }

    /// One line `key: value` for each entry.
    pub fn to_lines(&self) -> String {
        self.entries().map(|(key, value)| format!("{key}: {value}\n")).collect()
    }

    /// The inverse of [`Self::to_lines`]; lines without a key are left out.
    pub(super) fn from_lines(lines: &str) -> Self {
        let pairs = lines.lines().filter_map(|line| line.split_once(": "));
        pairs.fold(Self::new(), |metadata, (key, value)| metadata.with(key, value))
    }
}

fn clean_key(key: &str) -> String {
    // A colon ends the key where entries are stored as lines; PNG allows no spaces at the ends and no two in a row.
    let readable = |character: char| {
        if character.is_ascii_graphic() && character != ':' { character } else { ' ' }
    };
    let spaced: String = key.chars().map(readable).collect();
    let mut cleaned = spaced.split_whitespace().collect::<Vec<_>>().join(" ");
    cleaned.truncate(79);
    if cleaned.is_empty() { "Comment".to_owned() } else { cleaned.trim_end().to_owned() }
}

fn clean_value(value: &str) -> String {
    value.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_keep_their_order_and_survive_as_lines() {
        let metadata = Metadata::new().with("Scene", "seife: µ").with("Time", "0.5 s").with("Empty", "");
        assert_eq!(metadata.entries().map(|(key, _)| key).collect::<Vec<_>>(), ["Scene", "Time", "Empty"]);
        assert_eq!(metadata.get("Scene"), Some("seife: µ"));
        assert_eq!(metadata.get("Place"), None);
        assert_eq!(Metadata::from_lines(&metadata.to_lines()), metadata);
    }

    #[test]
    fn characters_that_break_a_metadata_entry_are_replaced() {
        let metadata = Metadata::new().with(" a:\u{e9}\n b ", "two\nlines\0").with("", "x").with(&"k".repeat(200), "y");
        let entries: Vec<_> = metadata.entries().map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
        let expected = [("a b", "two lines "), ("Comment", "x"), (&"k".repeat(79), "y")];
        assert_eq!(entries, expected.map(|(key, value)| (key.to_owned(), value.to_owned())));
    }
}
