//! Loads a scene and the files that it names.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{LoadError, load_environment, load_illuminant_of, read_plate, read_table_text, read_text};
use crate::{
    physics::{optics::FilmIndex, picture::Plate},
    plan::{FrameRequest, Resources, Shot, request},
    scene::{
        Fault, FilmIndexName, Light, Scene, SceneError, SceneSource, Setting, is_table, nearest, preset_names,
        preset_toml,
    },
};

/// A scene, where it came from, and what it names.
#[derive(Clone, Debug)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// A preset's name or a file's path, for titles and messages.
    pub name: String,
    /// Folder that relative paths in the scene start from.
    pub folder: PathBuf,
    /// What it names.
    pub resources: Resources,
    /// What a user should know of how the files that it names were read, a line each.
    pub notes: Vec<String>,
    /// What it was read from.
    pub source: SceneSource,
}

impl LoadedScene {
    /// What a shot of it needs.
    ///
    /// # Errors
    ///
    /// As [`request()`], with the place in the scene's text.
    pub fn request(&self, shot: &Shot) -> Result<FrameRequest, SceneError> {
        request(&self.scene, &self.resources, shot).map_err(|fault| self.source.locate(fault))
    }
}

/// Loads a preset by name or a scene file by path, with its environment and light.
///
/// # Errors
///
/// There is no such preset or file, its text is no scene, or it names what cannot be used.
pub fn load_scene(name: impl AsRef<Path>) -> Result<LoadedScene, LoadError> {
    load_scene_with(name, &[])
}

/// Loads a preset or a scene file with settings over its text.
///
/// # Errors
///
/// As [`load_scene`]; a setting at fault is named.
pub fn load_scene_with(name: impl AsRef<Path>, settings: &[Setting]) -> Result<LoadedScene, LoadError> {
    let (source, folder) = source_of(name.as_ref(), settings)?;
    let scene = source.read()?;
    with_resources(scene, source, name.as_ref().display().to_string(), folder)
}

/// The light of a preset or a scene file, and the folder that its paths start from; nothing that it names is loaded.
///
/// # Errors
///
/// There is no such preset or file, or its text is no scene.
pub fn light_of_scene(name: &str) -> Result<(Light, PathBuf), LoadError> {
    let (source, folder) = source_of(name.as_ref(), &[])?;
    Ok((source.read()?.light, folder))
}

/// The text of a preset or a scene file, and the folder that its paths start from.
fn source_of(path: &Path, settings: &[Setting]) -> Result<(SceneSource, PathBuf), LoadError> {
    let name = path.display().to_string();
    match preset_toml(&name) {
        Some(text) => Ok((SceneSource::new(&name, text, settings), PathBuf::new())),
        None if is_word(path) && !path.exists() => Err(no_such_scene(name)),
        None => {
            let folder = path.parent().map(Path::to_owned).unwrap_or_default();
            Ok((SceneSource::new(&name, &read_text(path)?, settings), folder))
        }
    }
}

/// Loads what a scene names; file paths start from a folder. `source` is what the scene was read from.
pub(super) fn with_resources(
    scene: Scene,
    source: SceneSource,
    name: String,
    folder: PathBuf,
) -> Result<LoadedScene, LoadError> {
    let mut notes = Vec::new();
    let resources = load_resources(&scene, &folder, &mut notes).map_err(|error| match error {
        LoadError::Key(fault) => source.locate(fault).into(),
        error => error,
    })?;
    // Several lamps or films may come from one file.
    let mut told = BTreeSet::new();
    notes.retain(|note| told.insert(note.clone()));
    Ok(LoadedScene { scene, name, folder, resources, notes, source })
}

/// Whether a path can be meant as the name of a preset.
fn is_word(path: &Path) -> bool {
    path.extension().is_none() && path.components().count() <= 1
}

fn no_such_scene(name: String) -> LoadError {
    let known: Vec<&str> = preset_names().collect();
    let hint = nearest(&name, &known).map_or(String::new(), |near| format!("did you mean `{near}`? "));
    LoadError::NoSuchScene { name, hint, presets: known.join(", ") }
}

/// Loads all that a scene names; file paths start from a folder.
fn load_resources(scene: &Scene, folder: &Path, notes: &mut Vec<String>) -> Result<Resources, LoadError> {
    let (environment, spectral_lights) = load_environment(&scene.light, folder, notes)?;
    let illuminant = load_illuminant_of(&scene.light, folder, notes)?;
    Ok(Resources {
        environment,
        illuminant: illuminant.into(),
        spectral_lights,
        liquids: load_liquids(scene, folder, notes)?,
        plate: load_plate(scene, folder, notes)?,
    })
}

/// The photograph that a scene names.
fn load_plate(scene: &Scene, folder: &Path, notes: &mut Vec<String>) -> Result<Option<Arc<Plate>>, LoadError> {
    let Some(path) = &scene.view.plate else { return Ok(None) };
    let plate = read_plate(&folder.join(path), notes);
    let plate = plate.map_err(|error| Fault::unusable("plate", error).inside("view"))?;
    Ok(Some(Arc::new(plate)))
}

/// A liquid by its name or index, or from the `.csv` file of that path. What a user should know of how it was read is added to `notes`.
///
/// # Errors
///
/// There is no such liquid, or its file cannot be read or holds no index.
pub fn load_liquid(name: &str, folder: &Path, notes: &mut Vec<String>) -> Result<FilmIndex, LoadError> {
    if !is_table(name) {
        return Ok(name.parse()?);
    }
    Ok(FilmIndex::from_csv(name, &read_table_text(&folder.join(name))?, notes)?)
}

/// The liquids that a scene's films name.
fn load_liquids(
    scene: &Scene,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<BTreeMap<String, FilmIndex>, LoadError> {
    let mut liquids = BTreeMap::new();
    for (index, bubble) in scene.bubbles.iter().enumerate() {
        let FilmIndexName::Named(name) = &bubble.film.index else { continue };
        if !liquids.contains_key(name) {
            let liquid = load_liquid(name, folder, notes);
            let at = |error| Fault::unusable("index", error).inside("film").inside_item("bubble", index);
            liquids.insert(name.clone(), liquid.map_err(at)?);
        }
    }
    Ok(liquids)
}

#[cfg(test)]
mod tests;
