//! Shaders with values for their constants. What the constants rule out is taken out of the text before a compiler sees it: lavapipe and SwiftShader
//! put every function in the place of each of its calls before they look at conditions, and then need ten times as long (1.7 s where lavapipe
//! needs 0.15 for the default scene). All else stays on its line, so that errors name the right one.

mod condition;
mod fold;
mod items;
#[cfg(test)]
mod tests;
mod tokens;

use std::{
    collections::{BTreeMap, HashMap},
    ops::Range,
};

use self::{fold::kept, items::Item, tokens::Tokens};
use super::shaders::{Composed, ShaderError};

/// A shader of one entry point, without constants that are left open.
pub struct Specialised {
    /// The text, with as many lines as that of the pass.
    pub wgsl: String,
    /// Numbers of the bindings that it has a use for.
    pub bindings: Vec<u32>,
}

/// The shader of an entry point of a pass, with a value for each of the constants that the pass leaves open.
///
/// # Errors
///
/// There is no such entry point, or a constant without a value.
pub fn specialised(
    composed: &Composed,
    entry: &str,
    constants: &[(&'static str, u32)],
) -> Result<Specialised, ShaderError> {
    let refused =
        |at: usize, message: String| ShaderError { place: composed.place(line_of(&composed.wgsl, at)), message };
    let pass = Pass::new(&composed.wgsl, constants);
    let Some(first) = pass.items.iter().position(|item| item.kind == "fn" && item.name == entry) else {
        return Err(refused(0, format!("there is no entry point `{entry}`")));
    };
    let mut text = Text::new(&composed.wgsl);
    let mut bindings = Vec::new();
    for (index, kept) in pass.reached(first) {
        let item = &pass.items[index];
        if item.kind == "override" {
            let Some(value) = pass.values.get(item.name) else {
                return Err(refused(item.start, format!("`{}` has no value", item.name)));
            };
            text.keep(item.start..item.start, &format!("const {}: u32 = {value}u;", item.name));
        } else {
            kept.into_iter().for_each(|range| text.keep(pass.place(range), ""));
        }
        bindings.extend(item.binding);
    }
    Ok(Specialised { wgsl: text.finished(), bindings })
}

fn line_of(text: &str, at: usize) -> usize {
    1 + text[..at].matches('\n').count()
}

/// Values of whole numbers with a name.
type Values<'a> = HashMap<&'a str, u32>;

/// A pass, taken apart.
struct Pass<'a> {
    tokens: Tokens<'a>,
    items: Vec<Item<'a>>,
    values: Values<'a>,
}

impl<'a> Pass<'a> {
    fn new(wgsl: &'a str, constants: &[(&'static str, u32)]) -> Self {
        let tokens = Tokens::new(wgsl);
        let items = Item::all(&tokens);
        let mut values: Values<'_> = items.iter().filter_map(|item| item.value(&tokens)).collect();
        let is_open = |name: &str| items.iter().find(|item| item.kind == "override" && item.name == name);
        values.extend(constants.iter().filter_map(|(name, value)| Some((is_open(name)?.name, *value))));
        Self { tokens, items, values }
    }

    /// The declarations that one needs, in the order of the text, by their places among all, with the ranges of tokens that are kept of each.
    fn reached(&self, first: usize) -> BTreeMap<usize, Vec<Range<usize>>> {
        let by_name: HashMap<&str, usize> =
            self.items.iter().enumerate().map(|(index, item)| (item.name, index)).collect();
        let (mut reached, mut waiting) = (BTreeMap::new(), vec![first]);
        while let Some(index) = waiting.pop() {
            if reached.contains_key(&index) {
                continue;
            }
            let item = &self.items[index];
            let (kept, own) = (kept(&self.tokens, &self.values, item), item.own_names(&self.tokens));
            for at in kept.iter().cloned().flatten() {
                let name = self.tokens.text(at);
                let is_member = self.tokens.text(at.wrapping_sub(1)) == ".";
                waiting.extend(by_name.get(name).filter(|_| !is_member && !own.contains(name)));
            }
            reached.insert(index, kept);
        }
        reached
    }

    /// Where tokens stand in the text.
    fn place(&self, range: Range<usize>) -> Range<usize> {
        self.tokens.0[range.start].start..self.tokens.0[range.end - 1].end()
    }
}

/// A text of which parts are kept, with all of its lines.
struct Text<'a> {
    whole: &'a str,
    at: usize,
    made: String,
}

impl<'a> Text<'a> {
    fn new(whole: &'a str) -> Self {
        Self { whole, at: 0, made: String::with_capacity(whole.len()) }
    }

    /// Keeps a part, with a text before it.
    fn keep(&mut self, part: Range<usize>, before: &str) {
        // Braces that do not match let declarations overlap: the compiler will say what is wrong.
        if part.start < self.at {
            return;
        }
        self.skip_to(part.start);
        // What stood between two words kept them apart.
        self.made.push(' ');
        self.made.push_str(before);
        self.made.push_str(&self.whole[part.clone()]);
        self.at = part.end;
    }

    fn skip_to(&mut self, at: usize) {
        let skipped = &self.whole[self.at..at];
        self.made.extend(skipped.chars().filter(|c| *c == '\n'));
        self.at = at;
    }

    fn finished(mut self) -> String {
        self.skip_to(self.whole.len());
        self.made
    }
}
