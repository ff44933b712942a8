//! The words, numbers and marks of a shader's text.

/// A word, a number or a mark of the language, and where it stands.
#[derive(Clone, Copy)]
pub struct Token<'a> {
    pub text: &'a str,
    pub start: usize,
}

impl Token<'_> {
    pub fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// All of them, without comments. Text that is being written may be anything: what is asked for beyond the last one is empty.
pub struct Tokens<'a>(pub Vec<Token<'a>>);

impl<'a> Tokens<'a> {
    /// Those of a text.
    pub fn new(wgsl: &'a str) -> Self {
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
        Self(tokens)
    }

    pub fn text(&self, at: usize) -> &'a str {
        self.0.get(at).map_or("", |token| token.text)
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The next opening brace.
    pub fn open(&self, at: usize) -> usize {
        (at..self.len()).find(|at| self.text(*at) == "{").unwrap_or(at)
    }

    /// The closing brace of an opening one.
    pub fn close(&self, open: usize) -> usize {
        let mut depth = 0;
        let closes = |at: &usize| {
            match self.text(*at) {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            depth == 0
        };
        (open..self.len()).find(closes).unwrap_or(self.len() - 1)
    }
}

/// The value of a whole number.
pub fn whole_number(text: &str) -> Option<u32> {
    text.trim_end_matches('u').parse().ok()
}
