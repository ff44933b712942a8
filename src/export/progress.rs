//! How far long work has come, for whoever watches it.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

/// Who watches long work: a bar on the terminal, or the window. Called from any thread.
pub trait Observer: Send + Sync {
    /// Whether anybody looks. Otherwise nothing is told within the parts of the work, which makes it faster.
    fn is_watching(&self) -> bool;

    /// A part of the work from 0 to 1 is done.
    fn hear(&self, done: f64);

    /// Whether the work is no longer wanted.
    fn has_cancelled(&self) -> bool {
        false
    }

    /// The work has ended.
    fn end(&self) {}
}

/// The work was stopped by who asked for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// Work in parts, which all take about as long.
pub struct Progress {
    observer: Arc<dyn Observer>,
    parts: u64,
    parts_begun: AtomicU64,
}

impl Progress {
    /// Nothing of `parts` parts is done yet.
    pub fn new(parts: u64, observer: Arc<dyn Observer>) -> Self {
        Self { observer, parts: parts.max(1), parts_begun: AtomicU64::new(0) }
    }

    /// Whether anybody looks.
    pub fn is_watched(&self) -> bool {
        self.observer.is_watching()
    }

    /// Whether the work shall go on.
    ///
    /// # Errors
    /// It is no longer wanted.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.observer.has_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Begins the next part, which takes `units` units of work.
    pub fn part(&self, units: u64) -> Part {
        self.parts(1, units)
    }

    /// Begins work that takes as long as `parts` parts and is done in `units` units.
    pub fn parts(&self, parts: u64, units: u64) -> Part {
        let begun = self.parts_begun.fetch_add(parts, Ordering::Relaxed);
        let part = Part {
            observer: self.observer.clone(),
            start: begun as f64 / self.parts as f64,
            length: parts as f64 / self.parts as f64,
            units,
            done: AtomicU64::new(0),
        };
        part.observer.hear(part.start.min(1.0));
        part
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.observer.end();
    }
}

/// A part of the work.
pub struct Part {
    observer: Arc<dyn Observer>,
    start: f64,
    length: f64,
    units: u64,
    done: AtomicU64,
}

impl Part {
    /// Adds a number of finished units; from any thread.
    pub fn add(&self, units: u64) {
        let done = self.done.fetch_add(units, Ordering::Relaxed).saturating_add(units);
        let part = done.min(self.units) as f64 / self.units.max(1) as f64;
        self.observer.hear((self.start + part * self.length).min(1.0));
    }

    /// Whether the work shall go on.
    pub fn is_wanted(&self) -> bool {
        !self.observer.has_cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hears in thousandths, and cancels at a number.
    #[derive(Default)]
    struct Ear {
        heard: AtomicU64,
        end: AtomicU64,
    }

    impl Observer for Ear {
        fn is_watching(&self) -> bool {
            true
        }

        fn hear(&self, done: f64) {
            self.heard.store((1000.0 * done).round() as u64, Ordering::Relaxed);
        }

        fn has_cancelled(&self) -> bool {
            self.heard.load(Ordering::Relaxed) > 900
        }

        fn end(&self) {
            self.end.fetch_add(1, Ordering::Relaxed);
        }
    }

    #[test]
    fn parts_follow_each_other_and_end_where_the_next_begins() {
        let ear = Arc::new(Ear::default());
        let progress = Progress::new(8, ear.clone());
        let at = || ear.heard.load(Ordering::Relaxed);
        let part = progress.part(8);
        assert_eq!(at(), 0);
        part.add(2);
        assert_eq!(at(), 31);
        part.add(100);
        assert_eq!(at(), 125, "a part never takes more than its place");
        progress.part(1).add(1);
        assert_eq!(at(), 250);
        progress.part(0).add(1);
        assert_eq!(at(), 250, "a part without work has no length");
        progress.parts(4, 8).add(4);
        assert_eq!((at(), progress.check()), (625, Ok(())));
        let last = progress.part(3);
        assert!(last.is_wanted());
        last.add(3);
        assert!(!last.is_wanted(), "the observer has had enough");
        assert_eq!(progress.check(), Err(Cancelled));
        drop(progress);
        assert_eq!(ear.end.load(Ordering::Relaxed), 1);
    }
}
