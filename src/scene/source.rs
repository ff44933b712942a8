//! A scene's text and what was set over it, kept so that messages can say where a key stands.

use super::error::{Located, SceneError};
use super::syntax::parse_error;
use super::{Setting, setting};
use std::ops::Range;
use toml::Spanned;
use toml::de::DeTable;

/// Where a scene comes from: the text of a file or a preset, its name, and the settings that override keys of it.
#[derive(Clone, Debug)]
pub struct SceneSource {
    name: String,
    /// The text, then each setting on a line of its own: a byte of it tells text and settings apart.
    all: String,
    /// Where the text ends.
    text_bytes: usize,
    /// Where each setting stands.
    settings: Vec<Range<usize>>,
}

impl SceneSource {
    /// A text with settings over it. `name` stands for the text in messages: a path, or a preset's name.
    #[must_use]
    pub fn new(name: &str, text: &str, settings: &[Setting]) -> Self {
        let mut source =
            Self { name: name.to_owned(), all: text.to_owned(), text_bytes: text.len(), settings: Vec::new() };
        for setting in settings {
            source.all.push('\n');
            let start = source.all.len();
            source.all.push_str(setting.as_str());
            source.settings.push(start..source.all.len());
        }
        source
    }

    /// The text's tables and values with the settings in their places, each with the bytes where it stands.
    pub(super) fn parse(&self) -> Result<Spanned<DeTable<'_>>, Located> {
        let text = &self.all[..self.text_bytes];
        let mut document = DeTable::parse(text).map_err(|error| parse_error(text, 0, &error))?;
        for range in &self.settings {
            setting::apply(document.get_mut(), &self.all, range.clone())?;
        }
        Ok(document)
    }

    /// The text and the settings, which bytes of values count in.
    pub(super) fn all(&self) -> &str {
        &self.all
    }

    /// A problem with the line, or the setting, that it stands on.
    pub(super) fn place(&self, Located { offset, problem }: Located) -> SceneError {
        match self.settings.iter().find(|range| offset >= range.start && offset <= range.end) {
            Some(range) => SceneError::InSetting { setting: setting::shown(&self.all[range.clone()]), problem },
            None => {
                let before = self.all.as_bytes().iter().take(offset.min(self.text_bytes));
                let line = 1 + before.filter(|byte| **byte == b'\n').count();
                SceneError::InText { name: self.name.clone(), line, problem }
            }
        }
    }
}
