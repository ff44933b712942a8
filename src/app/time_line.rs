//! How the time line is used: its length, whether it is played in a loop, and the event that is selected on it.

/// Length at first, s.
const LENGTH_S: f64 = 10.0;

/// What is set of the time line.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeLine {
    /// How far it reaches at least, and where a loop begins again, s.
    pub length_s: f64,
    /// Whether it is played again and again.
    pub loops: bool,
    /// Index of the event that is selected.
    pub selected: Option<usize>,
    /// Where an event is being dragged to: its index and its tick.
    pub dragged: Option<(usize, u64)>,
    /// Ticks that the films were behind when the clock was moved ahead: the whole of the progress that is shown.
    pub jump_ticks: u64,
}

impl Default for TimeLine {
    fn default() -> Self {
        Self { length_s: LENGTH_S, loops: false, selected: None, dragged: None, jump_ticks: 0 }
    }
}
