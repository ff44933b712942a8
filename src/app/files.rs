//! Work that takes long, on threads of its own, so that the window never freezes: dialogs, loading, saving.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, Sender, channel},
    },
};

use super::{
    compare::{Map, Pixels, Side, Want},
    model::Model,
    reference,
    request::{Question, Target},
    storage::Unsaved,
    system,
};
use crate::{
    input::{
        LoadError, LoadedScene, Opened, light_of_scene, load_environment, load_illuminant_of, load_step, open,
        read_plate,
    },
    output::{Metadata, Picture, write_text},
    physics::picture::Plate,
    plan::{Resources, TonemapKey},
    scene::{Light, Scene, SceneSource, lesson::Lesson},
    verify::reference::MovedFilms,
};

/// What came of a piece of work.
enum Outcome {
    Scene(Box<LoadedScene>),
    Lesson(Box<Lesson>, PathBuf),
    Step(Box<LoadedScene>),
    Light(Box<Light>, Resources, Vec<String>),
    Plate(String, Arc<Plate>, Vec<String>),
    TakenUp(Box<LoadedScene>, Box<Unsaved>),
    Chosen(Target, PathBuf),
    NoDialog(Target),
    Saved(PathBuf, u64),
    Map(Map),
    Reference(Side, Pixels, f32, Arc<AtomicBool>),
    Done(String),
    #[cfg(not(target_arch = "wasm32"))]
    Exported(u64, Result<(), String>),
    Failed(String),
    NotSaved(String),
    #[cfg(target_arch = "wasm32")]
    NotCopied(String),
    NotChosen,
    Nothing,
}

/// Results of dialogs and workers that the window must handle.
#[derive(Debug, PartialEq)]
pub enum Arrival {
    /// Another scene is in the model.
    Scene,
    /// What an earlier window left is in the model.
    TakenUp,
    /// A file was chosen.
    Chosen(Target, PathBuf),
}

/// The workers.
pub struct Files {
    wake: Arc<dyn Fn() + Send + Sync>,
    sender: Sender<(u64, Outcome)>,
    receiver: Receiver<(u64, Outcome)>,
    /// The latest load; results of older loads are dropped.
    load: u64,
}

