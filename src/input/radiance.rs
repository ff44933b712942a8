//! Radiance pictures (.hdr, .pic).

use std::io::BufRead;
use std::path::Path;

use glam::DVec2;
use image::ImageDecoder;
use image::codecs::hdr::{HdrDecoder, HdrMetadata};
use image::error::ImageError;

use super::InputError;
use super::chromaticities::{BT709, RgbSpace};
use super::environment::{DecodedPicture, check_size};

/// Decodes a Radiance picture; its `EXPOSURE` and `COLORCORR` are undone and its `PRIMARIES` honoured, as Radiance's file
/// format asks.
pub(super) fn decode(path: &Path, file: impl BufRead) -> Result<DecodedPicture, InputError> {
    let in_words = |error| in_words(path, error);
    // Not strict: some programs sign their files `#?RGBE`.
    let decoder = HdrDecoder::with_strictness(file, false).map_err(in_words)?;
    let metadata = decoder.metadata();
    let (width, height) = (metadata.width as usize, metadata.height as usize);
    check_size(path, width, height)?;
    let mut pixels = vec![[0.0f32; 3]; width * height];
    decoder.read_image(bytemuck::cast_slice_mut(&mut pixels)).map_err(in_words)?;
    let scale = radiance_scale(&metadata);
    for pixel in &mut pixels {
        *pixel = std::array::from_fn(|i| pixel[i] * scale[i]);
    }
    Ok(DecodedPicture { width, height, pixels, space: rgb_space(&metadata) })
}

/// What takes the stored values back to radiance.
fn radiance_scale(metadata: &HdrMetadata) -> [f32; 3] {
    let exposure = metadata.exposure.unwrap_or(1.0);
    let (r, g, b) = metadata.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let scale = [r, g, b].map(|correction| 1.0 / (exposure * correction));
    // Nonsense in the header (0, negative, not a number) is worth no refusal: the values as stored are the best guess.
    if scale.iter().all(|scale| scale.is_finite() && *scale > 0.0) { scale } else { [1.0; 3] }
}

/// The space named by `PRIMARIES= rx ry gx gy bx by wx wy`, else BT.709.
fn rgb_space(metadata: &HdrMetadata) -> RgbSpace {
    let line = metadata.custom_attributes.iter().find(|(key, _)| key == "PRIMARIES");
    let numbers: Vec<f64> = line
        .into_iter()
        .flat_map(|(_, value)| value.split_whitespace())
        .filter_map(|number| number.parse().ok())
        .collect();
    match numbers[..] {
        [rx, ry, gx, gy, bx, by, wx, wy] => RgbSpace {
            primaries: [DVec2::new(rx, ry), DVec2::new(gx, gy), DVec2::new(bx, by)],
            white: DVec2::new(wx, wy),
        },
        _ => BT709,
    }
}

fn in_words(path: &Path, error: ImageError) -> InputError {
    let path = path.to_owned();
    match error {
        ImageError::IoError(reason) if reason.kind() != std::io::ErrorKind::UnexpectedEof => {
            InputError::Unreadable { path, reason }
        }
        ImageError::IoError(_) => InputError::Damaged { path, reason: "it ends too early".to_owned() },
        ImageError::Unsupported(reason) => InputError::Unsupported { path, reason: reason.to_string() },
        other => InputError::Damaged { path, reason: other.to_string() },
    }
}
