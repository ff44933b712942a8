//! Values of the keys of scenes, from what the format's page says of them: both ends of each range, and what lies between.

use proptest::prelude::*;
use toml::Value;

use crate::support::page::{Row, documented};

/// A value of a key, or none: its default. Shrinks to none.
pub fn value(row: Row) -> BoxedStrategy<Option<Value>> {
    // Random scenes have no files beside them. What a lens of some length sees, `fov_y_deg` says too.
    // A spectrum's lists must be equally long.
    if row.range == "a path" || row.section == "light.spectrum" || row.key == "focal_mm" {
        return Just(None).boxed();
    }
    prop_oneof![Just(None), chosen(row).prop_map(Some)].boxed()
}

fn chosen(row: Row) -> BoxedStrategy<Value> {
    let words = words(&row);
    let number = row.range.split_once(" ..= ").map(|(low, high)| {
        let [low, high] = [low, high].map(|end| end.parse().unwrap_or_else(|_| panic!("{}: {}", row.key, row.range)));
        if is_whole(&row) { whole(low, high).boxed() } else { list(&row, between(low, high, default(&row))) }
    });
    let any = match row.range {
        "finite" => Some(list(&row, prop_oneof![-1e3..1e3, Just(f64::MIN), Just(f64::MAX), -1e9..1e9].boxed())),
        "whole" => Some(whole(0.0, i64::MAX as f64).boxed()),
        "`true`, `false`" => Some(any::<bool>().prop_map(Value::from).boxed()),
        _ => number,
    };
    match (words.is_empty(), any) {
        (true, Some(any)) => any,
        (false, None) => prop::sample::select(words).prop_map(Value::from).boxed(),
        (false, Some(any)) => prop_oneof![prop::sample::select(words).prop_map(Value::from), any].boxed(),
        (true, None) => panic!("`{}` in [{}]: no values are known for {}", row.key, row.section, row.range),
    }
}

/// The words that a key may have. Where the range says no more than `a name`, or a word is the default beside numbers, the meaning lists them.
fn words(row: &Row) -> Vec<String> {
    let by_meaning = row.range == "a name" || (row.default.starts_with('"') && row.range.contains("..="));
    let named = if by_meaning && row.section == "light.patch" { meaning_of("light", row.key) } else { row.meaning };
    let told = if by_meaning { named } else { row.range };
    told.split('`').filter_map(|word| word.strip_prefix('"')?.strip_suffix('"')).map(str::to_owned).collect()
}

fn meaning_of(section: &str, key: &str) -> &'static str {
    let rows = documented();
    rows.iter().find(|row| (row.section, row.key) == (section, key)).map_or("", |row| row.meaning)
}

fn is_whole(row: &Row) -> bool {
    row.default.parse::<i64>().is_ok()
}

/// Whether the value is a list of three.
fn is_list(row: &Row) -> bool {
    let listed = |row: &Row| row.default.starts_with('[') || row.meaning.contains("[r, g, b]");
    listed(row) || documented().iter().any(|other| other.key == row.key && listed(other))
}

fn list(row: &Row, number: BoxedStrategy<f64>) -> BoxedStrategy<Value> {
    if !is_list(row) {
        return number.prop_map(Value::from).boxed();
    }
    prop::array::uniform3(number).prop_map(|numbers| Value::Array(numbers.map(Value::from).into())).boxed()
}

fn default(row: &Row) -> f64 {
    row.default.trim_start_matches('[').split(',').next().and_then(|number| number.parse().ok()).unwrap_or(1.0)
}

/// An end of a range, or a number in it: most of them near the default, for ranges span many powers of ten.
fn between(low: f64, high: f64, default: f64) -> BoxedStrategy<f64> {
    let near = (0.0..1.0, any::<bool>()).prop_map(move |(part, is_more): (f64, bool)| {
        let end = if is_more { high } else { low };
        (default + (end - default) * part.powi(4)).clamp(low, high)
    });
    prop_oneof![2 => near, 1 => Just(low), 1 => Just(high)].boxed()
}

fn whole(low: f64, high: f64) -> impl Strategy<Value = Value> {
    let [low, high] = [low, high].map(|end| end as i64);
    prop_oneof![Just(low), Just(high), low..=high].prop_map(Value::from)
}