impl Files {
    /// No work yet. `wake` is called from other threads whenever something has arrived.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, receiver) = channel();
        Self { wake: Arc::new(wake), sender, receiver, load: 0 }
    }

    /// Loads a scene or a lesson by its path, or a preset by its name.
    pub fn load_scene(&mut self, model: &mut Model, name: String) {
        self.begin_load(model, &name);
        let named = name.clone();
        self.run_lit(
            move || light_of_scene(&named).ok(),
            move || match open(&name) {
                Ok(Opened::Scene(scene)) => Outcome::Scene(scene),
                Ok(Opened::Lesson(lesson, folder)) => Outcome::Lesson(lesson, folder),
                Err(error) => Outcome::Failed(error.to_string()),
            },
        );
    }

    /// Loads the scene of the step that the lesson is at.
    pub fn load_step(&mut self, model: &mut Model) {
        let Some(course) = model.course.clone() else { return };
        self.begin_load(model, "the scene of this step");
        self.run(move || match load_step(&course.lesson, &course.folder, course.step) {
            Ok(scene) => scene.map_or(Outcome::Nothing, |scene| Outcome::Step(scene.into())),
            Err(error) => Outcome::Failed(error.to_string()),
        });
    }

    /// Loads what work names that an earlier window left.
    pub fn take_up(&mut self, model: &mut Model, work: Unsaved) {
        self.begin_load(model, &work.name);
        let (source, folder) = (SceneSource::new(&work.name, &work.scene, &[]), work.folder.clone());
        self.run_lit(
            move || Some((source.read().ok()?.light, folder)),
            move || match LoadedScene::from_toml(&work.scene, &work.name, &work.folder) {
                Ok(loaded) => Outcome::TakenUp(loaded.into(), work.into()),
                Err(error) => Outcome::Failed(error.to_string()),
            },
        );
    }

    /// Loads the environment and illuminant that a light names; they and the light arrive together.
    pub fn load_light(&mut self, model: &mut Model, light: Light) {
        self.begin_load(model, "the light");
        let folder = model.folder.clone();
        let known = &model.scene.light;
        // The colours of lamps of a temperature are relative to the illuminant.
        let whites = (&known.illuminant, &known.spectrum) == (&light.illuminant, &light.spectrum)
            || light.lamps.iter().all(|lamp| lamp.kelvin.is_none());
        let same = whites
            && (&known.environment, known.constant, &known.patches, &known.lamps)
                == (&light.environment, light.constant, &light.patches, &light.lamps);
        let resources = model.resources.clone();
        let named = (light.clone(), folder.clone());
        self.run_lit(
            move || (!same).then_some(named),
            move || match load_light(&light, &folder, same, resources) {
                Ok((resources, notes)) => Outcome::Light(Box::new(light), resources, notes),
                Err(error) => Outcome::Failed(error.to_string()),
            },
        );
    }

    /// Loads a photograph that is to stand behind the bubbles.
    pub fn load_plate(&mut self, model: &mut Model, path: String) {
        self.begin_load(model, "the plate");
        let file = model.folder.join(&path);
        self.run(move || {
            let mut notes = Vec::new();
            match read_plate(&file, &mut notes) {
                Ok(plate) => Outcome::Plate(path, Arc::new(plate), notes),
                Err(error) => Outcome::Failed(error.to_string()),
            }
        });
    }

    fn begin_load(&mut self, model: &mut Model, what: &str) {
        self.load += 1;
        model.loading = Some(what.to_owned());
    }

    /// Saves the scene as it is now. Relative paths in it still name the files that they do.
    pub fn save_scene(&self, path: PathBuf, model: &Model) {
        let (scene, folder, state) = (Scene::clone(&model.scene), model.folder.clone(), model.undo.state());
        self.run(move || {
            let saved = moved(scene, &folder, path.parent().unwrap_or(Path::new("")));
            let written =
                saved.and_then(|scene| write_text(&path, &scene.to_toml()).map_err(|error| error.to_string()));
            written.map_or_else(Outcome::NotSaved, |()| Outcome::Saved(path, state))
        });
    }

    /// Keeps a picture, or finds out how far it is from the one that is kept.
    pub fn compare(&self, model: &mut Model, want: Want, shown: Pixels) {
        let name =
            |quality: &str| format!("{} at {:.2} s, {quality}", model.name, model.clock.time_s(&model.scene.motion));
        match (want, model.compare.kept().cloned()) {
            (Want::Map, Some((kept, _))) if kept.size == shown.size => {
                self.run(move || Outcome::Map(Map::new(&kept, &shown)));
            }
            (Want::Map, Some(_)) => model.messages.note("A has another size than the picture has now: keep it again"),
            (Want::Draw(side, quality), Some(_)) => model.compare.put(side, shown, name(quality.name())),
            _ => model.compare.keep(shown, name(model.scene.view.quality.name())),
        }
    }

    /// Computes the reference picture of what is shown, with films as the device has moved them.
    pub fn compute_reference(&self, model: &mut Model, side: Side, key: TonemapKey, films: MovedFilms) {
        let (stop, tell, size) = (model.compare.begin_reference(), self.teller(), key.draw.size);
        self.run(move || {
            let told = reference::paint(&key, &films, |progress| {
                let pixels = Pixels { size, rgba: Arc::new(progress.rgba) };
                tell(Outcome::Reference(side, pixels, progress.done, stop.clone()));
                !stop.load(Ordering::Relaxed)
            });
            told.map_or_else(|error| Outcome::Failed(error.to_string()), |()| Outcome::Nothing)
        });
    }

    /// Saves a text.
    pub fn save_text(&self, path: PathBuf, text: String) {
        self.run(move || match write_text(&path, &text) {
            Ok(()) => Outcome::Done(format!("Saved {}", path.display())),
            Err(error) => Outcome::Failed(error.to_string()),
        });
    }

    /// Saves a picture.
    pub fn save_picture(&self, path: PathBuf, metadata: Metadata, picture: impl FnOnce() -> Picture + Send + 'static) {
        self.run(move || match picture().save(&path, &metadata) {
            Ok(()) => Outcome::Done(format!("Saved {}", path.display())),
            Err(error) => Outcome::Failed(error.to_string()),
        });
    }

    /// Makes an export; what came of it arrives with its number.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn export(&self, id: u64, work: impl FnOnce() -> Result<(), String> + Send + 'static) {
        self.run_or(move || Outcome::Exported(id, work()), move |fault| Outcome::Exported(id, Err(fault)));
    }

    /// Copies a link that shows the scene.
    #[cfg(target_arch = "wasm32")]
    pub fn copy_link(&self, model: &Model) {
        let tell = self.teller();
        system::copy_link(&model.scene.to_toml(), move |copied| {
            tell(match copied {
                Ok(()) => Outcome::Done("The link is on the clipboard".to_owned()),
                Err(text) => Outcome::NotCopied(text),
            });
        });
    }

    /// Asks for a file.
    pub fn ask(&self, target: Target, model: &Model, window: &winit::window::Window) {
        let (tell, name) = (self.teller(), target.file_name(&model.name));
        system::choose_file(target, &model.folder, name, window, move |answer| {
            tell(match answer {
                Ok(Some(path)) => Outcome::Chosen(target, path),
                Ok(None) => Outcome::NotChosen,
                Err(system::NoDialog) => Outcome::NoDialog(target),
            });
        });
    }

    /// Tells the window of an outcome, from any thread.
    fn teller(&self) -> impl Fn(Outcome) + Clone + Send + 'static {
        let (wake, sender, load) = (self.wake.clone(), self.sender.clone(), self.load);
        move |outcome| {
            // Nobody listens any more once the window is gone.
            let _ = sender.send((load, outcome));
            wake();
        }
    }

    fn run(&self, work: impl FnOnce() -> Outcome + Send + 'static) {
        self.run_or(work, Outcome::Failed);
    }

    /// Runs a piece of work on a thread of its own, or tells why it could not be done.
    fn run_or(
        &self,
        work: impl FnOnce() -> Outcome + Send + 'static,
        failed: impl FnOnce(String) -> Outcome + Clone + Send + 'static,
    ) {
        self.told(system::spawn(self.job(work, failed.clone())), failed);
    }

    /// Runs work that loads the environment of a light, whose paths start from a folder; where there is no light, the work says why.
    fn run_lit(
        &self,
        light: impl FnOnce() -> Option<(Light, PathBuf)> + Send + 'static,
        work: impl FnOnce() -> Outcome + Send + 'static,
    ) {
        self.told(system::spawn_lit(light, self.job(work, Outcome::Failed)), Outcome::Failed);
    }

    fn job(
        &self,
        work: impl FnOnce() -> Outcome + Send + 'static,
        failed: impl FnOnce(String) -> Outcome + Send + 'static,
    ) -> impl FnOnce() + Send + 'static {
        let tell = self.teller();
        move || {
            let broken = |_| failed("an internal error stopped the work: please report it".to_owned());
            tell(catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(broken));
        }
    }

    fn told(&self, begun: std::io::Result<()>, failed: impl FnOnce(String) -> Outcome) {
        if let Err(error) = begun {
            self.teller()(failed(format!("no thread could be started: {error}")));
        }
    }

    /// Puts what has arrived into the model, and returns what the window must see to.
    pub fn collect(&self, model: &mut Model) -> Vec<Arrival> {
        let arrived: Vec<_> = self.receiver.try_iter().collect();
        arrived.into_iter().filter_map(|(load, outcome)| self.accept(model, load == self.load, outcome)).collect()
    }

    fn accept(&self, model: &mut Model, current: bool, outcome: Outcome) -> Option<Arrival> {
        match outcome {
            Outcome::Scene(loaded) if current => {
                model.adopt(*loaded);
                return Some(Arrival::Scene);
            }
            Outcome::Lesson(lesson, folder) if current => {
                model.loading = None;
                model.begin_lesson(*lesson, folder);
            }
            Outcome::Step(loaded) if current => model.stage_step(*loaded),
            Outcome::Light(light, resources, notes) if current => {
                model.adopt_light(*light, resources);
                notes.into_iter().for_each(|note| model.messages.remark(note));
            }
            Outcome::Plate(path, plate, notes) if current => {
                model.adopt_plate(path, plate);
                notes.into_iter().for_each(|note| model.messages.remark(note));
            }
            Outcome::TakenUp(loaded, work) if current => {
                model.take_up(*loaded, *work);
                return Some(Arrival::TakenUp);
            }
            Outcome::Chosen(target, path) => return Some(Arrival::Chosen(target, path)),
            Outcome::NoDialog(target) => model.question = Some(Question::path(target, &model.name, &model.folder)),
            Outcome::Saved(path, state) => model.saved(path, state),
            Outcome::NotSaved(text) => {
                model.messages.problem(text);
                model.once_saved = None;
            }
            Outcome::Reference(side, pixels, done, of) => {
                // One that was stopped still tells what it had begun.
                if Arc::ptr_eq(&of, &model.compare.stop) && model.compare.kept().is_some() {
                    model.compare.put(side, pixels, format!("{}, reference (f64)", model.name));
                    model.compare.done = Some(done).filter(|done| *done < 1.0 && !of.load(Ordering::Relaxed));
                }
            }
            Outcome::Map(map) => model.compare.map = model.compare.kept().map(|_| map),
            Outcome::Done(text) => model.messages.note(text),
            #[cfg(not(target_arch = "wasm32"))]
            Outcome::Exported(id, result) => model.export_ended(id, result),
            Outcome::Failed(text) => {
                model.messages.problem(text);
                model.loading = model.loading.take().filter(|_| !current);
                model.once_saved = None;
            }
            #[cfg(target_arch = "wasm32")]
            Outcome::NotCopied(text) => model.messages.problem(text),
            Outcome::NotChosen => model.once_saved = None,
            Outcome::Nothing
            | Outcome::Scene(_)
            | Outcome::Lesson(..)
            | Outcome::Step(_)
            | Outcome::TakenUp(..)
            | Outcome::Light(..)
            | Outcome::Plate(..) => {}
        }
        None
    }
}

