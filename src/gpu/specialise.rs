//! Shaders with values for their constants. What the constants rule out is taken out of the text before a compiler sees it: lavapipe and SwiftShader
//! put every function in the place of each of its calls before they look at conditions, and then need ten times as long (1.7 s where lavapipe
//! needs 0.15 for the default scene). All else stays on its line, so that errors name the right one.

use std::{
    collections::{BTreeSet, HashMap, HashSet},
    ops::Range,
};

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
    for index in pass.reached(first) {
        let item = &pass.items[index];
        if item.kind == "override" {
            let Some(value) = pass.values.get(item.name) else {
                return Err(refused(item.start, format!("`{}` has no value", item.name)));
            };
            text.keep(item.start..item.start, &format!("const {}: u32 = {value}u;", item.name));
        } else {
            pass.kept(item).into_iter().for_each(|range| text.keep(range, ""));
        }
        bindings.extend(item.binding);
    }
    Ok(Specialised { wgsl: text.finished(), bindings })
}

fn line_of(text: &str, at: usize) -> usize {
    1 + text[..at].matches('\n').count()
}

/// A word, a number or a mark of the language, and where it stands.
#[derive(Clone, Copy)]
struct Token<'a> {
    text: &'a str,
    start: usize,
}

impl Token<'_> {
    fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// The tokens of a text, without its comments.
fn tokens(wgsl: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(first) = wgsl[at..].chars().next() {
        let rest = &wgsl[at..];
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if first.is_whitespace() {
            first.len_utf8()
        } else if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            let pairs = ["==", "!=", "<=", ">=", "&&", "||", "->"];
            pairs.into_iter().find(|pair| rest.starts_with(pair)).map_or(first.len_utf8(), str::len)
        };
        if !first.is_whitespace() && !rest.starts_with("//") {
            tokens.push(Token { text: &rest[..length], start: at });
        }
        at += length;
    }
    tokens
}

/// A declaration outside functions.
struct Item<'a> {
    /// The keyword that it begins with.
    kind: &'a str,
    name: &'a str,
    start: usize,
    tokens: Range<usize>,
    /// Number of its binding.
    binding: Option<u32>,
}

/// A pass, taken apart.
struct Pass<'a> {
    tokens: Vec<Token<'a>>,
    items: Vec<Item<'a>>,
    /// Values of its whole numbers with a name.
    values: HashMap<&'a str, u32>,
}

