//! What can be wrong with a scene, in one line each.

use super::VERSION;
use super::check::{Fault, KeyPath};
use super::words::{nearest, shorten};

/// Why a scene cannot be used. The message is one line: where, what, and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// The scene was read from a text.
    #[error("{name}:{line}: {problem}")]
    InText {
        /// The name that [`super::Scene::from_toml`] was given.
        name: String,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong there.
        problem: Problem,
    },
    /// The value was given over the scene's text.
    #[error("--set {setting}: {problem}")]
    InSetting {
        /// The setting, `key=value`.
        setting: String,
        /// What is wrong with it.
        problem: Problem,
    },
    /// The scene was made in memory.
    #[error("{0}")]
    InMemory(Problem),
}

/// What is wrong with a scene. A `key` names its table too, as in `` `radius_mm` in [[bubble]] ``.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Problem {
    /// The text is not TOML, or a key or table stands there twice.
    #[error("{0}")]
    Syntax(String),
    /// There is no key `version`.
    #[error("no version; add `version = {VERSION}` at the top")]
    MissingVersion,
    /// The version is another one than [`VERSION`].
    #[error("version {0} is not supported; this program reads `version = {VERSION}`")]
    UnknownVersion(String),
    /// There is no such key in this table.
    #[error("unknown key {key}; {hint}")]
    UnknownKey {
        /// The key.
        key: String,
        /// The nearest known key, or all of them where none is near.
        hint: String,
    },
    /// The value has the wrong type, or lies out of its range.
    #[error("{key} {reason}")]
    BadValue {
        /// The key.
        key: String,
        /// What is wrong with the value, and what is allowed.
        reason: String,
    },
}

impl From<Fault> for Problem {
    fn from(fault: Fault) -> Self {
        Self::BadValue { key: fault.path.to_string(), reason: shorten(&fault.reason, LONGEST_REASON).into_owned() }
    }
}

/// Characters of a reason that messages show. The longest of the program's own words have half as many; the rest is what a file holds.
const LONGEST_REASON: usize = 600;

/// A problem and the byte of a source's text where it stands.
#[derive(Debug)]
pub(super) struct Located {
    pub offset: usize,
    pub problem: Problem,
}

impl Located {
    pub fn bad_value(offset: usize, path: &KeyPath, reason: String) -> Self {
        Self { offset, problem: Fault { path: path.clone(), reason }.into() }
    }

    pub fn unknown_key<'a>(offset: usize, path: &KeyPath, key: &str, known: impl Iterator<Item = &'a String>) -> Self {
        Self { offset, problem: Problem::UnknownKey { key: path.to_string(), hint: hint(key, known) } }
    }
}

/// Names the known key nearest to `key`. Jaro-Winkler favours a common beginning, which suits forgotten units (`radius` for `radius_mm`).
fn hint<'a>(key: &str, known: impl Iterator<Item = &'a String>) -> String {
    let known: Vec<&str> = known.map(String::as_str).collect();
    match nearest(key, &known) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("known here: {}", known.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")),
    }
}
