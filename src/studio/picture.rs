//! Pictures that a studio draws.

use std::path::Path;

use super::Error;
use crate::{
    output::{self, Metadata},
    physics::colour::Gamut,
};

/// What a display shows: 8 bits, encoded by sRGB's curve, with the scene's exposure.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green, blue and alpha of each pixel, row by row from the top left: 4 · width · height bytes. Alpha is 255.
    pub rgba: Vec<u8>,
    pub(super) metadata: Metadata,
}

impl Picture {
    /// Writes a PNG file, whole or not at all, that also says the scene and the time.
    ///
    /// # Errors
    /// [`Error::File`] if the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        Ok(output::save_display(path.as_ref(), self.size, Gamut::Srgb, &self.rgba, &self.metadata)?)
    }
}

/// Scene radiance in linear BT.709, before exposure and tone curve. Colours outside of BT.709, which films have, are negative in a component.
#[derive(Clone, Debug, PartialEq)]
pub struct Radiance {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, row by row from the top left: width · height of them.
    pub rgb: Vec<[f32; 3]>,
    metadata: Metadata,
}

impl Radiance {
    pub(super) fn from_bt2020(size: [u32; 2], bt2020: &[[f32; 4]], metadata: Metadata) -> Self {
        Self { size, rgb: output::bt709_from_bt2020(bt2020), metadata }
    }

    /// The rows from the top, each of as many pixels as the picture is wide.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[[f32; 3]]> {
        self.rgb.chunks_exact(self.size[0] as usize)
    }

    /// Writes an EXR file of 32-bit numbers, whole or not at all, that also says the scene and the time.
    ///
    /// # Errors
    /// [`Error::File`] if the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        Ok(output::save_radiance(path.as_ref(), self.size, &self.rgb, &self.metadata)?)
    }
}
