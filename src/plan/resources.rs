//! What a scene names, once it is loaded.

use std::{collections::BTreeMap, sync::Arc};

use serde::{Deserialize, Serialize};

use crate::physics::{colour::Illuminant, environment::CubeMap, optics::FilmIndex, picture::Plate};

/// What a scene names and somebody has loaded.
#[derive(Clone, Debug)]
pub struct Resources {
    /// The environment, in linear BT.2020.
    pub environment: Arc<CubeMap>,
    /// The light's spectrum.
    pub illuminant: Arc<Illuminant>,
    /// Light of other illuminants, which the environment lacks.
    pub spectral_lights: Vec<SpectralLight>,
    /// Liquids from files, by the paths that the scene gives them.
    pub liquids: BTreeMap<String, FilmIndex>,
    /// The photograph behind the bubbles.
    pub plate: Option<Arc<Plate>>,
}

/// All light of one illuminant other than the scene's own.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SpectralLight {
    /// Where it comes from, in linear BT.2020.
    pub environment: Arc<CubeMap>,
    /// Its spectrum.
    pub illuminant: Arc<Illuminant>,
}
