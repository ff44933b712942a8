//! Several bubbles that are edited together: what they have in common, and how a change of one becomes a change of all.

use std::collections::BTreeSet;

use toml::{Table, Value};

use crate::scene::{Bubble, Key};

/// Where the keys of the film stand among those of a bubble.
const FILM: &str = "film";

/// The keys of some bubbles, and what an edit does to them.
#[derive(Clone, Debug, Default)]
pub struct Group {
    mixed: BTreeSet<String>,
    /// Keys that are set although the bubble that is shown has this value already.
    set: BTreeSet<&'static str>,
}

impl Group {
    /// What bubbles have in common. Names of a bubble's keys and of its film's are different.
    #[must_use]
    pub fn new<'a>(bubbles: impl IntoIterator<Item = &'a Bubble>) -> Self {
        let tables: Vec<Table> = bubbles.into_iter().filter_map(flat).collect();
        let keys: BTreeSet<&String> = tables.iter().flat_map(Table::keys).collect();
        let differ = |key: &str| tables.windows(2).any(|pair| pair[0].get(key) != pair[1].get(key));
        let mixed = keys.into_iter().filter(|key| differ(key)).cloned().collect();
        Self { mixed, set: BTreeSet::new() }
    }

    /// Whether a key has several values.
    #[must_use]
    pub fn is_mixed(&self, key: &Key) -> bool {
        self.mixed.contains(key.name)
    }

    /// A key was set, to the value that the shown bubble has.
    pub fn set(&mut self, key: &Key) {
        self.set.insert(key.name);
    }

    /// Whether something was set.
    #[must_use]
    pub fn is_set(&self) -> bool {
        !self.set.is_empty()
    }

    /// Another bubble with what the change of one has changed. Of a list the numbers that have changed.
    #[must_use]
    pub fn change(&self, before: &Bubble, after: &Bubble, other: &Bubble) -> Bubble {
        let [before, after, mut changed] = [before, after, other].map(|bubble| flat(bubble).unwrap_or_default());
        for (key, value) in &after {
            let old = before.get(key);
            match changed.get_mut(key) {
                _ if old == Some(value) && !self.set.contains(key.as_str()) => {}
                Some(own) => copy(own, old, value),
                None => drop(changed.insert(key.clone(), value.clone())),
            }
        }
        unflattened(changed).unwrap_or_else(|| other.clone())
    }
}

/// Gives a value, or of a list the parts that have changed.
fn copy(own: &mut Value, old: Option<&Value>, new: &Value) {
    match (own, old, new) {
        (Value::Array(own), Some(Value::Array(old)), Value::Array(new)) if own.len() == new.len() => {
            own.iter_mut().zip(new).zip(old).filter(|((_, new), old)| new != old).for_each(|((own, new), _)| {
                *own = new.clone();
            });
        }
        (own, ..) => *own = new.clone(),
    }
}

/// The keys of a bubble and its film in one table; `None` where TOML cannot hold a number of it.
fn flat(bubble: &Bubble) -> Option<Table> {
    let mut table = Table::try_from(bubble).ok()?;
    let Some(Value::Table(film)) = table.remove(FILM) else { return None };
    table.extend(film);
    Some(table)
}

fn unflattened(mut table: Table) -> Option<Bubble> {
    let names = crate::scene::Film::ALL_KEYS.iter().map(|key| key.name);
    let film: Table = names.filter_map(|name| table.remove_entry(name)).collect();
    table.insert(FILM.to_owned(), Value::Table(film));
    Value::Table(table).try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Film, FilmIndexName};

    fn bubbles() -> [Bubble; 2] {
        let other = Bubble {
            center_m: [1.0, 2.0, 3.0],
            film: Film { thickness_nm: 300.0, index: FilmIndexName::Constant(1.4), ..Film::default() },
            ..Bubble::default()
        };
        [Bubble::default(), other]
    }

    #[test]
    fn what_differs_is_mixed() {
        let group = Group::new(&bubbles());
        assert!(group.is_mixed(&Bubble::KEYS.center_m) && group.is_mixed(&Film::KEYS.thickness_nm));
        assert!(group.is_mixed(&Film::KEYS.index) && !group.is_mixed(&Bubble::KEYS.radius_mm));
        assert!(!Group::new(&bubbles()[..1]).is_mixed(&Film::KEYS.index));
    }

    #[test]
    fn only_what_was_changed_is_changed_in_others() {
        let [one, other] = bubbles();
        let group = Group::new([&one, &other]);
        let mut edited = one.clone();
        (edited.radius_mm, edited.center_m[1], edited.film.stratification) = (20.0, 9.0, -1.0);
        edited.film.index = FilmIndexName::Named("glycerol 30%".to_owned());
        let changed = group.change(&one, &edited, &other);
        let mut expected = Bubble { radius_mm: 20.0, center_m: [1.0, 9.0, 3.0], ..other.clone() };
        (expected.film.stratification, expected.film.index) = (-1.0, edited.film.index.clone());
        assert_eq!(changed, expected);
        assert_eq!(group.change(&one, &edited, &one), edited);
        assert_eq!(group.change(&one, &one, &other), other);
    }

    #[test]
    fn a_value_that_the_shown_bubble_has_can_be_set_for_all() {
        let [one, other] = bubbles();
        let mut group = Group::new([&one, &other]);
        group.set(&Film::KEYS.thickness_nm);
        let changed = group.change(&one, &one, &other);
        assert!(group.is_set() && changed.film.thickness_nm == 700.0 && changed.film.index == other.film.index);
    }
}
