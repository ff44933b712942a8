//! Settings: keys of a scene that are given beside its text, as `--set view.exposure_ev=2` on the command line.

use super::check::KeyPath;
use super::error::Located;
use super::syntax::{every_key, parse_error};
use super::words::shorten;
use std::{borrow::Cow, ops::Range, str::FromStr};
use toml::de::{DeArray, DeTable, DeValue, Error};
use toml::{Spanned, Table, Value};

/// A value for one key of a scene, `key=value`. The key is a path with items of lists by their numbers from 0, as in
/// `bubble.0.film.thickness_nm`; the value is TOML, or a word without quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting(String);

impl Setting {
    pub(super) fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let key = text.split_once('=').map(|(key, _)| key.trim());
        match key {
            Some(key) if key.split('.').all(|part| !part.is_empty()) => Ok(Self(text.to_owned())),
            _ => Err("write it as KEY=VALUE, as in view.exposure_ev=2 or bubble.0.radius_mm=30".to_owned()),
        }
    }
}

/// A setting as messages show it.
pub(super) fn shown(setting: &str) -> String {
    const LONGEST: usize = 100;
    shorten(setting, LONGEST).replace(char::is_control, "\u{fffd}")
}

/// Puts the setting that stands in a range of a source's text into the document.
pub(super) fn apply<'s>(document: &mut DeTable<'s>, all: &'s str, range: Range<usize>) -> Result<(), Located> {
    // `Setting::from_str` lets none without `=` through.
    let (keys, value) = all[range.clone()].split_once('=').unwrap_or((&all[range.clone()], ""));
    let start = range.end - value.trim_start().len();
    let value = parse(value.trim()).map_err(|error| parse_error(&all[..range.end], start, &error))?;
    let keys: Vec<&str> = keys.trim().split('.').collect();
    let place = Place { path: KeyPath::default(), span: range };
    place.put_in_table(document, Some(&every_key()), &keys, moved(value, start))
}

/// A value as TOML has it; a word or a path without quotes is a string.
fn parse(text: &str) -> Result<Spanned<DeValue<'_>>, Error> {
    DeValue::parse(text).or_else(|error| {
        if text.starts_with(['[', '{', '"', '\'']) {
            return Err(error);
        }
        Ok(Spanned::new(0..text.len(), DeValue::String(Cow::Borrowed(text))))
    })
}

/// A value whose bytes count from elsewhere.
fn moved(value: Spanned<DeValue<'_>>, by: usize) -> Spanned<DeValue<'_>> {
    let further = |span: Range<usize>| span.start + by..span.end + by;
    let span = further(value.span());
    let value = match value.into_inner() {
        DeValue::Array(items) => {
            let mut all = DeArray::new();
            items.into_iter().for_each(|item| all.push(moved(item, by)));
            DeValue::Array(all)
        }
        DeValue::Table(table) => {
            let entries = table.into_iter();
            let entries = entries.map(|(key, value)| {
                let span = further(key.span());
                (Spanned::new(span, key.into_inner()), moved(value, by))
            });
            DeValue::Table(entries.collect())
        }
        value => value,
    };
    Spanned::new(span, value)
}

/// How far a setting's key has been followed, and where the setting stands.
struct Place {
    path: KeyPath,
    span: Range<usize>,
}

impl Place {
    /// Puts a value below a table, by the rest of its key. `known` is the table with every key that it can have.
    fn put_in_table<'s>(
        mut self,
        table: &mut DeTable<'s>,
        known: Option<&Table>,
        keys: &[&'s str],
        value: Spanned<DeValue<'s>>,
    ) -> Result<(), Located> {
        let [key, rest @ ..] = keys else { return Ok(()) };
        self.path = self.path.key(key);
        let known = known.and_then(|known| known.get(*key));
        if rest.is_empty() {
            // Inserting alone would leave the old key, with its place in the text.
            table.remove(*key);
            table.insert(self.spanned(Cow::Borrowed(*key)), value);
            return Ok(());
        }
        if !table.contains_key(*key) {
            table.insert(self.spanned(Cow::Borrowed(*key)), self.spanned(self.left_out(known)));
        }
        // It was put there above if it was not there.
        let Some(inner) = table.get_mut(*key) else { return Ok(()) };
        self.put(inner, known, rest, value)
    }

    fn put<'s>(
        self,
        inside: &mut Spanned<DeValue<'s>>,
        known: Option<&Value>,
        keys: &[&'s str],
        value: Spanned<DeValue<'s>>,
    ) -> Result<(), Located> {
        match inside.get_mut() {
            DeValue::Table(table) => self.put_in_table(table, known.and_then(Value::as_table), keys, value),
            DeValue::Array(items) => self.put_in_list(items, known.and_then(Value::as_array), keys, value),
            _ => Err(self.refused("is one value and has no keys".to_owned())),
        }
    }

    fn put_in_list<'s>(
        mut self,
        items: &mut DeArray<'s>,
        known: Option<&Vec<Value>>,
        keys: &[&'s str],
        value: Spanned<DeValue<'s>>,
    ) -> Result<(), Located> {
        let [number, rest @ ..] = keys else { return Ok(()) };
        let (index, count) = (number.parse().unwrap_or(usize::MAX), items.len());
        let Some(item) = items.get_mut(index) else {
            let reason =
                format!("is a list of {count} here; write the number of an item, counted from 0, after its name");
            return Err(self.refused(reason));
        };
        self.path = self.path.item(index);
        if rest.is_empty() {
            *item = value;
            return Ok(());
        }
        self.put(item, known.and_then(|known| known.first()), rest, value)
    }

    /// What a text means that leaves a key out whose own keys are set: a table of defaults, or a list, which is empty but for the bubbles.
    fn left_out<'s>(&self, known: Option<&Value>) -> DeValue<'s> {
        if !known.is_some_and(Value::is_array) {
            return DeValue::Table(DeTable::new());
        }
        let mut items = DeArray::new();
        if self.path == KeyPath::default().key("bubble") {
            items.push(self.spanned(DeValue::Table(DeTable::new())));
        }
        DeValue::Array(items)
    }

    fn spanned<T>(&self, value: T) -> Spanned<T> {
        Spanned::new(self.span.clone(), value)
    }

    fn refused(&self, reason: String) -> Located {
        Located::bad_value(self.span.start, &self.path, reason)
    }
}
