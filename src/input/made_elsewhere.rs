//! An environment that the page's worker has made for a light that is about to be loaded: reading a file or filling a cube map would hold the
//! page up.

use std::{
    cell::RefCell,
    path::{Path, PathBuf},
    sync::Arc,
};

use serde::{Deserialize, Serialize};

use crate::{
    physics::environment::CubeMap,
    plan::SpectralLight,
    scene::{Light, Scene},
};

/// What a light names, for another memory.
#[derive(Serialize, Deserialize)]
pub struct LightNamed {
    /// A scene with this light, TOML.
    pub(super) scene: String,
    pub(super) folder: PathBuf,
}

/// An environment, its spectral lights, and notes about files.
#[derive(Serialize, Deserialize)]
pub struct MadeEnvironment(pub(super) Arc<CubeMap>, pub(super) Vec<SpectralLight>, pub(super) Vec<String>);

thread_local! {
    static MADE: RefCell<Option<(Light, PathBuf, MadeEnvironment)>> = const { RefCell::new(None) };
}

impl LightNamed {
    /// A light, whose paths start from a folder.
    #[must_use]
    pub fn new(light: &Light, folder: &Path) -> Self {
        let scene = Scene { light: light.clone(), ..Scene::default() }.to_toml();
        Self { scene, folder: folder.to_owned() }
    }
}

/// Keeps an environment for the next load of its light.
pub fn keep_environment(light: Light, folder: PathBuf, made: MadeEnvironment) {
    MADE.set(Some((light, folder, made)));
}

/// The environment that was kept for a light, if one was.
pub(super) fn take(light: &Light, folder: &Path) -> Option<MadeEnvironment> {
    MADE.take().filter(|(known, from, _)| (known, from.as_path()) == (light, folder)).map(|(_, _, made)| made)
}

impl MadeEnvironment {
    /// The environment.
    #[must_use]
    pub fn map(&self) -> &Arc<CubeMap> {
        &self.0
    }

    /// As if it were loaded now.
    pub(super) fn into_parts(self, notes: &mut Vec<String>) -> (Arc<CubeMap>, Vec<SpectralLight>) {
        notes.extend(self.2);
        (self.0, self.1)
    }
}
