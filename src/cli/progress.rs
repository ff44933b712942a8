//! How far long work has come: a bar on the terminal.

use std::{
    fmt,
    sync::atomic::{AtomicU64, Ordering},
    time::Duration,
};

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

const TEMPLATE: &str = "{prefix} [{bar:40}] {percent:>3} %  {left}";
/// Steps of the bar for each part of the work.
const PART_STEPS: u64 = 1 << 20;

/// A bar on stderr with the time left, which disappears when the work is done. There is none where stderr is not a terminal. A bar that
/// cannot be drawn never stops the work.
pub struct Progress {
    bar: ProgressBar,
    parts_begun: AtomicU64,
}

impl Progress {
    /// A bar for work in `parts` parts, which all take about as long.
    pub fn new(name: &'static str, parts: u64) -> Self {
        // The default draws on stderr, and draws nothing where stderr is not a terminal.
        let bar = ProgressBar::new(parts.max(1).saturating_mul(PART_STEPS)).with_style(style()).with_prefix(name);
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        Self { bar, parts_begun: AtomicU64::new(0) }
    }

    /// Whether the bar is visible.
    pub fn is_shown(&self) -> bool {
        !self.bar.is_hidden()
    }

    /// Begins the next part, which takes `units` units of work.
    pub fn part(&self, units: u64) -> Part {
        self.parts(1, units)
    }

    /// Begins work that takes as long as `parts` parts and is done in `units` units.
    pub fn parts(&self, parts: u64, units: u64) -> Part {
        let start = self.parts_begun.fetch_add(parts, Ordering::Relaxed).saturating_mul(PART_STEPS);
        self.bar.set_position(start);
        Part { bar: self.bar.clone(), start, parts, units, done: AtomicU64::new(0) }
    }

    /// Prints while the bar is out of the way. `print` must not panic: it holds the bar's lock.
    pub fn print<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A part of the work.
pub struct Part {
    bar: ProgressBar,
    start: u64,
    parts: u64,
    units: u64,
    done: AtomicU64,
}

impl Part {
    /// Adds a number of finished units; from any thread.
    pub fn add(&self, units: u64) {
        let done = self.done.fetch_add(units, Ordering::Relaxed).saturating_add(units);
        let part = done.min(self.units) as f64 / self.units.max(1) as f64;
        self.bar.set_position(self.start + (part * self.parts.saturating_mul(PART_STEPS) as f64) as u64);
    }
}

fn style() -> ProgressStyle {
    // A test holds that the template is right.
    let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
    style.progress_chars("## ").with_key("left", |state: &ProgressState, text: &mut dyn fmt::Write| {
        // What cannot be written is not shown.
        let _ = match state.pos() {
            0 => write!(text, "starting"),
            _ => write!(text, "{} left", HumanDuration(state.eta())),
        };
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_is_right() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
    }

    #[test]
    fn parts_follow_each_other_and_end_where_the_next_begins() {
        let progress = Progress::new("test", 7);
        let at = || progress.bar.position() as f64 / PART_STEPS as f64;
        let part = progress.part(8);
        assert_eq!(at(), 0.0);
        part.add(2);
        assert_eq!(at(), 0.25);
        part.add(100);
        assert_eq!(at(), 1.0, "a part never takes more than its place");
        progress.part(1).add(1);
        assert_eq!(at(), 2.0);
        progress.part(0).add(1);
        assert_eq!(at(), 2.0, "a part without work has no steps");
        progress.parts(4, 8).add(4);
        assert_eq!(at(), 5.0);
        assert_eq!(progress.bar.length(), Some(7 * PART_STEPS));
    }
}
