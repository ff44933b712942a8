//! Words of messages.

use std::borrow::Cow;

/// A text cut to a number of characters, for messages: a longer one loses its middle.
#[must_use]
pub fn shorten(text: &str, max: usize) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= max {
        return text.into();
    }
    let (tail, head) = (max / 2, max - max / 2 - 1);
    text.chars().take(head).chain(['…']).chain(text.chars().skip(count - tail)).collect()
}

/// The known name that a mistyped one is likely meant to be, if there is one.
#[must_use]
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    const NEAR: f64 = 0.75;
    const LONGEST: usize = 100;
    let name = shorten(name, LONGEST);
    let similarities = known.iter().map(|known| (strsim::jaro_winkler(&name, known), *known));
    let (similarity, nearest) = similarities.max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    (similarity >= NEAR).then_some(nearest)
}
