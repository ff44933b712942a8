//! The messages of the window: notes that disappear by themselves, and remarks and problems that stay until they are dismissed.

/// How long a note stays, s.
const NOTE_S: f64 = 4.0;

/// How serious a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Something was done.
    Note,
    /// Something to know.
    Remark,
    /// Something could not be done.
    Problem,
}

/// One line for people.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The line.
    pub text: String,
    /// How serious it is.
    pub kind: Kind,
    /// When it disappears, in seconds of the window's clock; `None` until it was first shown.
    until_s: Option<f64>,
}

/// The messages on show, oldest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Messages(Vec<Message>);

impl Messages {
    /// Says that something was done.
    pub fn note(&mut self, text: impl Into<String>) {
        self.push(text.into(), Kind::Note);
    }

    /// Says what a user should know, such as how a file was read.
    pub fn remark(&mut self, text: impl Into<String>) {
        self.push(text.into(), Kind::Remark);
    }

    /// Reports that something failed. A message that is already shown is not repeated.
    pub fn problem(&mut self, text: impl Into<String>) {
        self.push(text.into(), Kind::Problem);
    }

    fn push(&mut self, text: String, kind: Kind) {
        let text = plain(&text);
        if !self.0.iter().any(|known| known.text == text) {
            self.0.push(Message { text, kind, until_s: None });
        }
    }

    /// The messages to show at a time; notes whose time is over are gone.
    pub fn at(&mut self, now_s: f64) -> &[Message] {
        for message in self.0.iter_mut().filter(|message| message.kind == Kind::Note) {
            message.until_s.get_or_insert(now_s + NOTE_S);
        }
        self.0.retain(|message| message.until_s.is_none_or(|until_s| now_s < until_s));
        &self.0
    }

    /// Seconds until the next note goes.
    #[must_use]
    pub fn next_change_s(&self, now_s: f64) -> Option<f64> {
        self.0.iter().filter_map(|message| message.until_s).map(|until_s| until_s - now_s).reduce(f64::min)
    }

    /// Takes one message away.
    pub fn dismiss(&mut self, index: usize) {
        if index < self.0.len() {
            self.0.remove(index);
        }
    }

    /// Removes messages with this beginning, because they no longer apply.
    pub fn withdraw(&mut self, beginning: &str) {
        self.0.retain(|message| !message.text.starts_with(beginning));
    }

    /// Removes all messages, and returns whether there were any.
    pub fn clear(&mut self) -> bool {
        !std::mem::take(&mut self.0).is_empty()
    }
}

/// One line without the frames that compilers draw around code, which have no letters here.
fn plain(text: &str) -> String {
    let is_frame = |character: char| ('\u{2500}'..='\u{257f}').contains(&character);
    text.split(|character: char| character.is_whitespace() || is_frame(character))
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_plain_lines_and_can_be_withdrawn() {
        let mut messages = Messages::default();
        messages.problem("shader a.wgsl:1: found \"{\"\n ┌─ wgsl:60:12\n │ fn");
        assert_eq!(messages.at(0.0)[0].text, "shader a.wgsl:1: found \"{\" wgsl:60:12 fn");
        messages.note("saved");
        messages.withdraw("shader ");
        assert_eq!(messages.at(0.0).len(), 1);
    }

    #[test]
    fn notes_go_and_problems_stay() {
        let mut messages = Messages::default();
        messages.note("saved");
        messages.remark("layer `beauty`");
        messages.problem("failed");
        assert_eq!(messages.at(10.0).len(), 3);
        assert_eq!(messages.next_change_s(10.0), Some(NOTE_S));
        let left = messages.at(10.0 + NOTE_S);
        assert_eq!(left.iter().map(|message| message.text.as_str()).collect::<Vec<_>>(), ["layer `beauty`", "failed"]);
        messages.dismiss(7);
        messages.dismiss(1);
        messages.dismiss(0);
        assert!(!messages.clear());
    }

    #[test]
    fn nothing_is_said_twice_at_a_time() {
        let mut messages = Messages::default();
        messages.problem("failed");
        messages.problem("failed");
        assert_eq!(messages.at(0.0).len(), 1);
    }
}
