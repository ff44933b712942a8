//! Photographs to stand behind the bubbles.

use std::{
    io::{self, BufRead, BufReader, Seek},
    path::Path,
};

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, metadata::Orientation};

use super::{
    InputError,
    chromaticities::BT709,
    exr, file,
    panic_guard::catch_panic,
    picture::{DecodedPicture, Shape, check_size},
    radiance,
};
use crate::{
    parallel,
    physics::{
        colour::{bt2020_to_bt709, srgb_decode},
        picture::Plate,
    },
};

/// Reads a photograph from a PNG, JPEG, OpenEXR or Radiance .hdr file, told apart by content, not by name.
///
/// PNG and JPEG are read as sRGB, with white at 1. OpenEXR and Radiance are linear, and BT.709 unless the file names other chromaticities. What a
/// user should know of how it was read is added to `notes`, a line each.
///
/// # Errors
/// Every [`InputError`] but those about text and panoramas.
pub fn read_plate(path: &Path, notes: &mut Vec<String>) -> Result<Plate, InputError> {
    let file = BufReader::new(file::open(path)?);
    let reader = ImageReader::new(file).with_guessed_format().map_err(|reason| InputError::from_io(path, reason))?;
    let format = reader.format();
    let mut file = reader.into_inner();
    if file.fill_buf().is_ok_and(<[u8]>::is_empty) {
        return Err(InputError::Empty { path: path.to_owned() });
    }
    file.rewind().map_err(|reason| InputError::from_io(path, reason))?;
    let decode = || match format {
        Some(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => encoded(path, file, format),
        Some(ImageFormat::OpenExr) => linear(exr::decode(path, file, Shape::Any)?),
        Some(ImageFormat::Hdr) => linear(radiance::decode(path, file, Shape::Any)?),
        _ => Err(InputError::UnknownPlate { path: path.to_owned() }),
    };
    let failed = || InputError::DecoderFailed { path: path.to_owned() };
    let (size, pixels, told) = catch_panic(decode).unwrap_or_else(|| Err(failed()))?;
    notes.extend(told.into_iter().map(|note| format!("{} {note}", path.display())));
    Plate::new(size, pixels).ok_or_else(failed)
}

/// Width and height, pixels in linear BT.709, and what a user should know of them.
type Decoded = ([usize; 2], Vec<[f32; 3]>, Vec<String>);

/// Decodes a picture that is made for screens.
fn encoded(path: &Path, file: impl BufRead + Seek, format: ImageFormat) -> Result<Decoded, InputError> {
    let in_words = |error| in_words(path, error);
    let mut decoder = ImageReader::with_format(file, format).into_decoder().map_err(in_words)?;
    let (width, height) = decoder.dimensions();
    check_size(path, width as usize, height as usize, Shape::Any)?;
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let has_alpha = decoder.color_type().has_alpha();
    let mut image = DynamicImage::from_decoder(decoder).map_err(in_words)?;
    image.apply_orientation(orientation);
    let rgb = image.into_rgb16();
    let curve: Vec<f32> = (0..=u16::MAX).map(|value| srgb_decode(f64::from(value) / 65535.0) as f32).collect();
    let size = [rgb.width() as usize, rgb.height() as usize];
    let (raw, _) = rgb.as_raw().as_chunks::<3>();
    let pixels = parallel::map(raw.len(), |k| raw[k].map(|value| curve[usize::from(value)]));
    let note = has_alpha
        .then(|| "is transparent in parts; what is behind them is not known, and they are shown whole".to_owned());
    Ok((size, pixels, note.into_iter().collect()))
}

/// Takes a picture of radiance.
fn linear(picture: DecodedPicture) -> Result<Decoded, InputError> {
    let mut notes = picture.notes;
    let stated = picture.space.to_bt2020();
    if stated.is_none() {
        notes.push("has chromaticities of no valid colour space and is read as BT.709".to_owned());
    }
    let matrix = stated.or_else(|| BT709.to_bt2020()).map(|to_bt2020| (bt2020_to_bt709() * to_bt2020).as_mat3());
    let matrix = matrix.unwrap_or(glam::Mat3::IDENTITY);
    let mut pixels = picture.pixels;
    parallel::change(&mut pixels, picture.width, |_, row| {
        row.iter_mut().for_each(|pixel| *pixel = (matrix * glam::Vec3::from(pixel.map(usable))).to_array());
    });
    Ok(([picture.width, picture.height], pixels, notes))
}

/// Light that can be: neither NaN nor beyond what pictures hold.
fn usable(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(-65504.0, 65504.0) }
}

fn in_words(path: &Path, error: ImageError) -> InputError {
    let path = path.to_owned();
    match error {
        ImageError::IoError(reason) if reason.kind() != io::ErrorKind::UnexpectedEof => {
            InputError::Unreadable { path, reason }
        }
        ImageError::IoError(_) => InputError::Damaged { path, reason: "it ends too early".to_owned() },
        other => InputError::Damaged { path, reason: other.to_string() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_is_read_as_a_screen_shows_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plate.jpg");
        image::RgbImage::from_fn(3, 2, |x, y| image::Rgb([255, 128 * (x / 2) as u8, 64 * y as u8]))
            .save_with_format(&path, ImageFormat::Png)
            .unwrap();
        let plate = read_plate(&path, &mut Vec::new()).unwrap();
        assert_eq!(plate.size(), [3, 2]);
        let pixels = plate.fitted([3, 2], &(0..3), &(0..2));
        assert_eq!(pixels[0], [1.0, 0.0, 0.0]);
        assert!((pixels[2][1] - srgb_decode(128.0 / 255.0) as f32).abs() < 1e-6);
    }

    #[test]
    fn what_is_no_photograph_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plate.png");
        let told = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            read_plate(&path, &mut Vec::new()).unwrap_err().to_string()
        };
        assert!(told(b"a poem").contains("PNG"), "{}", told(b"a poem"));
        assert!(told(b"\x89PNG\r\n\x1a\n").contains("damaged"));
        assert!(told(b"").contains("empty"));
        let missing = read_plate(&folder.path().join("none.png"), &mut Vec::new()).unwrap_err().to_string();
        assert!(missing.contains("does not exist"), "{missing}");
    }
}
