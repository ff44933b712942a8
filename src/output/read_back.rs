//! What was written, read again: to test it, and to compare pictures.

use std::io::{self, BufReader};
use std::path::Path;

use ::exr::prelude as openexr;
use ::exr::prelude::{ReadChannels, ReadLayers};

use super::Metadata;

/// An 8-bit RGBA picture from a PNG file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PngContents {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and straight alpha of each pixel, row by row from the top left.
    pub rgba: Vec<u8>,
    /// The text chunks, ASCII first.
    pub metadata: Metadata,
}

/// Reads a PNG file as [`super::PngPicture`] writes it: 8 bits, RGBA.
///
/// # Errors
/// The file cannot be read, is damaged, or is of another kind of PNG.
pub fn read_png(path: &Path) -> io::Result<PngContents> {
    let mut reader = png::Decoder::new(BufReader::new(std::fs::File::open(path)?)).read_info()?;
    let wrong = |reason: &str| io::Error::new(io::ErrorKind::InvalidData, format!("{}: {reason}", path.display()));
    if reader.output_color_type() != (png::ColorType::Rgba, png::BitDepth::Eight) {
        return Err(wrong("is not an 8-bit RGBA picture"));
    }
    let mut rgba = vec![0; reader.output_buffer_size().ok_or_else(|| wrong("is too large"))?];
    reader.next_frame(&mut rgba)?;
    let info = reader.info();
    let mut metadata = Metadata::new();
    for chunk in &info.uncompressed_latin1_text {
        metadata = metadata.with(&chunk.keyword, &chunk.text);
    }
    for chunk in &info.utf8_text {
        metadata = metadata.with(&chunk.keyword, &chunk.get_text()?);
    }
    Ok(PngContents { width: info.width, height: info.height, rgba, metadata })
}

/// A picture of 32-bit channels from an OpenEXR file.
#[derive(Debug, Clone, PartialEq)]
pub struct ExrContents {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Each channel's name and its samples, row by row from the top left, in the file's order (alphabetical).
    pub channels: Vec<(String, Vec<f32>)>,
    /// (x, y) of red, green, blue and white, if the file names them.
    pub chromaticities: Option<[[f32; 2]; 4]>,
    /// Numerator and denominator of the `framesPerSecond` attribute, if it is there and positive.
    pub frames_per_second: Option<[u32; 2]>,
    /// Hours, minutes, seconds and frame of the `timeCode` attribute.
    pub time_code: Option<[u8; 4]>,
    /// The lines `key: value` of the `comments` attribute.
    pub metadata: Metadata,
}

impl ExrContents {
    /// The samples of the channel of that name.
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        self.channels.iter().find_map(|(known, samples)| (known == name).then_some(samples.as_slice()))
    }
}

/// Reads the first layer of an OpenEXR file as [`super::ExrPicture`] writes it. For files of our own: foreign ones may make
/// the decoder panic, and belong to [`crate::input`].
///
/// # Errors
/// The file cannot be read or is damaged.
pub fn read_exr(path: &Path) -> io::Result<ExrContents> {
    let read =
        openexr::read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image = read
        .from_file(path)
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, format!("{}: {error}", path.display())))?;
    let layer = image.layer_data;
    let comments = layer.attributes.comments.map(|text| String::from_utf8_lossy(text.as_slice()).into_owned());
    let channels = layer.channel_data.list.iter();
    Ok(ExrContents {
        width: layer.size.width(),
        height: layer.size.height(),
        channels: channels
            .map(|channel| (channel.name.to_string(), channel.sample_data.values_as_f32().collect()))
            .collect(),
        chromaticities: image
            .attributes
            .chromaticities
            .map(|c| [c.red, c.green, c.blue, c.white].map(|xy| [xy.x(), xy.y()])),
        frames_per_second: layer
            .attributes
            .frames_per_second
            .and_then(|(numerator, denominator)| Some([u32::try_from(numerator).ok()?, denominator])),
        time_code: image.attributes.time_code.map(|code| [code.hours, code.minutes, code.seconds, code.frame]),
        metadata: Metadata::from_lines(&comments.unwrap_or_default()),
    })
}