impl<'a> Pass<'a> {
    fn new(wgsl: &'a str, constants: &[(&'static str, u32)]) -> Self {
        let tokens = tokens(wgsl);
        let mut items = Vec::new();
        let (mut first, mut depth) = (0, 0_usize);
        for (at, token) in tokens.iter().enumerate() {
            match token.text {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => depth = depth.saturating_sub(1),
                _ => {}
            }
            let ends = depth == 0 && (token.text == ";" || token.text == "}");
            if ends {
                items.extend(Item::new(&tokens, first..at + 1));
                first = at + 1;
            }
        }
        let mut values: HashMap<&str, u32> = items.iter().filter_map(|item| item.value(&tokens)).collect();
        let is_open = |name: &str| items.iter().find(|item| item.kind == "override" && item.name == name);
        values.extend(constants.iter().filter_map(|(name, value)| Some((is_open(name)?.name, *value))));
        Self { tokens, items, values }
    }

    /// Places of the declarations that one needs, in the order of the text.
    fn reached(&self, first: usize) -> BTreeSet<usize> {
        let by_name: HashMap<&str, usize> =
            self.items.iter().enumerate().map(|(index, item)| (item.name, index)).collect();
        let (mut reached, mut waiting) = (BTreeSet::from([first]), vec![first]);
        while let Some(index) = waiting.pop() {
            let item = &self.items[index];
            let own = self.own_names(item);
            for range in self.kept_tokens(item) {
                let names = range.filter(|at| !self.is_member(*at)).map(|at| self.tokens[at].text);
                let needed = names.filter(|name| !own.contains(name)).filter_map(|name| by_name.get(name));
                waiting.extend(needed.filter(|index| reached.insert(**index)));
            }
        }
        reached
    }

    /// Names that stand for something inside a declaration: parameters, members, variables. Others of these names are not meant there.
    fn own_names(&self, item: &Item<'_>) -> HashSet<&'a str> {
        let is_declared = |at: &usize| {
            let (before, after) = (self.text(at.wrapping_sub(1)), self.text(at + 1));
            ["let", "var", "const"].contains(&before) || (after == ":" && before != "case")
        };
        item.tokens.clone().filter(is_declared).map(|at| self.tokens[at].text).collect()
    }

    fn is_member(&self, at: usize) -> bool {
        self.text(at.wrapping_sub(1)) == "."
    }

    fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| token.text)
    }

    /// Places in the text of what is kept of a declaration.
    fn kept(&self, item: &Item<'_>) -> Vec<Range<usize>> {
        let place = |range: Range<usize>| self.tokens[range.start].start..self.tokens[range.end - 1].end();
        self.kept_tokens(item).into_iter().map(place).collect()
    }

    /// Ranges of tokens that are kept of a declaration, none of them empty.
    fn kept_tokens(&self, item: &Item<'_>) -> Vec<Range<usize>> {
        let is_body = |at: &usize| item.kind == "fn" && self.tokens[*at].text == "{";
        let mut kept = Kept { ranges: Vec::new(), from: item.tokens.start };
        if let Some(body) = item.tokens.clone().find(is_body) {
            self.fold_block(body, &mut kept);
        }
        kept.drop_range(item.tokens.end..item.tokens.end);
        kept.ranges
    }

    /// Takes out of a block, which begins with its brace, what the constants rule out; returns where it ends and whether it ends with a jump.
    fn fold_block(&self, open: usize, kept: &mut Kept) -> (usize, bool) {
        let (mut at, mut statement) = (open + 1, open + 1);
        let mut jumps = false;
        while at < self.tokens.len() {
            match self.tokens[at].text {
                "}" => return (at + 1, jumps),
                // Nothing may stand after a jump that took the place of a branch.
                _ if jumps => {
                    let close = self.close(open);
                    kept.drop_range(at..close);
                    return (close + 1, true);
                }
                "if" => {
                    (at, jumps) = self.fold_if(at, kept);
                    statement = at;
                }
                "{" => {
                    // The body of a loop and the cases of a `switch` are left in other ways too.
                    let is_bare = at == statement;
                    let (end, body_jumps) = self.fold_block(at, kept);
                    (at, jumps) = (end, is_bare && body_jumps);
                    statement = at;
                }
                ";" => {
                    jumps = ["return", "break", "continue"].contains(&self.tokens[statement].text);
                    at += 1;
                    statement = at;
                }
                _ => at += 1,
            }
        }
        (at, jumps)
    }

    /// Takes out of an `if`, with all that follows its `else`, what the constants rule out; returns as [`Self::fold_block`].
    fn fold_if(&self, at: usize, kept: &mut Kept) -> (usize, bool) {
        let open = self.open(at);
        let close = self.close(open);
        let has_else = self.is_else(close + 1);
        match self.condition(at) {
            Some(true) => {
                kept.drop_range(at..open);
                let (mut end, jumps) = self.fold_block(open, kept);
                if has_else {
                    let rest = end;
                    end = self.end_of_else(rest);
                    kept.drop_range(rest..end);
                }
                (end, jumps)
            }
            Some(false) if has_else => {
                kept.drop_range(at..close + 2);
                self.fold_else(close + 2, kept)
            }
            Some(false) => {
                kept.drop_range(at..close + 1);
                (close + 1, false)
            }
            None => {
                let (end, first) = self.fold_block(open, kept);
                if !has_else {
                    return (end, false);
                }
                if self.vanishes(end + 1) {
                    let rest = self.end_of_else(end);
                    kept.drop_range(end..rest);
                    return (rest, false);
                }
                let (end, second) = self.fold_else(end + 1, kept);
                (end, first && second)
            }
        }
    }

    /// What follows an `else`.
    fn fold_else(&self, at: usize, kept: &mut Kept) -> (usize, bool) {
        if self.text(at) == "if" { self.fold_if(at, kept) } else { self.fold_block(at, kept) }
    }

    /// Whether nothing is left of what follows an `else`.
    fn vanishes(&self, at: usize) -> bool {
        let end = self.close(self.open(at)) + 1;
        self.text(at) == "if" && self.condition(at) == Some(false) && (!self.is_else(end) || self.vanishes(end + 1))
    }

    /// Where an `else` ends, with all that follows it.
    fn end_of_else(&self, at: usize) -> usize {
        let end = self.close(self.open(at)) + 1;
        let goes_on = self.text(at + 1) == "if" && self.is_else(end);
        if goes_on { self.end_of_else(end) } else { end }
    }

    /// What is known of the condition of an `if`.
    fn condition(&self, at: usize) -> Option<bool> {
        Condition { pass: self, at: at + 1, end: self.open(at) }.value()
    }

    fn is_else(&self, at: usize) -> bool {
        self.text(at) == "else"
    }

    /// The next opening brace.
    fn open(&self, at: usize) -> usize {
        (at..self.tokens.len()).find(|at| self.tokens[*at].text == "{").unwrap_or(at)
    }

    /// The closing brace of an opening one.
    fn close(&self, open: usize) -> usize {
        let mut depth = 0;
        let closes = |at: &usize| {
            match self.tokens[*at].text {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            depth == 0
        };
        (open..self.tokens.len()).find(closes).unwrap_or(self.tokens.len() - 1)
    }
}

