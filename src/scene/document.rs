//! From TOML text to a scene, keeping track of where each key stands.

use super::check::{Checked, Fault, KeyPath, Step};
use super::error::{Located, Problem, SceneError};
use super::syntax::{every_key, shorten_line};
use super::{Scene, SceneSource, VERSION};
use serde::de::DeserializeOwned;
use toml::de::{DeTable, DeValue, Deserializer, Error};
use toml::{Spanned, Table, Value};

impl SceneSource {
    /// Reads the scene.
    ///
    /// # Errors
    ///
    /// As [`Scene::from_toml`]; a setting at fault is named in place of a line.
    pub fn read(&self) -> Result<Scene, SceneError> {
        read(self).map_err(|located| self.place(located))
    }

    /// What is wrong with a value, with the line that its key stands on, or the setting that it comes from. Where the text leaves the key
    /// out, it is the line of the innermost table on the way there, or the first line.
    #[must_use]
    pub fn locate(&self, fault: Fault) -> SceneError {
        self.place(locate(self, fault))
    }
}

/// Reads and checks a scene.
fn read(source: &SceneSource) -> Result<Scene, Located> {
    read_as(source, &every_key(), Scene::check)
}

/// Reads and checks a document of some kind. `known` is its table with every key that it can have.
pub(super) fn read_as<T: DeserializeOwned>(
    source: &SceneSource,
    known: &Table,
    check: impl Fn(&T) -> Checked,
) -> Result<T, Located> {
    let document = source.parse()?;
    check_version(document.get_ref(), source.all())?;
    check_keys(document.get_ref(), known)?;
    let value = T::deserialize(Deserializer::from(document)).map_err(|error| type_error(source, &error))?;
    check(&value).map_err(|fault| locate(source, fault))?;
    Ok(value)
}

/// Where the key of a fault stands in a source.
fn locate(source: &SceneSource, fault: Fault) -> Located {
    let document = source.parse().ok();
    let offset = document.and_then(|document| offset_of(document.get_ref(), fault.path.steps()));
    Located { offset: offset.unwrap_or(0), problem: fault.into() }
}

/// Comes before all other checks: a later version may have other keys.
fn check_version(document: &DeTable, text: &str) -> Result<(), Located> {
    let Some(version) = document.get("version") else {
        return Err(Located { offset: 0, problem: Problem::MissingVersion });
    };
    let found = text.get(version.span()).unwrap_or_default();
    if found == VERSION.to_string() {
        return Ok(());
    }
    Err(Located { offset: version.span().start, problem: Problem::UnknownVersion(shorten_line(found)) })
}

/// Refuses the first key of the text that is not known, and lists and tables taken for one another.
fn check_keys(document: &DeTable, known: &Table) -> Result<(), Located> {
    let mut strays = Vec::new();
    find_strays(document, known, &KeyPath::default(), &mut strays);
    strays.into_iter().min_by_key(|stray| stray.offset).map_or(Ok(()), Err)
}

fn find_strays(table: &DeTable, known: &Table, path: &KeyPath, strays: &mut Vec<Located>) {
    for (key, value) in table {
        let (offset, name) = (key.span().start, key.get_ref());
        let path = path.key(name);
        match (value.get_ref(), known.get(name.as_ref())) {
            (_, None) => strays.push(Located::unknown_key(offset, &path, name, known.keys())),
            (DeValue::Table(table), Some(Value::Table(known))) => find_strays(table, known, &path, strays),
            (DeValue::Array(items), Some(Value::Array(known))) if known.iter().any(Value::is_table) => {
                find_strays_in_items(items, known, &path, strays);
            }
            (DeValue::Array(items), Some(Value::Array(known))) if known.iter().any(Value::is_float) => {
                strays.extend(check_count(items, known, offset, &path));
            }
            (DeValue::Table(_), Some(Value::Array(known))) if known.iter().any(Value::is_table) => {
                strays.push(shape_error(offset, &path, format!("[[{name}]]")))
            }
            (DeValue::Array(_), Some(Value::Table(_))) => strays.push(shape_error(offset, &path, format!("[{name}]"))),
            _ => {}
        }
    }
}

