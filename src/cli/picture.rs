//! What `render` and `sequence` share: the options of a picture.

use std::path::Path;

use clap::Args;

use super::{AdapterArguments, SceneSettings, parse};
use crate::{
    export::{Format, MAX_SAMPLES, Painter, PictureOptions, Quality},
    physics::colour::Gamut,
};

/// The options of a picture; a new one belongs here, so that every command that draws pictures has it.
#[derive(Args, Clone, Debug)]
pub struct PictureArguments {
    #[command(flatten)]
    settings: SceneSettings,
    /// Width and height in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = parse::size, allow_hyphen_values = true)]
    size: [u32; 2],
    /// `fast`, `standard`, `spectral` (wavelengths in the shader) or `reference` (f64 on the CPU; only a film that moves by itself needs a GPU)
    /// [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = parse::quality)]
    quality: Option<Quality>,
    /// Colour space of a PNG: `srgb`, or `p3` for wide-gamut displays
    #[arg(long, value_name = "GAMUT", default_value = "srgb", value_parser = parse::gamut)]
    gamut: Gamut,
    /// Leave out what stands behind the bubbles: PNG with straight alpha, EXR with colours premultiplied by alpha, which is 1 minus the mean
    /// transmittance
    #[arg(long)]
    alpha: bool,
    /// Write what the picture is made of as layers of one EXR file: beauty, reflection, transmission, background, and of the nearest wall of film
    /// its thickness, normal, position, depth, angle, place on the film and number of its bubble
    #[arg(long)]
    layers: bool,
    /// Take N x N samples per pixel, each through another place of the lens and while the shutter is open, if the scene's [lens] has them
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: u32,
    #[command(flatten)]
    adapter: AdapterArguments,
}

impl PictureArguments {
    /// What is asked of the picture.
    pub fn options(&self) -> PictureOptions {
        let Self { size, quality, gamut, alpha, layers, samples, .. } = *self;
        PictureOptions { size, quality, gamut, alpha, layers, samples }
    }

    /// A painter of a scene file or a preset.
    pub fn painter(&self, format: Format, scene: &Path) -> anyhow::Result<Painter> {
        let options = self.options();
        options.check(format)?;
        let (loaded, adapter) = (self.settings.load(scene)?, self.adapter.clone());
        Painter::new(options, format, loaded, Box::new(move || adapter.open()))
    }
}
