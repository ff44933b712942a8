//! Pictures as the program makes them, into the file that their kind goes to.

use std::path::Path;

use glam::Vec3;

use super::{ExrChannels, ExrPicture, ExrPrimaries, Metadata, OutputError, PngPicture, write_atomically};
use crate::physics::colour::{Gamut, bt2020_to_bt709};

/// A finished picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// What a display shows: rows of RGB, encoded by sRGB's curve, and alpha from the top left.
    Display {
        /// Width and height in pixels.
        size: [u32; 2],
        /// The colours that RGB are.
        gamut: Gamut,
        /// 4 · width · height bytes.
        rgba: Vec<u8>,
    },
    /// Scene radiance in linear BT.709, rows from the top left.
    Radiance {
        /// Width and height in pixels.
        size: [u32; 2],
        /// Width · height pixels.
        rgb: Vec<[f32; 3]>,
    },
    /// Named channels, of which colours are linear BT.709.
    Channels {
        /// Width and height in pixels.
        size: [u32; 2],
        /// Each channel's name with width · height values, rows from the top left.
        channels: Vec<(String, Vec<f32>)>,
    },
}

impl Picture {
    /// Scene radiance from linear BT.2020 with a fourth number that means nothing.
    #[must_use]
    pub fn radiance_from_bt2020(size: [u32; 2], rgba: &[[f32; 4]]) -> Self {
        Self::Radiance { size, rgb: bt709_from_bt2020(rgba) }
    }

    /// Writes a PNG of what a display shows, or an EXR of radiance.
    ///
    /// # Errors
    /// Those of [`write_atomically`].
    pub fn save(&self, path: &Path, metadata: &Metadata) -> Result<(), OutputError> {
        match self {
            Self::Display { size, gamut, rgba } => save_display(path, *size, *gamut, rgba, metadata),
            Self::Radiance { size, rgb } => save_radiance(path, *size, rgb, metadata),
            Self::Channels { size, channels } => ExrChannels { size: *size, channels, metadata }.save(path),
        }
    }
}

/// Linear BT.709 of pixels in linear BT.2020 with a fourth number that means nothing.
#[must_use]
pub fn bt709_from_bt2020(rgba: &[[f32; 4]]) -> Vec<[f32; 3]> {
    let matrix = bt2020_to_bt709();
    let pixel = |[r, g, b, _]: &[f32; 4]| (matrix * Vec3::new(*r, *g, *b).as_dvec3()).as_vec3().to_array();
    rgba.iter().map(pixel).collect()
}

/// Writes a PNG of what a display shows: 4 · width · height bytes.
///
/// # Errors
/// Those of [`write_atomically`].
pub fn save_display(
    path: &Path,
    [width, height]: [u32; 2],
    gamut: Gamut,
    rgba: &[u8],
    metadata: &Metadata,
) -> Result<(), OutputError> {
    PngPicture { width, height, rgba, gamut, metadata }.save(path)
}

/// Writes an EXR of scene radiance in linear BT.709: width · height pixels.
///
/// # Errors
/// Those of [`write_atomically`].
pub fn save_radiance(
    path: &Path,
    [width, height]: [u32; 2],
    rgb: &[[f32; 3]],
    metadata: &Metadata,
) -> Result<(), OutputError> {
    let picture = ExrPicture {
        width: width as usize,
        height: height as usize,
        channels: ["R", "G", "B"],
        pixels: rgb,
        primaries: Some(ExrPrimaries::Bt709),
        metadata,
    };
    picture.save(path)
}

/// Writes a text file, whole or not at all.
///
/// # Errors
/// Those of [`write_atomically`].
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    write_atomically(path, |writer| std::io::Write::write_all(writer, text.as_bytes()))
}
