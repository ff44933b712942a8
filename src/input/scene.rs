//! Brings a scene and what it names into memory.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{InputError, load_environment, load_illuminant, read_table_text, read_text};
use crate::{
    physics::{
        colour::UnknownIlluminant,
        optics::{FilmIndex, FilmIndexError},
        spectra::SpectrumError,
    },
    plan::Resources,
    scene::{FilmIndexName, Scene, SceneError, preset, preset_names},
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
}

/// Why a scene cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// Neither a file nor a preset.
    #[error("no scene file or preset is named `{name}`; presets: {presets}")]
    NoSuchScene {
        /// The name given.
        name: String,
        /// The presets there are.
        presets: String,
    },
    /// The file's text is not a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// No such light.
    #[error(transparent)]
    Illuminant(#[from] UnknownIlluminant),
    /// No such film.
    #[error(transparent)]
    Film(#[from] FilmIndexError),
    /// A file of a spectrum or an index with a mistake in it.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// Loads a preset by name or a scene file by path, with its environment and light.
pub fn load_scene(name: &str) -> Result<LoadedScene, LoadError> {
    let path = Path::new(name);
    let (scene, folder) = match preset(name) {
        Some(scene) => (scene, PathBuf::new()),
        None if !path.exists() && path.extension().is_none() => {
            return Err(LoadError::NoSuchScene {
                name: name.to_owned(),
                presets: preset_names().collect::<Vec<_>>().join(", "),
            });
        }
        None => {
            let text = read_text(path)?;
            (Scene::from_toml(&text, name)?, path.parent().map(Path::to_owned).unwrap_or_default())
        }
    };
    with_resources(scene, name, &folder)
}

/// Loads what a scene names; file paths start from a folder.
pub(super) fn with_resources(scene: Scene, name: &str, folder: &Path) -> Result<LoadedScene, LoadError> {
    let mut notes = Vec::new();
    let (environment, lamps) = load_environment(&scene.light, folder, &mut notes)?;
    let resources = Resources {
        environment,
        illuminant: Arc::new(load_illuminant(&scene.light.illuminant, folder, &mut notes)?),
        lamps,
        liquids: load_liquids(&scene, folder, &mut notes)?,
    };
    // Several lamps or films may come from one file.
    let mut told = BTreeSet::new();
    notes.retain(|note| told.insert(note.clone()));
    Ok(LoadedScene { scene, name: name.to_owned(), folder: folder.to_owned(), resources, notes })
}

/// A liquid by its name or index, or from the `.csv` file of that path. What a user should know of how it was read is added to `notes`.
pub fn load_liquid(name: &str, folder: &Path, notes: &mut Vec<String>) -> Result<FilmIndex, LoadError> {
    if !is_table(name) {
        return Ok(name.parse()?);
    }
    Ok(FilmIndex::from_csv(name, &read_table_text(&folder.join(name))?, notes)?)
}

pub(super) fn is_table(name: &str) -> bool {
    name.trim().to_ascii_lowercase().ends_with(".csv")
}

/// The liquids that a scene's films name.
fn load_liquids(
    scene: &Scene,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<BTreeMap<String, FilmIndex>, LoadError> {
    let named = scene.bubbles.iter().filter_map(|bubble| match &bubble.film.index {
        FilmIndexName::Named(name) => Some(name),
        FilmIndexName::Water | FilmIndexName::Constant(_) => None,
    });
    named.map(|name| Ok((name.clone(), load_liquid(name, folder, notes)?))).collect()
}
