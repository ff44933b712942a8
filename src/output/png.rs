//! PNG pictures: what the window shows.

use std::io::{self, Write};
use std::path::Path;

use super::{Metadata, OutputError, icc::display_p3_profile, write_atomically};
use crate::physics::colour::Gamut;

/// An 8-bit picture to be written.
#[derive(Debug, Clone, Copy)]
pub struct PngPicture<'a> {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Red, green, blue and straight alpha of each pixel, encoded by sRGB's curve, row by row from the top left: 4 · width · height bytes.
    pub rgba: &'a [u8],
    /// The colour space, which is stored in the file.
    pub gamut: Gamut,
    /// Metadata, as tEXt chunks (iTXt where a value is not ASCII).
    pub metadata: &'a Metadata,
}

impl PngPicture<'_> {
    /// Writes the picture as a file, whole or not at all. Equal pictures give equal bytes.
    ///
    /// # Errors
    /// Those of [`write_atomically`], and a size that is zero or does not fit the count of bytes.
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        write_atomically(path, |writer| self.encode(writer))
    }

    /// Encodes the picture into any writer.
    ///
    /// # Errors
    /// The writer's, and a size that is zero or does not fit the count of bytes.
    pub fn encode(&self, writer: impl Write) -> io::Result<()> {
        let mut writer = encoder(writer, [self.width, self.height], self.gamut, self.metadata)?.write_header()?;
        writer.write_image_data(self.rgba)?;
        writer.finish()?;
        Ok(())
    }
}

/// An encoder of RGBA with 8 bits, which knows what its colours are.
pub(super) fn encoder<'a, W: Write>(
    writer: W,
    [width, height]: [u32; 2],
    gamut: Gamut,
    metadata: &Metadata,
) -> io::Result<png::Encoder<'a, W>> {
    let mut info = png::Info::with_size(width, height);
    info.color_type = png::ColorType::Rgba;
    info.bit_depth = png::BitDepth::Eight;
    if gamut == Gamut::DisplayP3 {
        info.icc_profile = Some(display_p3_profile().into());
    }
    let mut encoder = png::Encoder::with_info(writer, info)?;
    if gamut == Gamut::Srgb {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        // The power that stands for sRGB where a reader knows no sRGB chunk (PNG specification, 11.3.2.5).
        encoder.set_source_gamma(png::ScaledFloat::from_scaled(45455));
    }
    for (key, value) in metadata.entries() {
        let (key, value) = (key.to_owned(), value.to_owned());
        if value.is_ascii() {
            encoder.add_text_chunk(key, value)?;
        } else {
            encoder.add_itxt_chunk(key, value)?;
        }
    }
    Ok(encoder)
}

#[cfg(test)]
mod tests {
    use super::super::read_back::read_png;
    use super::*;

    fn gradient(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).flat_map(|i| [i as u8, (i / 3) as u8, 255 - i as u8, 255]).collect()
    }

    #[test]
    fn comes_back_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let metadata = Metadata::new().with("Scene", "tent").with("Author", "Jürgen µ").with("Time", "0.1");
        let rgba = gradient(7, 5);
        PngPicture { width: 7, height: 5, rgba: &rgba, gamut: Gamut::Srgb, metadata: &metadata }.save(&path).unwrap();
        let read = read_png(&path).unwrap();
        assert_eq!((read.width, read.height, read.rgba), (7, 5, rgba));
        assert_eq!(read.metadata.get("Scene"), Some("tent"));
        assert_eq!(read.metadata.get("Author"), Some("Jürgen µ"));
        assert_eq!(read.metadata.get("Time"), Some("0.1"));
    }

    #[test]
    fn says_what_its_colours_are() {
        let chunks = |gamut| {
            let mut bytes = Vec::new();
            let picture = PngPicture { width: 1, height: 1, rgba: &[1, 2, 3, 255], gamut, metadata: &Metadata::new() };
            picture.encode(&mut bytes).unwrap();
            [b"sRGB", b"gAMA", b"iCCP"].map(|chunk| bytes.windows(4).any(|window| window == chunk))
        };
        assert_eq!(chunks(Gamut::Srgb), [true, true, false]);
        assert_eq!(chunks(Gamut::DisplayP3), [false, false, true]);
    }

    #[test]
    fn sizes_that_do_not_fit_are_errors_and_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let metadata = Metadata::new();
        for (width, height, bytes) in [(2, 2, 15), (2, 2, 17), (0, 2, 0), (2, 0, 0)] {
            let rgba = vec![0; bytes];
            let picture = PngPicture { width, height, rgba: &rgba, gamut: Gamut::Srgb, metadata: &metadata };
            picture.save(&folder.path().join("a.png")).unwrap_err();
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{width}x{height}");
        }
    }
}
