//! Conditions, as far as constants decide them.

use std::ops::Range;

use super::{
    Values,
    tokens::{Tokens, whole_number},
};

/// A condition that is worked out, as far as constants decide it.
pub struct Condition<'p, 'a> {
    tokens: &'p Tokens<'a>,
    values: &'p Values<'a>,
    at: usize,
    end: usize,
}

impl<'p, 'a> Condition<'p, 'a> {
    /// The condition in a range of tokens.
    pub fn new(tokens: &'p Tokens<'a>, values: &'p Values<'a>, range: Range<usize>) -> Self {
        Self { tokens, values, at: range.start, end: range.end }
    }

    /// Whether it holds; none if constants do not tell.
    pub fn value(mut self) -> Option<bool> {
        self.any()
    }

    fn next(&self) -> &'a str {
        if self.at < self.end { self.tokens.text(self.at) } else { "" }
    }

    fn any(&mut self) -> Option<bool> {
        let mut value = self.all();
        while self.next() == "||" {
            self.at += 1;
            value = match (value, self.all()) {
                (Some(true), _) | (_, Some(true)) => Some(true),
                (Some(false), Some(false)) => Some(false),
                _ => None,
            };
        }
        value
    }

    fn all(&mut self) -> Option<bool> {
        let mut value = self.one();
        while self.next() == "&&" {
            self.at += 1;
            value = match (value, self.one()) {
                (Some(false), _) | (_, Some(false)) => Some(false),
                (Some(true), Some(true)) => Some(true),
                _ => None,
            };
        }
        value
    }

    fn one(&mut self) -> Option<bool> {
        let start = self.at;
        if self.next() == "(" {
            self.at += 1;
            let value = self.any();
            self.at += 1;
            if ["", ")", "&&", "||"].contains(&self.next()) {
                return value;
            }
            self.at = start;
        }
        // A comparison ends before the next one, or at the bracket that closes the condition.
        let mut depth = 0_usize;
        while self.at < self.end && (depth > 0 || !["&&", "||", ")"].contains(&self.next())) {
            match self.next() {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                _ => {}
            }
            self.at += 1;
        }
        let [left, comparison, right] = self.tokens.0.get(start..self.at)? else { return None };
        let number = |text: &str| whole_number(text).or_else(|| self.values.get(text).copied());
        let (left, right) = (number(left.text)?, number(right.text)?);
        match comparison.text {
            "==" => Some(left == right),
            "!=" => Some(left != right),
            "<" => Some(left < right),
            "<=" => Some(left <= right),
            ">" => Some(left > right),
            ">=" => Some(left >= right),
            _ => None,
        }
    }
}