fn find_strays_in_items(items: &[Spanned<DeValue>], known: &[Value], path: &KeyPath, strays: &mut Vec<Located>) {
    for (index, item) in items.iter().enumerate() {
        match item.get_ref() {
            DeValue::Table(table) => {
                if let Some(known) = known_item(table, known) {
                    find_strays(table, known, &path.item(index), strays);
                }
            }
            // A list would be taken for a table's values in the order of the code.
            other => {
                let reason = format!("must be a table, but is a value of the type {}", other.type_str());
                strays.push(Located::bad_value(item.span().start, &path.item(index), reason));
            }
        }
    }
}

/// Lists of numbers have a certain length. Parsers would drop what is too much.
fn check_count(items: &[Spanned<DeValue>], known: &[Value], offset: usize, path: &KeyPath) -> Option<Located> {
    let (found, expected) = (items.len(), known.len());
    let reason = || format!("is a list of {found}; it must hold {expected} numbers");
    (found != expected).then(|| Located::bad_value(offset, path, reason()))
}

/// The known item of a list that an item must be like: the one of its kind, where items have kinds. `None` if there is no such kind, which
/// is another error.
fn known_item<'a>(table: &DeTable, known: &'a [Value]) -> Option<&'a Table> {
    let kind = table.get("kind").and_then(|kind| kind.get_ref().as_str());
    let mut known = known.iter().filter_map(Value::as_table);
    known.find(|item| item.get("kind").is_none_or(|known| known.as_str() == kind))
}

fn shape_error(offset: usize, path: &KeyPath, header: String) -> Located {
    Located::bad_value(offset, path, format!("has the wrong kind of table; write {header}"))
}

fn type_error(source: &SceneSource, error: &Error) -> Located {
    let offset = error.span().unwrap_or_default().start;
    let document = source.parse().ok();
    let path = document.and_then(|document| key_at(document.get_ref(), offset, &KeyPath::default()));
    let reason = format!("is wrong: {}", plain_words(error.message()));
    Located::bad_value(offset, &path.unwrap_or_default(), reason)
}

/// Says in the words of a scene's author what serde says in Rust's.
fn plain_words(message: &str) -> String {
    const WORDS: [(&str, &str); 9] = [
        ("expected f64", "expected a number"),
        ("expected u64", "expected a whole number, 0 or more"),
        ("expected u32", "expected a whole number, 0 or more"),
        ("wanted string or table", "expected a word in quotes"),
        ("expected a sequence", "expected a list"),
        ("expected struct", "expected the table"),
        ("an array of length 3", "a list of three numbers"),
        ("unknown variant", "unknown word"),
        ("type: map", "type: table"),
    ];
    WORDS.iter().fold(shorten_line(message), |message, (rust, plain)| message.replace(rust, plain))
}

/// Where a key stands, or the innermost table on the way to it if the text leaves it out.
fn offset_of(table: &DeTable, path: &[Step]) -> Option<usize> {
    let (Step::Key(name), rest) = path.split_first()? else {
        return None;
    };
    let (key, value) = table.get_key_value(name.as_str())?;
    offset_below(value, rest).or(Some(key.span().start))
}

fn offset_below(value: &Spanned<DeValue>, path: &[Step]) -> Option<usize> {
    match (value.get_ref(), path) {
        (DeValue::Table(table), _) => offset_of(table, path),
        (DeValue::Array(items), [Step::Item(index), rest @ ..]) => {
            let item = items.get(*index)?;
            offset_below(item, rest).or(Some(item.span().start))
        }
        _ => None,
    }
}

/// The key whose value covers a byte of the text. Spans of tables end with their headers, so the search goes through all of them.
fn key_at(table: &DeTable, offset: usize, path: &KeyPath) -> Option<KeyPath> {
    table.iter().find_map(|(key, value)| value_at(value, offset, &path.key(key.get_ref())))
}

fn value_at(value: &Spanned<DeValue>, offset: usize, path: &KeyPath) -> Option<KeyPath> {
    let inner = match value.get_ref() {
        DeValue::Table(table) => key_at(table, offset, path),
        DeValue::Array(items) => {
            let tables = items.iter().enumerate().filter(|(_, item)| matches!(item.get_ref(), DeValue::Table(_)));
            tables.into_iter().find_map(|(index, item)| value_at(item, offset, &path.item(index)))
        }
        _ => None,
    };
    // An empty word of a setting covers no byte.
    let is_there = value.span().start == offset || value.span().contains(&offset);
    inner.or_else(|| is_there.then(|| path.clone()))
}