impl<'a> Item<'a> {
    fn new(tokens: &[Token<'a>], range: Range<usize>) -> Option<Self> {
        let kinds = ["fn", "struct", "const", "override", "var", "alias"];
        let at = range.clone().find(|at| kinds.contains(&tokens[*at].text))?;
        // A variable's address space stands before its name.
        let space = tokens.get(at + 1)?.text == "<";
        let name = if space { (at..range.end).find(|at| tokens[*at].text == ">")? + 1 } else { at + 1 };
        let binding = (range.start..at).find(|at| tokens[*at].text == "binding");
        Some(Self {
            kind: tokens[at].text,
            name: tokens.get(name)?.text,
            start: tokens[range.start].start,
            binding: binding.and_then(|at| whole_number(tokens.get(at + 2)?.text)),
            tokens: range,
        })
    }

    /// The name and value of a whole number.
    fn value(&self, tokens: &[Token<'a>]) -> Option<(&'a str, u32)> {
        let [.., equals, value, _] = &tokens[self.tokens.clone()] else { return None };
        let is_number = self.kind == "const" && equals.text == "=";
        is_number.then(|| whole_number(value.text)).flatten().map(|value| (self.name, value))
    }
}

fn whole_number(text: &str) -> Option<u32> {
    text.trim_end_matches('u').parse().ok()
}

/// The ranges that are kept of a declaration, in its order.
struct Kept {
    ranges: Vec<Range<usize>>,
    /// Begin of what nothing is known about yet.
    from: usize,
}

impl Kept {
    fn drop_range(&mut self, range: Range<usize>) {
        if self.from < range.start {
            self.ranges.push(self.from..range.start);
        }
        self.from = range.end;
    }
}

/// A condition that is worked out, as far as constants decide it.
struct Condition<'p, 'a> {
    pass: &'p Pass<'a>,
    at: usize,
    end: usize,
}

impl<'a> Condition<'_, 'a> {
    /// Whether it holds; none if constants do not tell.
    fn value(mut self) -> Option<bool> {
        self.any()
    }

    fn next(&self) -> &'a str {
        if self.at < self.end { self.pass.tokens[self.at].text } else { "" }
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
        let [left, comparison, right] = &self.pass.tokens[start..self.at] else { return None };
        let number = |text: &str| whole_number(text).or_else(|| self.pass.values.get(text).copied());
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

#[cfg(test)]
mod tests {
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    use super::*;
    use crate::gpu::{passes::kernels, pipelines::SHARED_CONSTANTS, shaders::Library};

    /// The words of a function that is specialised for A = 1 and B = 0.
    fn folded(body: &str) -> String {
        let wgsl = format!("override A: u32;\noverride B: u32;\nconst TWO: u32 = 2u;\nfn main() {{ {body} }}\n");
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("pass")).unwrap();
        std::fs::write(folder.path().join("pass/some.wgsl"), wgsl).unwrap();
        let composed = Library::Directory(folder.path().to_owned()).compose("some").unwrap();
        let shader = specialised(&composed, "main", &[("A", 1), ("B", 0)]).unwrap();
        assert_eq!(shader.wgsl.lines().count(), 4);
        let body = shader.wgsl.lines().last().unwrap().strip_prefix(" fn main() {").unwrap().trim_end();
        body.strip_suffix('}').unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn branches_that_constants_rule_out_are_gone() {
        for (body, left) in [
            ("if (A == 1u) { one(); } two();", "{ one(); } two();"),
            ("if (A == 0u) { one(); } two();", "two();"),
            ("if A != 1u { one(); } else { two(); }", "{ two(); }"),
            ("if (B >= TWO) { one(); } else if (A < TWO) { two(); } else { three(); }", "{ two(); }"),
            ("if (A == 1u) { one(); } else if (x) { two(); } else { three(); } four();", "{ one(); } four();"),
            ("if (x) { one(); } else if (A == 1u) { two(); } else { three(); }", "if (x) { one(); } else { two(); }"),
            ("if (x) { one(); } else if (B == 1u) { two(); } three();", "if (x) { one(); } three();"),
            ("if (x) { if (B > A) { one(); } two(); }", "if (x) { two(); }"),
            (
                "for (var k = 0u; k < A; k++) { if (B == 1u) { continue; } one(); }",
                "for (var k = 0u; k < A; k++) { one(); }",
            ),
        ] {
            assert_eq!(folded(body), left, "{body}");
        }
    }

    #[test]
    fn conditions_are_known_as_far_as_constants_decide_them() {
        for (condition, known) in [
            ("(A == 1u && x > 0.0)", None),
            ("(B == 1u && x > 0.0)", Some(false)),
            ("(f(a, b) || A == 1u)", Some(true)),
            ("((B == 1u || x) && A == 1u)", None),
            ("((B == 1u || A == 0u) && x)", Some(false)),
            ("((a + b) * c < d || A >= 1u)", Some(true)),
            ("(!(A == 1u))", None),
            ("(A == 1.0)", None),
            ("(C == 1u)", None),
        ] {
            let left = folded(&format!("if {condition} {{ one(); }}"));
            let expected = match known {
                Some(true) => "{ one(); }".to_owned(),
                Some(false) => String::new(),
                None => format!("if {condition} {{ one(); }}"),
            };
            assert_eq!(left, expected, "{condition}");
        }
    }

    #[test]
    fn nothing_stands_after_a_jump_that_took_the_place_of_a_branch() {
        for (body, left) in [
            ("if (A == 1u) { return 1u; } return 2u;", "{ return 1u; }"),
            ("if (x) { return 1u; } return 2u;", "if (x) { return 1u; } return 2u;"),
            ("loop { if (A == 1u) { break; } one(); } two();", "loop { { break; } } two();"),
            ("{ if (x) { return 1u; } else { return 2u; } } one();", "{ if (x) { return 1u; } else { return 2u; } }"),
            (
                "switch x { case 0u: { return 1u; } default: { return 2u; } } one();",
                "switch x { case 0u: { return 1u; } default: { return 2u; } } one();",
            ),
        ] {
            assert_eq!(folded(body), left, "{body}");
        }
    }

    #[test]
    fn bindings_and_functions_without_a_use_are_left_out() {
        let wgsl = "override READS: u32;\n\
            @group(0) @binding(0) var<storage, read_write> result: array<u32>;\n\
            @group(0) @binding(7) var<storage, read> source: array<u32>;\n\
            fn plain(source: u32) -> u32 { let result = source; return result; }\n\
            fn value_of() -> u32 { if (READS == 0u) { return plain(1u); } let value = source[0]; return value; }\n\
            @compute @workgroup_size(1) fn main() { result[0] = value_of(); }\n\
            @compute @workgroup_size(1) fn other() { result[1] = value_of(); }\n";
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("pass")).unwrap();
        std::fs::write(folder.path().join("pass/some.wgsl"), wgsl).unwrap();
        let composed = Library::Directory(folder.path().to_owned()).compose("some").unwrap();
        for (reads, bindings) in [(1, vec![0, 7]), (0, vec![0])] {
            let shader = specialised(&composed, "main", &[("READS", reads)]).unwrap();
            assert_eq!(shader.bindings, bindings);
            assert!(!shader.wgsl.contains("fn other"));
            assert_eq!(shader.wgsl.lines().count(), wgsl.lines().count(), "lines stay where they were");
            naga::front::wgsl::parse_str(&shader.wgsl).unwrap();
        }
        let error = specialised(&composed, "mian", &[]).err().unwrap();
        assert_eq!(error.to_string(), "shader pass/some.wgsl:1: there is no entry point `mian`");
        let error = specialised(&composed, "main", &[]).err().unwrap();
        assert_eq!(error.to_string(), "shader pass/some.wgsl:1: `READS` has no value");
    }

    /// Numbers of the bindings that the one entry point of a text uses, as naga sees it.
    fn used(wgsl: &str) -> Vec<u32> {
        let module = naga::front::wgsl::parse_str(wgsl).unwrap();
        let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).unwrap();
        let point = info.get_entry_point(0);
        let variables = module.global_variables.iter().filter(|(handle, _)| !point[*handle].is_empty());
        variables.filter_map(|(_, variable)| Some(variable.binding?.binding)).collect()
    }

