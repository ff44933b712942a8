//! Radiance pictures (.hdr, .pic).
//!
//! The header is read here, because programs write it in more ways than the decoder knows; the scan lines are the decoder's.
//! The format: G. Ward Larson, R. Shakespeare, Rendering with Radiance, appendix C.

use std::io::{self, BufRead, Read};
use std::path::Path;

use glam::DVec2;
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use image::error::ImageError;

use super::InputError;
use super::chromaticities::{BT709, CIE_XYZ, RgbSpace};
use super::picture::{DecodedPicture, Shape, check_size};

/// The longest line of a header that is read, bytes.
const MAX_LINE_BYTES: u64 = 1 << 16;

/// Luminous efficacy that Radiance gives to white light, lm/W: pixels in XYZ are in cd/m² where those in RGB are in W/(m² sr).
const WHITE_EFFICACY: f64 = 179.0;

/// Decodes a Radiance picture; its `EXPOSURE` and `COLORCORR` are undone and its `PRIMARIES` honoured, as Radiance's file
/// format asks.
pub(super) fn decode(path: &Path, mut file: impl BufRead, shape: Shape) -> Result<DecodedPicture, InputError> {
    let header = Header::read(path, &mut file)?;
    let [width, height] = header.resolution.size();
    check_size(path, width, height, shape)?;
    let stored = read_scan_lines(file, &header.resolution).map_err(|error| in_words(path, error))?;
    let scale = header.scale();
    let mut pixels = vec![[0.0; 3]; width * height];
    for (index, pixel) in stored.into_iter().enumerate() {
        let [x, y] = header.resolution.position(index);
        pixels[y * width + x] = std::array::from_fn(|i| pixel[i] * scale[i]);
    }
    Ok(DecodedPicture { width, height, pixels, space: header.space, notes: header.notes })
}

/// The contents of a header.
struct Header {
    /// Whether pixels are CIE XYZ.
    is_xyz: bool,
    space: RgbSpace,
    /// What the values were multiplied with: by all `EXPOSURE` lines, and by those and all `COLORCORR` lines.
    exposure: Option<f64>,
    correction: [f64; 3],
    resolution: Resolution,
    notes: Vec<String>,
}

impl Header {
    fn read(path: &Path, file: &mut impl BufRead) -> Result<Self, InputError> {
        let mut next = || next_line(file).map_err(|reason| in_words(path, ImageError::IoError(reason)));
        let mut header = Self {
            is_xyz: false,
            space: BT709,
            exposure: None,
            correction: [1.0; 3],
            resolution: Resolution::default(),
            notes: Vec::new(),
        };
        loop {
            let line = next()?;
            if line.is_empty() {
                break;
            }
            header.take_line(path, &line)?;
        }
        let line = next()?;
        let damaged = || InputError::Damaged {
            path: path.to_owned(),
            reason: format!("its resolution line is `{}`", excerpt(&line)),
        };
        header.resolution = Resolution::parse(&line).ok_or_else(damaged)?;
        if header.is_xyz {
            header.space = CIE_XYZ;
        }
        Ok(header)
    }

    /// Takes one line `KEY=value`. Other lines are comments and commands; indented ones belong to pictures that this one was made from.
    fn take_line(&mut self, path: &Path, line: &str) -> Result<(), InputError> {
        let Some((key, value)) = line.split_once('=') else { return Ok(()) };
        let value = value.trim();
        match key.trim_end() {
            "FORMAT" => self.is_xyz = is_xyz(path, value)?,
            "EXPOSURE" => match factors(value) {
                Some([exposure]) => self.exposure = Some(exposure * self.exposure.unwrap_or(1.0)),
                None => self.ignore(line, "is no positive number"),
            },
            "COLORCORR" => match factors::<3>(value) {
                Some(factors) => self.correction = std::array::from_fn(|i| self.correction[i] * factors[i]),
                None => self.ignore(line, "is not three positive numbers"),
            },
            "PRIMARIES" => match numbers(value) {
                Some([rx, ry, gx, gy, bx, by, wx, wy]) => {
                    let primaries = [DVec2::new(rx, ry), DVec2::new(gx, gy), DVec2::new(bx, by)];
                    self.space = RgbSpace::stated(primaries, DVec2::new(wx, wy));
                }
                None => self.ignore(line, "is not eight numbers"),
            },
            _ => {}
        }
        Ok(())
    }

    fn ignore(&mut self, line: &str, reason: &str) {
        self.notes.push(format!("has a line `{}` in its header, which {reason} and is ignored", excerpt(line)));
    }

