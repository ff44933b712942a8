//! Lessons: files of a teacher, and the scenes of their steps.

use std::path::{Path, PathBuf};

use super::{LoadError, LoadedScene, load_scene, load_scene_with, read_text};
use crate::scene::{lesson::Lesson, preset_toml};

/// What a file of TOML holds.
pub enum Opened {
    /// A scene, with what it names.
    Scene(Box<LoadedScene>),
    /// A lesson, and the folder that paths in it start from.
    Lesson(Box<Lesson>, PathBuf),
}

/// Loads a preset by its name, or a scene or a lesson by its path.
///
/// # Errors
///
/// As [`load_scene`] and [`Lesson::from_toml`].
pub fn open(name: &str) -> Result<Opened, LoadError> {
    let path = Path::new(name);
    let text = if preset_toml(name).is_none() { read_text(path).ok() } else { None };
    match text.filter(|text| Lesson::is_lesson(text)) {
        Some(text) => {
            let folder = path.parent().map(Path::to_owned).unwrap_or_default();
            Ok(Opened::Lesson(Lesson::from_toml(&text, name)?.into(), folder))
        }
        None => Ok(Opened::Scene(load_scene(name)?.into())),
    }
}

/// Loads the scene that a step of a lesson shows; none if no step until then names one.
///
/// # Errors
///
/// As [`load_scene_with`].
pub fn load_step(lesson: &Lesson, folder: &Path, step: usize) -> Result<Option<LoadedScene>, LoadError> {
    let Some(step) = lesson.staged_by(step).map(|index| &lesson.steps[index]) else { return Ok(None) };
    let name = if preset_toml(&step.scene).is_some() { PathBuf::from(&step.scene) } else { folder.join(&step.scene) };
    Ok(Some(load_scene_with(name, &step.settings()?)?))
}
