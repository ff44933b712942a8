//! What the window exports of its scene.

use std::path::Path;

use super::Model;
use crate::{
    app::{request::Request, system},
    input::LoadedScene,
    scene::{Scene, SceneSource},
};

impl Model {
    /// The scene as it is now, for work that goes on while it is edited.
    #[must_use]
    pub fn snapshot(&self) -> LoadedScene {
        let scene = Scene::clone(&self.scene);
        LoadedScene {
            // What is refused is told with its place in the file that this scene would be saved to.
            source: SceneSource::new(&self.name, &scene.to_toml(), &[]),
            scene,
            name: self.name.clone(),
            folder: self.folder.clone(),
            resources: self.resources.clone(),
            notes: Vec::new(),
        }
    }

    /// The scene as it is now, seen from where the window shows it at all times: for a picture of the shown moment.
    #[must_use]
    pub fn view_snapshot(&mut self) -> LoadedScene {
        self.follow_keyframes();
        let mut snapshot = self.snapshot();
        snapshot.scene.camera.keyframes.clear();
        snapshot
    }

    /// Opens the dialog for exports. `size` is that of the picture that the window shows, in pixels.
    pub fn open_export(&mut self, size: [u32; 2]) {
        let stem = Path::new(&self.name).file_stem().and_then(|stem| stem.to_str()).unwrap_or("soapfilm");
        let end_s = (self.last_tick().max(60) as f64) * self.scene.motion.tick_s;
        self.exports.form.open(&system::whole_path(&self.folder.join(stem)), size, end_s);
    }

    /// An export has ended: what came of it is told, and the window closes if it was waited for.
    pub fn export_ended(&mut self, id: u64, result: Result<(), String>) {
        match self.exports.end(id, result) {
            Some(Ok(text)) => self.messages.note(text),
            Some(Err(text)) => {
                // Who waits for all of them must read this.
                self.exports.then_quits = false;
                self.messages.problem(text);
            }
            None => {}
        }
        if self.exports.then_quits && !self.exports.are_wanted() {
            self.ask_for(Request::Quit);
        }
    }
}