    /// What takes the stored values back to radiance.
    fn scale(&self) -> [f32; 3] {
        // Only an exposure says that values in XYZ are luminances; without it they have no unit.
        let efficacy = if self.is_xyz && self.exposure.is_some() { WHITE_EFFICACY } else { 1.0 };
        self.correction.map(|correction| (1.0 / (correction * self.exposure.unwrap_or(1.0) * efficacy)) as f32)
    }
}

fn is_xyz(path: &Path, format: &str) -> Result<bool, InputError> {
    match format {
        "32-bit_rle_rgbe" => Ok(false),
        "32-bit_rle_xyze" => Ok(true),
        _ => Err(InputError::Unsupported {
            path: path.to_owned(),
            reason: format!("its FORMAT is `{}`", excerpt(format)),
        }),
    }
}

/// The beginning of a line, for messages: a file without a header may start with anything.
fn excerpt(line: &str) -> String {
    line.chars().filter(|character| !character.is_control()).take(60).collect()
}

/// So many numbers and nothing else.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = text.split_whitespace().map(|number| number.parse().ok()).collect();
    numbers?.try_into().ok()
}

/// So many factors within what `f32` can hold.
fn factors<const N: usize>(text: &str) -> Option<[f64; N]> {
    numbers(text).filter(|factors| factors.iter().all(|factor| (1e-30..=1e30).contains(factor)))
}

/// The next line without its end, which is `\n` or `\r\n`.
fn next_line(file: &mut impl BufRead) -> io::Result<String> {
    let mut bytes = Vec::new();
    file.by_ref().take(MAX_LINE_BYTES).read_until(b'\n', &mut bytes)?;
    let line = bytes.strip_suffix(b"\n").ok_or(io::ErrorKind::UnexpectedEof)?;
    Ok(String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)).into_owned())
}

/// In which order pixels are stored, as in `-Y 512 +X 1024`: scan lines from the top, and in each the pixels from the left.
#[derive(Debug, Default, PartialEq)]
struct Resolution {
    /// From one scan line to the next.
    lines: Axis,
    /// From one pixel of a scan line to the next.
    pixels: Axis,
}

/// One of the two directions of a picture.
#[derive(Debug, Default, PartialEq)]
struct Axis {
    is_x: bool,
    /// Whether it runs as ours do: x to the right, y down.
    forward: bool,
    length: usize,
}

impl Resolution {
    fn parse(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [lines, line_count, pixels, pixel_count] = words[..] else { return None };
        let (lines, pixels) = (Axis::parse(lines, line_count)?, Axis::parse(pixels, pixel_count)?);
        (lines.is_x != pixels.is_x).then_some(Self { lines, pixels })
    }

    /// Width and height of the picture.
    fn size(&self) -> [usize; 2] {
        let [lines, pixels] = [self.lines.length, self.pixels.length];
        if self.lines.is_x { [lines, pixels] } else { [pixels, lines] }
    }

    /// Column and row, from the top left, of a pixel by its place in the file.
    fn position(&self, index: usize) -> [usize; 2] {
        let line = self.lines.position(index / self.pixels.length);
        let pixel = self.pixels.position(index % self.pixels.length);
        if self.lines.is_x { [line, pixel] } else { [pixel, line] }
    }
}

impl Axis {
    /// Radiance's y points up.
    fn parse(direction: &str, length: &str) -> Option<Self> {
        let (is_x, forward) = match direction {
            "+X" => (true, true),
            "-X" => (true, false),
            "-Y" => (false, true),
            "+Y" => (false, false),
            _ => return None,
        };
        Some(Self { is_x, forward, length: length.parse().ok()? })
    }

    fn position(&self, index: usize) -> usize {
        if self.forward { index } else { self.length - 1 - index }
    }
}

/// All pixels in the order of the file. The decoder gets a header that it knows in place of the file's.
fn read_scan_lines(file: impl BufRead, resolution: &Resolution) -> Result<Vec<[f32; 3]>, ImageError> {
    let [lines, pixels] = [resolution.lines.length, resolution.pixels.length];
    let header = format!("#?RADIANCE\n\n-Y {lines} +X {pixels}\n");
    let decoder = HdrDecoder::new(header.as_bytes().chain(file))?;
    let mut stored = vec![[0.0f32; 3]; lines * pixels];
    decoder.read_image(bytemuck::cast_slice_mut(&mut stored))?;
    Ok(stored)
}

fn in_words(path: &Path, error: ImageError) -> InputError {
    let path = path.to_owned();
    match error {
        ImageError::IoError(reason) if reason.kind() != io::ErrorKind::UnexpectedEof => {
            InputError::Unreadable { path, reason }
        }
        ImageError::IoError(_) => InputError::Damaged { path, reason: "it ends too early".to_owned() },
        ImageError::Unsupported(reason) => InputError::Unsupported { path, reason: reason.to_string() },
        other => InputError::Damaged { path, reason: other.to_string() },
    }
}
