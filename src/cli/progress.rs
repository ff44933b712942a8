//! How far long work has come: a bar on the terminal.

use std::{fmt, sync::Arc, time::Duration};

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

use crate::export::{Observer, Progress};

const TEMPLATE: &str = "{prefix} [{bar:40}] {percent:>3} %  {left}";
/// Steps of the bar.
const STEPS: u64 = 1 << 30;

/// A bar for work in `parts` parts, which all take about as long. It stands on stderr with the time left, and disappears when the work is done.
pub fn progress(name: &'static str, parts: u64) -> Progress {
    Progress::new(parts, Arc::new(Bar::new(name)))
}

/// A bar on stderr. There is none where stderr is not a terminal. A bar that cannot be drawn never stops the work.
pub struct Bar(ProgressBar);

impl Bar {
    /// A bar with a name before it.
    pub fn new(name: &'static str) -> Self {
        // The default draws on stderr, and draws nothing where stderr is not a terminal.
        let bar = ProgressBar::new(STEPS).with_style(style()).with_prefix(name);
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        Self(bar)
    }

    /// Prints while the bar is out of the way. `print` must not panic: it holds the bar's lock.
    pub fn print<T>(&self, print: impl FnOnce() -> T) -> T {
        self.0.suspend(print)
    }
}

impl Observer for Bar {
    fn is_watching(&self) -> bool {
        !self.0.is_hidden()
    }

    fn hear(&self, done: f64) {
        self.0.set_position((done * STEPS as f64) as u64);
    }

    fn end(&self) {
        self.0.finish_and_clear();
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
    fn a_bar_is_as_long_as_the_work_is_done() {
        let bar = Bar::new("test");
        bar.hear(0.25);
        assert_eq!((bar.0.position(), bar.0.length()), (STEPS / 4, Some(STEPS)));
    }
}
