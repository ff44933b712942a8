//! What a shader declares outside functions.

use std::{collections::HashSet, ops::Range};

use super::tokens::{Tokens, whole_number};

/// A declaration outside functions.
pub struct Item<'a> {
    /// The keyword that it begins with.
    pub kind: &'a str,
    pub name: &'a str,
    pub start: usize,
    pub tokens: Range<usize>,
    /// Number of its binding.
    pub binding: Option<u32>,
}

impl<'a> Item<'a> {
    /// Those of a text, in its order.
    pub fn all(tokens: &Tokens<'a>) -> Vec<Self> {
        let mut items = Vec::new();
        let (mut first, mut depth) = (0, 0_usize);
        for at in 0..tokens.len() {
            match tokens.text(at) {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth == 0 && [";", "}"].contains(&tokens.text(at)) {
                items.extend(Self::new(tokens, first..at + 1));
                first = at + 1;
            }
        }
        items
    }

    /// The declaration that stands in a range; none of what declares nothing.
    fn new(tokens: &Tokens<'a>, range: Range<usize>) -> Option<Self> {
        let kinds = ["fn", "struct", "const", "override", "var", "alias"];
        let at = range.clone().find(|at| kinds.contains(&tokens.text(*at)))?;
        // A variable's address space stands before its name.
        let has_space = tokens.text(at + 1) == "<";
        let name = if has_space { (at..range.end).find(|at| tokens.text(*at) == ">")? + 1 } else { at + 1 };
        let binding = (range.start..at).find(|at| tokens.text(*at) == "binding");
        Some(Self {
            kind: tokens.text(at),
            name: tokens.text(name),
            start: tokens.0[range.start].start,
            binding: binding.and_then(|at| whole_number(tokens.text(at + 2))),
            tokens: range,
        })
    }

    /// The name and value of a whole number.
    pub fn value(&self, tokens: &Tokens<'a>) -> Option<(&'a str, u32)> {
        let [.., equals, value, _] = &tokens.0[self.tokens.clone()] else { return None };
        let is_number = self.kind == "const" && equals.text == "=";
        is_number.then(|| whole_number(value.text)).flatten().map(|value| (self.name, value))
    }

    /// Names that stand for something inside it: parameters, members, variables. Others of these names are not meant there.
    pub fn own_names(&self, tokens: &Tokens<'a>) -> HashSet<&'a str> {
        let is_declared = |at: &usize| {
            let (before, after) = (tokens.text(at.wrapping_sub(1)), tokens.text(at + 1));
            ["let", "var", "const"].contains(&before) || (after == ":" && before != "case")
        };
        self.tokens.clone().filter(is_declared).map(|at| tokens.text(at)).collect()
    }
}
