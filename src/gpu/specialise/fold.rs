//! What constants leave of a function.

use std::ops::Range;

use super::{Values, condition::Condition, items::Item, tokens::Tokens};

/// A declaration, out of which branches are taken.
struct Fold<'p, 'a> {
    tokens: &'p Tokens<'a>,
    values: &'p Values<'a>,
    /// Ranges of tokens that are kept, in their order.
    kept: Vec<Range<usize>>,
    /// Begin of what nothing is known about yet.
    from: usize,
}

/// Ranges of tokens that are kept of a declaration, none of them empty.
pub fn kept(tokens: &Tokens<'_>, values: &Values<'_>, item: &Item<'_>) -> Vec<Range<usize>> {
    let mut fold = Fold { tokens, values, kept: Vec::new(), from: item.tokens.start };
    let is_body = |at: &usize| item.kind == "fn" && tokens.text(*at) == "{";
    if let Some(body) = item.tokens.clone().find(is_body) {
        fold.fold_block(body);
    }
    fold.drop_range(item.tokens.end..item.tokens.end);
    fold.kept
}

impl Fold<'_, '_> {
    /// Takes out of a block, which begins with its brace, what the constants rule out; returns where it ends and whether it ends with a jump.
    fn fold_block(&mut self, open: usize) -> (usize, bool) {
        let (mut at, mut statement) = (open + 1, open + 1);
        let mut jumps = false;
        while at < self.tokens.len() {
            match self.tokens.text(at) {
                "}" => return (at + 1, jumps),
                // Nothing may stand after a jump that took the place of a branch.
                _ if jumps => {
                    let close = self.tokens.close(open);
                    self.drop_range(at..close);
                    return (close + 1, true);
                }
                // Elsewhere it is that of `break if`.
                "if" if at == statement => {
                    (at, jumps) = self.fold_if(at);
                    statement = at;
                }
                "{" => {
                    // The body of a loop and the cases of a `switch` are left in other ways too.
                    let is_bare = at == statement;
                    let (end, body_jumps) = self.fold_block(at);
                    (at, jumps) = (end, is_bare && body_jumps);
                    statement = at;
                }
                ";" => {
                    jumps = ["return", "break", "continue"].contains(&self.tokens.text(statement));
                    at += 1;
                    statement = at;
                }
                _ => at += 1,
            }
        }
        (at, jumps)
    }

    /// Takes out of an `if`, with all that follows its `else`, what the constants rule out; returns as [`Self::fold_block`].
    fn fold_if(&mut self, at: usize) -> (usize, bool) {
        let open = self.tokens.open(at);
        let close = self.tokens.close(open);
        let has_else = self.is_else(close + 1);
        match self.condition(at) {
            Some(true) => {
                self.drop_range(at..open);
                let (mut end, jumps) = self.fold_block(open);
                if has_else {
                    let rest = end;
                    end = self.end_of_else(rest);
                    self.drop_range(rest..end);
                }
                (end, jumps)
            }
            Some(false) if has_else => {
                self.drop_range(at..close + 2);
                self.fold_else(close + 2)
            }
            Some(false) => {
                self.drop_range(at..close + 1);
                (close + 1, false)
            }
            None => {
                let (end, first) = self.fold_block(open);
                if !has_else {
                    return (end, false);
                }
                if self.vanishes(end + 1) {
                    let rest = self.end_of_else(end);
                    self.drop_range(end..rest);
                    return (rest, false);
                }
                let (end, second) = self.fold_else(end + 1);
                (end, first && second)
            }
        }
    }

    /// What follows an `else`.
    fn fold_else(&mut self, at: usize) -> (usize, bool) {
        if self.tokens.text(at) == "if" { self.fold_if(at) } else { self.fold_block(at) }
    }

    /// Whether nothing is left of what follows an `else`.
    fn vanishes(&self, at: usize) -> bool {
        let end = self.tokens.close(self.tokens.open(at)) + 1;
        self.tokens.text(at) == "if"
            && self.condition(at) == Some(false)
            && (!self.is_else(end) || self.vanishes(end + 1))
    }

    /// Where an `else` ends, with all that follows it.
    fn end_of_else(&self, at: usize) -> usize {
        let end = self.tokens.close(self.tokens.open(at)) + 1;
        let goes_on = self.tokens.text(at + 1) == "if" && self.is_else(end);
        if goes_on { self.end_of_else(end) } else { end }
    }

    /// What is known of the condition of an `if`.
    fn condition(&self, at: usize) -> Option<bool> {
        Condition::new(self.tokens, self.values, at + 1..self.tokens.open(at)).value()
    }

    fn is_else(&self, at: usize) -> bool {
        self.tokens.text(at) == "else"
    }

    fn drop_range(&mut self, range: Range<usize>) {
        if self.from < range.start {
            self.kept.push(self.from..range.start);
        }
        self.from = range.end;
    }
}
