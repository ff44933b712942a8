//! Checks of single values, and the path of the key that fails one.

use super::words::shorten;
use std::fmt::{self, Display};
use std::ops::RangeInclusive;

/// The outcome of a check.
pub(super) type Checked = Result<(), Fault>;

/// A value of a scene that cannot be used, with the way to its key. [`super::SceneSource::locate`] finds the line that the key stands on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path} {reason}")]
pub struct Fault {
    pub(super) path: KeyPath,
    pub(super) reason: String,
}

impl Fault {
    /// A fault of a key in its table. The reason goes on after the key's name, as in "is 3; it must be …".
    #[must_use]
    pub fn new(key: &str, reason: impl Into<String>) -> Self {
        Self { path: KeyPath::default().key(key), reason: reason.into() }
    }

    /// A key that names something which cannot be used: a file that cannot be read, a lamp that is unknown.
    #[must_use]
    pub fn unusable(key: &str, error: impl Display) -> Self {
        Self::new(key, format!("cannot be used: {error}"))
    }

    /// This fault seen from the table that holds `key`.
    #[must_use]
    pub fn inside(self, key: &str) -> Self {
        self.below(KeyPath::default().key(key))
    }

    /// This fault seen from the table that holds the list `key`.
    #[must_use]
    pub fn inside_item(self, key: &str, index: usize) -> Self {
        self.below(KeyPath::default().key(key).item(index))
    }

    fn below(mut self, mut parent: KeyPath) -> Self {
        parent.0.append(&mut self.path.0);
        Self { path: parent, ..self }
    }
}

pub(super) fn in_range<T: PartialOrd + Display>(key: &str, value: T, range: RangeInclusive<T>) -> Checked {
    if range.contains(&value) {
        return Ok(());
    }
    Err(Fault::new(key, format!("is {value}; it must be within {} ..= {}", range.start(), range.end())))
}

pub(super) fn all_in_range(key: &str, values: &[f64], range: RangeInclusive<f64>) -> Checked {
    values.iter().try_for_each(|value| {
        in_range(key, *value, range.clone())
            .map_err(|fault| Fault { reason: format!("holds a number that {}", fault.reason), ..fault })
    })
}

pub(super) fn finite(key: &str, value: f64) -> Checked {
    if value.is_finite() { Ok(()) } else { Err(Fault::new(key, format!("is {value}; it must be a finite number"))) }
}

/// A name or a path. A path of Windows between double quotes is full of escapes, some of which are valid: `"C:\temp"` holds a tab.
pub(super) fn plain_text(key: &str, text: &str) -> Checked {
    match text.chars().find(|character| character.is_control()) {
        Some(character) => Err(Fault::new(key, format!("holds the control character {character:?}; {BACKSLASHES}"))),
        None => Ok(()),
    }
}

/// What to do about backslashes that TOML takes for escapes.
pub(super) const BACKSLASHES: &str =
    "a backslash in \"…\" begins an escape: write a path as '…', or with / for each \\";

pub(super) fn at_most(key: &str, count: usize, limit: usize) -> Checked {
    if count <= limit {
        Ok(())
    } else {
        Err(Fault::new(key, format!("is a list of {count}; at most {limit} are allowed")))
    }
}

pub(super) fn each<T>(key: &str, items: &[T], check: impl Fn(&T) -> Checked) -> Checked {
    let mut numbered = items.iter().enumerate();
    numbered.try_for_each(|(index, item)| check(item).map_err(|fault| fault.inside_item(key, index)))
}

/// The way from the top of a scene to one of its keys.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct KeyPath(Vec<Step>);

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    Key(String),
    Item(usize),
}

impl KeyPath {
    pub fn key(&self, key: &str) -> Self {
        self.then(Step::Key(key.to_owned()))
    }

    pub fn item(&self, index: usize) -> Self {
        self.then(Step::Item(index))
    }

    pub fn steps(&self) -> &[Step] {
        &self.0
    }

    fn then(&self, step: Step) -> Self {
        Self(self.0.iter().cloned().chain([step]).collect())
    }
}

/// `` `thickness_nm` in [bubble.film] `` or `` `radius_mm` in [[bubble]] number 2 ``, as the reader would look for it in a file.
impl Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let table = match self.0.split_last() {
            None => return write!(f, "the scene"),
            Some((Step::Item(_), _)) => &self.0[..],
            Some((Step::Key(key), table)) => {
                let joint = if table.is_empty() { "" } else { " in " };
                write!(f, "`{}`{joint}", shorten(key, LONGEST_KEY).escape_debug())?;
                table
            }
        };
        fmt_table(table, f)
    }
}

/// Characters of a name or a path that messages show.
pub(super) const LONGEST_NAME: usize = 200;

/// Characters of a key that messages show: more than any known key has.
const LONGEST_KEY: usize = 60;

/// `[camera]`, `[[bubble]]`, and `[[bubble]] number 2` where there are others before it.
fn fmt_table(table: &[Step], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let names: Vec<_> = table.iter().filter_map(Step::name).map(|name| shorten(name, LONGEST_KEY)).collect();
    let names = names.join(".");
    match table.last() {
        None => return Ok(()),
        Some(Step::Item(_)) => write!(f, "[[{names}]]")?,
        Some(Step::Key(_)) => write!(f, "[{names}]")?,
    }
    let later = table.iter().find_map(Step::index).filter(|index| *index > 0);
    later.map_or(Ok(()), |index| write!(f, " number {}", index + 1))
}

impl Step {
    fn name(&self) -> Option<&str> {
        match self {
            Self::Key(key) => Some(key),
            Self::Item(_) => None,
        }
    }

    fn index(&self) -> Option<usize> {
        match self {
            Self::Key(_) => None,
            Self::Item(index) => Some(*index),
        }
    }
}