/// A scene whose relative paths start from another folder: they lead from there to the files inside it, and from the root to all others.
fn moved(mut scene: Scene, from: &Path, to: &Path) -> Result<Scene, String> {
    let current = PathBuf::from(".");
    let [from, to] = [from, to].map(|folder| if folder.as_os_str().is_empty() { &current } else { folder });
    let [from, to] = [from, to].map(system::whole_path);
    if from == to {
        return Ok(scene);
    }
    for path in scene.paths_mut().filter(|path| Path::new(path).is_relative()) {
        let whole = from.join(&*path);
        let named = whole.strip_prefix(&to).unwrap_or(&whole).to_str();
        *path = named
            .ok_or_else(|| format!("{}: its name is not UTF-8, so that no scene can name it", whole.display()))?
            .to_owned();
    }
    Ok(scene)
}

/// What a scene names, with another light, and notes about its files; its environment and lamps are loaded only if they are not known.
fn load_light(
    light: &Light,
    folder: &Path,
    known: bool,
    resources: Resources,
) -> Result<(Resources, Vec<String>), LoadError> {
    let mut notes = Vec::new();
    let illuminant = Arc::new(load_illuminant_of(light, folder, &mut notes)?);
    if known {
        return Ok((Resources { illuminant, ..resources }, notes));
    }
    let (environment, spectral_lights) = load_environment(light, folder, &mut notes)?;
    Ok((Resources { environment, illuminant, spectral_lights, ..resources }, notes))
}

#[cfg(test)]
mod tests;