    /// While a shader is being written, anything may be in its file.
    #[test]
    fn broken_text_is_left_to_the_compiler() {
        let composed = Library::Embedded.compose("bubble").unwrap();
        let constants: Vec<_> = ["INNER", "SAMPLES", "ON_BATH", "OUTLINE"].map(|name| (name, 1)).into();
        for cut in (0..composed.wgsl.len()).step_by(499) {
            let (before, after) = composed.wgsl.split_at(composed.wgsl.floor_char_boundary(cut));
            let lines = composed.wgsl.lines().count();
            for text in [before, after] {
                let mut broken = composed.clone();
                broken.wgsl = text.to_owned();
                let shader = specialised(&broken, "shade", &constants);
                assert!(shader.is_err() || shader.is_ok_and(|shader| shader.wgsl.lines().count() <= lines));
            }
        }
    }

    #[test]
    fn every_kernel_has_the_bindings_that_compilers_see() {
        for kernel in kernels() {
            let composed = Library::Embedded.compose(kernel.pass).unwrap();
            let declares = |name: &str| composed.declares(name);
            let shared: Vec<_> = SHARED_CONSTANTS.iter().copied().filter(|(name, _)| declares(name)).collect();
            let entries = kernel.entries.names();
            for constants in kernel.specialisations(declares) {
                let constants: Vec<_> = constants.into_iter().chain(shared.iter().copied()).collect();
                for entry in &entries {
                    let shader = specialised(&composed, entry, &constants).unwrap();
                    let numbers = |list: Vec<u32>| list.into_iter().collect::<BTreeSet<_>>();
                    let (own, seen) = (numbers(shader.bindings), numbers(used(&shader.wgsl)));
                    assert_eq!(own, seen, "{entry} of {} with {constants:?}", kernel.pass);
                }
            }
        }
    }
}
