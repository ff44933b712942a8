//! What the window exports: the dialog as it is filled in, and the work that waits, runs and can be stopped.

mod form;
mod queue;

pub use form::{Form, Kind, SequenceFormat};
#[cfg(test)]
pub use queue::State;
pub use queue::{Entry, Watch};

use std::sync::Arc;

use crate::{export::Job, input::LoadedScene};

/// The dialog, and all exports that have not ended.
#[derive(Default)]
pub struct Exports {
    /// The dialog.
    pub form: Form,
    /// What waits and runs, in the order in which it was asked for.
    pub entries: Vec<Entry>,
    /// Whether the window closes once all of them have ended.
    pub then_quits: bool,
    /// Exports so far.
    count: u64,
}

impl Exports {
    /// Asks for an export of a scene as it is now.
    pub fn add(&mut self, job: Job, scene: LoadedScene) {
        self.count += 1;
        self.entries.push(Entry::new(self.count, job, scene));
    }

    /// Whether the file that the dialog names is there already, or will be: an export would replace it.
    #[must_use]
    pub fn replaces(&self, form: &Form) -> bool {
        form.path().is_ok_and(|path| {
            self.entries.iter().any(|entry| entry.path == path) || (form.ending().is_some() && path.exists())
        })
    }

    /// The next export to be done, unless one is being done: it counts as running from now on.
    pub fn begin_next(&mut self) -> Option<(u64, Job, LoadedScene, Arc<Watch>)> {
        if self.entries.iter().any(Entry::is_running) {
            return None;
        }
        self.entries.first_mut().and_then(Entry::begin)
    }

    /// An export has ended. Returns what is left to tell of it.
    pub fn end(&mut self, id: u64, result: Result<(), String>) -> Option<Result<String, String>> {
        let index = self.entries.iter().position(|entry| entry.id == id)?;
        let entry = self.entries.remove(index);
        let place = entry.path.display();
        match result {
            Ok(()) => Some(Ok(format!("Exported {place}"))),
            // Who cancelled it knows.
            Err(_) if entry.watch.is_cancelled() => None,
            Err(reason) => Some(Err(reason)),
        }
    }

    /// Whether there are exports that nobody has stopped.
    pub fn are_wanted(&self) -> bool {
        self.entries.iter().any(|entry| !entry.watch.is_cancelled())
    }

    /// Stops all exports.
    pub fn cancel_all(&mut self) {
        let ids: Vec<_> = self.entries.iter().map(|entry| entry.id).collect();
        ids.into_iter().for_each(|id| self.cancel(id));
    }

    /// Stops an export: one that runs ends soon, one that waits at once.
    pub fn cancel(&mut self, id: u64) {
        self.entries.iter().filter(|entry| entry.id == id).for_each(|entry| entry.watch.cancel());
        self.entries.retain(|entry| entry.id != id || entry.is_running());
    }
}

#[cfg(test)]
mod tests;
