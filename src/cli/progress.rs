//! A bar on the terminal while something takes long.

use std::{
    io::{IsTerminal, Write},
    sync::atomic::{AtomicUsize, Ordering},
};

/// Characters of the bar.
const WIDTH: usize = 40;

/// A bar on stderr that is gone once the work is done; nothing where stderr is no terminal.
pub struct Progress {
    name: &'static str,
    total: usize,
    done: AtomicUsize,
    shown: bool,
}

impl Progress {
    /// A bar for so many steps.
    pub fn new(name: &'static str, total: usize) -> Self {
        Self { name, total, done: AtomicUsize::new(0), shown: std::io::stderr().is_terminal() }
    }

    /// One step more is done; from any thread.
    pub fn step(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        // A bar that cannot be written is no reason to stop the work.
        if self.shown {
            let _ = write!(std::io::stderr(), "\r{}", bar(self.name, done, self.total));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown {
            let _ = write!(std::io::stderr(), "\r{:width$}\r", "", width = bar(self.name, 0, 1).chars().count());
        }
    }
}

fn bar(name: &str, done: usize, total: usize) -> String {
    let part = done.min(total) as f64 / total.max(1) as f64;
    let filled = (part * WIDTH as f64) as usize;
    format!("{name} [{}{}] {:3.0} %", "#".repeat(filled), " ".repeat(WIDTH - filled), 100.0 * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_grow_and_keep_their_width() {
        let widths: Vec<usize> = (0..=7).map(|done| bar("x", done, 7).len()).collect();
        assert!(widths.iter().all(|width| *width == widths[0]));
        assert!(bar("x", 7, 7).contains(&"#".repeat(WIDTH)) && bar("x", 0, 7).contains("  0 %"));
        assert_eq!(bar("x", 9, 7), bar("x", 7, 7));
        assert!(bar("x", 0, 0).contains("0 %"));
    }
}
