//! What the window exports: the dialog as it is filled in, and the work that waits, runs and can be stopped.

mod form;
mod queue;

pub use form::{Form, Kind, SequenceFormat};
#[cfg(test)]
pub use queue::State;
pub use queue::{Entry, Watch};

use std::{path::Path, sync::Arc};

use super::{model::Model, request::Request, system};
use crate::{
    export::Job,
    input::LoadedScene,
    scene::{Scene, SceneSource},
};

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

/// A scene as a window has it now, for work that goes on while it is edited.
pub fn snapshot(model: &Model) -> LoadedScene {
    let scene = Scene::clone(&model.scene);
    LoadedScene {
        // What is refused is told with its place in the file that this scene would be saved to.
        source: SceneSource::new(&model.name, &scene.to_toml(), &[]),
        scene,
        name: model.name.clone(),
        folder: model.folder.clone(),
        resources: model.resources.clone(),
        notes: Vec::new(),
    }
}

/// Opens the dialog for a scene, with a place for its file where there is none yet.
pub fn open_dialog(model: &mut Model, size: [u32; 2]) {
    let stem = Path::new(&model.name).file_stem().and_then(|stem| stem.to_str()).unwrap_or("soapfilm");
    let end_s = (model.last_tick().max(60) as f64) * model.scene.motion.tick_s;
    model.exports.form.open(&system::whole_path(&model.folder.join(stem)), size, end_s);
}

/// An export has ended: what came of it is told, and the window closes if it was waited for.
pub fn ended(model: &mut Model, id: u64, result: Result<(), String>) {
    match model.exports.end(id, result) {
        Some(Ok(text)) => model.messages.note(text),
        Some(Err(text)) => {
            // Who waits for all of them must read this.
            model.exports.then_quits = false;
            model.messages.problem(text);
        }
        None => {}
    }
    if model.exports.then_quits && !model.exports.are_wanted() {
        model.ask_for(Request::Quit);
    }
}

#[cfg(test)]
mod tests;
