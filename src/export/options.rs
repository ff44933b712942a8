//! What is asked of a picture.

use std::path::Path;

use crate::{physics::colour::Gamut, scene};

/// Pixels of the largest picture: what a card of 4 GB can hold at full precision.
const MAX_PIXELS: u64 = 1 << 26;

/// The largest number of samples along each side of a pixel.
pub const MAX_SAMPLES: u32 = 64;

/// How colours are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// By shaders.
    Gpu(scene::Quality),
    /// In f64 on the CPU.
    Reference,
}

/// The kind of file to write: what the window shows, or scene radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    Png,
    Exr,
}

impl Format {
    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

    /// The format that a file's ending names.
    ///
    /// # Errors
    /// It names none.
    pub fn of(path: &Path) -> Result<Self, OptionsError> {
        let known = [Self::Png, Self::Exr].into_iter().find(|format| format.ending() == ending(path));
        known.ok_or_else(|| OptionsError::Ending(path.display().to_string()))
    }
}

/// The ending of a file's name, in small letters.
pub fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or("").to_ascii_lowercase()
}

/// The options of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureOptions {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How colours are found; without it as the scene says.
    pub quality: Option<Quality>,
    /// The colours of a PNG.
    pub gamut: Gamut,
    /// Whether what stands behind the bubbles is left out.
    pub alpha: bool,
    /// Whether an EXR holds what the picture is made of.
    pub layers: bool,
    /// Samples along each side of a pixel, 1 to [`MAX_SAMPLES`].
    pub samples: u32,
}

impl PictureOptions {
    /// Whether the picture is computed in f64.
    pub fn is_reference(&self) -> bool {
        self.quality == Some(Quality::Reference)
    }

    /// Whether the picture is one frame as the window would draw it.
    pub fn is_plain(&self) -> bool {
        !self.is_reference() && !self.alpha && !self.layers && self.samples == 1
    }

    /// Whether a file of a format can hold the picture.
    ///
    /// # Errors
    /// It cannot.
    pub fn check(&self, format: Format) -> Result<(), OptionsError> {
        if self.layers && format != Format::Exr { Err(OptionsError::Layers) } else { Ok(()) }
    }
}

/// Options that make no sense.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OptionsError {
    /// The file's ending names no format.
    #[error("{0}: write to a file that ends in .png or .exr")]
    Ending(String),
    /// Layers need a file that holds them.
    #[error("--layers needs an EXR file, which can hold them")]
    Layers,
    /// A size that is none.
    #[error("write a size as WIDTHxHEIGHT, as in 1280x720")]
    NoSize,
    /// A length that is not a number.
    #[error("`{0}` is not a number of pixels")]
    Length(String),
    /// A picture without pixels.
    #[error("a picture needs at least one pixel in width and height")]
    Empty,
    /// A picture with too many pixels.
    #[error("that is {0} pixels; at most {MAX_PIXELS} (8192x8192) fit")]
    Large(u64),
}

/// `1280x720`.
///
/// # Errors
/// The text is no size, or one that no picture has.
pub fn parse_size(text: &str) -> Result<[u32; 2], OptionsError> {
    let parts = text.split_once(['x', 'X']).ok_or(OptionsError::NoSize)?;
    let number = |part: &str| part.trim().parse::<u32>().map_err(|_| OptionsError::Length(part.to_owned()));
    check_size([number(parts.0)?, number(parts.1)?])
}

/// A size that a picture may have.
///
/// # Errors
/// It has no pixels, or too many.
pub fn check_size(size: [u32; 2]) -> Result<[u32; 2], OptionsError> {
    match size.map(u64::from).iter().product::<u64>() {
        0 => Err(OptionsError::Empty),
        pixels if pixels > MAX_PIXELS => Err(OptionsError::Large(pixels)),
        _ => Ok(size),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_name_formats() {
        assert_eq!(Format::of(Path::new("a/b.PNG")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("b.exr")).unwrap(), Format::Exr);
        for wrong in ["b", "b.jpg", "png", ".png"] {
            assert!(Format::of(Path::new(wrong)).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes() {
        assert_eq!(parse_size("1280x720"), Ok([1280, 720]));
        for wrong in ["0x0", "0x5", "100000x100000", "12", "axb", "-1x5", "99999999999x1", ""] {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
    }
}
