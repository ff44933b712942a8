//! What panels and dialogs ask of the window: files that are opened and saved.

use std::path::{Path, PathBuf};

use winit::event_loop::ActiveEventLoop;

use super::Handler;
use crate::{
    app::{
        files::Arrival,
        request::{Question, Request, Target},
        system,
    },
    scene::{Environment, Light, lesson::lesson},
};

impl Handler {
    pub(super) fn serve(&mut self, event_loop: &ActiveEventLoop, request: Request) {
        let Some(view) = &self.view else { return };
        match request {
            Request::Ask(target) => self.files.ask(target, &self.model, &view.window),
            Request::LoadScene(name) => self.files.load_scene(&mut self.model, name),
            Request::BeginLesson(name) => {
                lesson(&name).into_iter().for_each(|lesson| self.model.begin_lesson(lesson, PathBuf::new()));
            }
            Request::LoadStep => self.files.load_step(&mut self.model),
            Request::LoadLight(light) => self.files.load_light(&mut self.model, light),
            #[cfg(target_arch = "wasm32")]
            Request::CopyLink => self.files.copy_link(&self.model),
            #[cfg(not(target_arch = "wasm32"))]
            Request::Export => self.model.open_export(view.picture_size),
            Request::Save => self.model.file.iter().for_each(|file| self.files.save_scene(file.clone(), &self.model)),
            Request::Typed(target, text) => self.typed(target, text),
            Request::Left(fate) => {
                if let Some(work) = self.keeper.decide(fate) {
                    self.files.take_up(&mut self.model, work);
                }
            }
            Request::Quit => system::end(event_loop),
        }
        self.ask_for_redraw();
    }

    pub(super) fn arrive(&mut self) {
        for arrival in self.files.collect(&mut self.model) {
            match arrival {
                Arrival::Scene => {
                    let path =
                        self.model.file.as_ref().filter(|_| system::FILES_LAST).map(|file| system::whole_path(file));
                    path.iter().for_each(|path| self.model.settings.remember(&path.display().to_string()));
                }
                Arrival::TakenUp => self.keeper.taken_up(&mut self.model),
                Arrival::Chosen(target, path) => self.chosen(target, path),
            }
        }
        self.ask_for_redraw();
    }

    fn chosen(&mut self, target: Target, path: PathBuf) {
        let Some(view) = &mut self.view else { return };
        match target {
            Target::SaveScene => self.files.save_scene(with_ending(path, "toml"), &self.model),
            Target::SavePng => view.capture(&mut self.model, false, with_ending(path, "png")),
            Target::SaveExr => view.capture(&mut self.model, true, with_ending(path, "exr")),
            Target::SaveProfile => {
                let csv = self.model.overlay.profile.as_ref().map(|profile| profile.csv());
                csv.into_iter().for_each(|csv| self.files.save_text(with_ending(path.clone(), "csv"), csv));
            }
            Target::SaveProfilePlot => view.capture_profile(&self.model, with_ending(path, "png")),
            Target::SavePlot(plot) => view.capture_plot(&self.model, plot, with_ending(path, "png")),
            Target::SaveCsv(plot) => {
                let csv = self.model.probe.pinned.as_ref().map(|pin| pin.csv(plot));
                csv.into_iter().for_each(|csv| self.files.save_text(with_ending(path.clone(), "csv"), csv));
            }
            Target::OpenScene | Target::OpenEnvironment => self.open_file(&path),
            Target::OpenIlluminant => {
                let Some(illuminant) = self.name_of(&path) else { return };
                let light = Light { illuminant, spectrum: None, ..self.model.scene.light.clone() };
                self.files.load_light(&mut self.model, light);
            }
            Target::OpenPlate => {
                let Some(plate) = self.name_of(&path) else { return };
                self.files.load_plate(&mut self.model, plate);
            }
            #[cfg(not(target_arch = "wasm32"))]
            Target::Export(ending) => {
                let path = ending.map_or(path.clone(), |ending| with_ending(path, ending));
                self.model.exports.form.path = path.display().to_string();
            }
            #[cfg(target_arch = "wasm32")]
            Target::Export(_) => {}
        }
    }

    /// Takes a typed path; one that would replace a file must be typed twice, as the dialogs of systems ask too.
    fn typed(&mut self, target: Target, text: String) {
        let path = from_home(&text);
        let path = target.file_type().1.first().map_or(path.clone(), |ending| with_ending(path, ending));
        let replaces = format!("{} is there already; Enter replaces it", path.display());
        let folder = system::whole_path(&path).parent().map_or_else(PathBuf::new, Path::to_owned);
        let wrong = match (target.is_read(), path.exists(), self.model.question.take()) {
            (true, false, _) => format!("there is no file {}", path.display()),
            (false, ..) if !folder.is_dir() => format!("there is no folder {}", folder.display()),
            (false, true, Some(Question::Path(_, _, wrong))) if wrong.as_ref() != Some(&replaces) => replaces,
            _ => return self.chosen(target, path),
        };
        self.model.question = Some(Question::Path(target, text, Some(wrong)));
    }

    /// A file as a scene names it: by its path from the root. One that scenes cannot name is told.
    fn name_of(&mut self, path: &Path) -> Option<String> {
        let name = system::whole_path(path).to_str().map(str::to_owned);
        if name.is_none() {
            self.model.messages.problem(format!("{}: this file name is not UTF-8; rename it", path.display()));
        }
        name
    }

    /// Opens a file that was chosen or dropped, by its ending.
    pub fn open_file(&mut self, path: &Path) {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("").to_ascii_lowercase();
        let Some(name) = self.name_of(path) else { return };
        match ending.as_str() {
            "toml" => self.model.ask_for(Request::LoadScene(name)),
            "exr" | "hdr" => {
                let light =
                    Light { environment: Environment::File(name), constant: None, ..self.model.scene.light.clone() };
                self.files.load_light(&mut self.model, light);
            }
            _ => self
                .model
                .messages
                .problem(format!("{}: open a scene (.toml) or an environment (.exr, .hdr)", path.display())),
        }
    }
}

/// A path as people type it, where `~` stands for their home.
fn from_home(text: &str) -> PathBuf {
    let text = text.trim();
    let in_home = text.strip_prefix("~/").and_then(|rest| Some(std::env::home_dir()?.join(rest)));
    in_home.unwrap_or_else(|| PathBuf::from(text))
}

/// A path that ends as its kind of file does, where the user gave no ending.
fn with_ending(path: PathBuf, ending: &str) -> PathBuf {
    if path.extension().is_some() { path } else { path.with_extension(ending) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_without_ending_gets_one() {
        assert_eq!(with_ending("a/b".into(), "png"), PathBuf::from("a/b.png"));
        assert_eq!(with_ending("a/b.PNG".into(), "png"), PathBuf::from("a/b.PNG"));
    }
}
