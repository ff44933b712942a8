//! From TOML text to a scene, keeping track of where each key stands.

use super::check::{KeyPath, Step};
use super::error::{Located, Problem};
use super::{Bubble, Change, Event, Light, LightPatch, Scene, VERSION, View};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

/// Reads and checks a scene.
pub(super) fn read(text: &str) -> Result<Scene, Located> {
    let document = DeTable::parse(text).map_err(|error| syntax_error(text, &error))?;
    let document = document.get_ref();
    check_version(document, text)?;
    check_keys(document)?;
    let scene: Scene = toml::from_str(text).map_err(|error| type_error(document, &error))?;
    scene.check().map_err(|fault| Located {
        offset: offset_of(document, fault.path.steps()).unwrap_or(0),
        problem: fault.into(),
    })?;
    Ok(scene)
}

fn syntax_error(text: &str, error: &toml::de::Error) -> Located {
    let span = error.span().unwrap_or_default();
    let found = text.get(span.clone()).and_then(|found| found.lines().next()).filter(|found| !found.is_empty());
    let found = found.map_or(String::new(), |found| format!(": `{found}`"));
    Located { offset: span.start, problem: Problem::Syntax(format!("{}{found}", one_line(error.message()))) }
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
    Err(Located { offset: version.span().start, problem: Problem::UnknownVersion(one_line(found)) })
}

/// Every key a scene can have, as the TOML of a scene where nothing is absent. A key forgotten here fails the round trip of random scenes.
pub(super) fn every_key() -> Table {
    let scene = Scene {
        bubbles: vec![Bubble::default()],
        light: Light {
            constant: Some([0.0; 3]),
            patches: vec![LightPatch { radiance: Some([0.0; 3]), ..LightPatch::default() }],
            ..Light::default()
        },
        view: View { polariser_deg: Some(0.0), ..View::default() },
        events: Change::every_key().map(|change| Event { tick: 0, change }).into(),
        ..Scene::default()
    };
    // Structs with named fields always make a table.
    Table::try_from(scene).expect("plain data is always TOML")
}

/// Refuses the first key of the text that no scene has, and lists and tables taken for one another.
fn check_keys(document: &DeTable) -> Result<(), Located> {
    let mut strays = Vec::new();
    find_strays(document, &every_key(), &KeyPath::default(), &mut strays);
    strays.into_iter().min_by_key(|stray| stray.offset).map_or(Ok(()), Err)
}

fn find_strays(table: &DeTable, known: &Table, path: &KeyPath, strays: &mut Vec<Located>) {
    for (key, value) in table {
        let (offset, name) = (key.span().start, key.get_ref());
        let path = path.key(name);
        match (value.get_ref(), known.get(name.as_ref())) {
            (_, None) => strays.push(Located::unknown_key(offset, &path, name, known.keys())),
            (DeValue::Table(table), Some(Value::Table(known))) => find_strays(table, known, &path, strays),
            (DeValue::Array(items), Some(Value::Array(known))) => find_strays_in_items(items, known, &path, strays),
            (DeValue::Table(_), Some(Value::Array(_))) => {
                strays.push(shape_error(offset, &path, format!("[[{name}]]")))
            }
            (DeValue::Array(_), Some(Value::Table(_))) => strays.push(shape_error(offset, &path, format!("[{name}]"))),
            _ => {}
        }
    }
}

fn find_strays_in_items(items: &[Spanned<DeValue>], known: &[Value], path: &KeyPath, strays: &mut Vec<Located>) {
    for (index, item) in items.iter().enumerate() {
        let DeValue::Table(table) = item.get_ref() else { continue };
        if let Some(known) = known_item(table, known) {
            find_strays(table, known, &path.item(index), strays);
        }
    }
}

/// The known item of a list that an item must be like: the one of its kind, where items have kinds. Nothing if there is no such kind, which
/// is another error.
fn known_item<'a>(table: &DeTable, known: &'a [Value]) -> Option<&'a Table> {
    let kind = table.get("kind").and_then(|kind| kind.get_ref().as_str());
    let mut known = known.iter().filter_map(Value::as_table);
    known.find(|item| item.get("kind").is_none_or(|known| known.as_str() == kind))
}

fn shape_error(offset: usize, path: &KeyPath, header: String) -> Located {
    let reason = format!("has the wrong kind of table; write {header}");
    Located { offset, problem: Problem::BadValue { key: path.to_string(), reason } }
}

fn type_error(document: &DeTable, error: &toml::de::Error) -> Located {
    let offset = error.span().unwrap_or_default().start;
    let path = key_at(document, offset, &KeyPath::default()).unwrap_or_default();
    let reason = format!("is wrong: {}", plain_words(error.message()));
    Located { offset, problem: Problem::BadValue { key: path.to_string(), reason } }
}

/// Says in the words of a scene's author what serde says in Rust's.
fn plain_words(message: &str) -> String {
    const WORDS: [(&str, &str); 9] = [
        ("expected f64", "expected a number"),
        ("expected u64", "expected a whole number from 0 on"),
        ("expected u32", "expected a whole number from 0 on"),
        ("wanted string or table", "expected a word in quotes"),
        ("expected a sequence", "expected a list"),
        ("expected struct", "expected the table"),
        ("an array of length 3", "three numbers"),
        ("unknown variant", "unknown word"),
        ("type: map", "type: table"),
    ];
    WORDS.iter().fold(one_line(message), |message, (rust, plain)| message.replace(rust, plain))
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
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
    inner.or_else(|| value.span().contains(&offset).then(|| path.clone()))
}
