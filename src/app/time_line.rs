//! How the time line is used: its length, whether it is played in a loop, and the mark that is selected on it.

/// Length at first, s.
const LENGTH_S: f64 = 10.0;

/// What a mark on the time line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// An event, by its index.
    Event(usize),
    /// A keyframe of the camera, by its index.
    Keyframe(usize),
}

/// What is set of the time line.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeLine {
    /// How far it reaches at least, and where a loop begins again, s.
    pub length_s: f64,
    /// Whether it is played again and again.
    pub loops: bool,
    /// The mark that is selected.
    pub selected: Option<Mark>,
    /// The mark that is being dragged, and the tick where it would be put.
    pub dragged: Option<(Mark, u64)>,
    /// Ticks that the films were behind when the clock was moved ahead: the whole of the progress that is shown.
    pub jump_ticks: u64,
}

impl Default for TimeLine {
    fn default() -> Self {
        Self { length_s: LENGTH_S, loops: false, selected: None, dragged: None, jump_ticks: 0 }
    }
}
