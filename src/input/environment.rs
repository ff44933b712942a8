//! Environments from files, in whatever of the known formats.

use std::io::{BufReader, Read, Seek};
use std::path::Path;

use glam::{DMat3, Vec3};

use super::chromaticities::BT709;
use super::panic_guard::catch_panic;
use super::picture::Shape;
use super::{InputError, exr, file, radiance};
use crate::{parallel, physics::environment::Equirect};

/// Reads an equirectangular panorama from an OpenEXR or Radiance .hdr file, told apart by content, not by name.
///
/// RGB is taken as linear BT.709 unless the file names other chromaticities, and converted to linear BT.2020. Values that no
/// light can have are repaired and counted: [`Equirect::repairs`]. What a user should know of it, such as the layer that was taken or
/// what was repaired, is added to `notes`, a line each.
///
/// # Errors
/// Every [`InputError`] but those about text: the file is missing, a folder, unreadable, empty, of another format, damaged,
/// stored in a way that no decoder here knows, without colours, too large, too small, or not twice as wide as high.
pub fn read_environment(path: &Path, notes: &mut Vec<String>) -> Result<Equirect, InputError> {
    let mut file = BufReader::new(file::open(path)?);
    let format = recognise(&mut file, path)?;
    let decode = || match format {
        Format::OpenExr => exr::decode(path, file, Shape::Panorama),
        Format::Radiance => radiance::decode(path, file, Shape::Panorama),
    };
    let failed = || InputError::DecoderFailed { path: path.to_owned() };
    let mut picture = catch_panic(decode).unwrap_or_else(|| Err(failed()))?;
    let to_bt2020 = picture.space.to_bt2020().or_else(|| {
        picture.notes.push("has chromaticities of no valid colour space and is read as BT.709".to_owned());
        BT709.to_bt2020()
    });
    let pixels = convert(picture.pixels, to_bt2020.ok_or_else(failed)?);
    let panorama = Equirect::new(picture.width, picture.height, pixels).map_err(|_| failed())?;
    if panorama.repairs().total() > 0 {
        picture.notes.push(format!("has pixels that no light can have: {}", panorama.repairs()));
    }
    notes.extend(picture.notes.into_iter().map(|note| format!("{} {note}", path.display())));
    Ok(panorama)
}

enum Format {
    OpenExr,
    Radiance,
}

/// Tells the format by the file's first bytes and goes back to its start.
fn recognise(file: &mut (impl Read + Seek), path: &Path) -> Result<Format, InputError> {
    let in_words = |reason| InputError::from_io(path, reason);
    let mut magic = Vec::new();
    file.by_ref().take(4).read_to_end(&mut magic).map_err(in_words)?;
    file.rewind().map_err(in_words)?;
    match magic.as_slice() {
        [] => Err(InputError::Empty { path: path.to_owned() }),
        [0x76, 0x2f, 0x31, 0x01] => Ok(Format::OpenExr),
        [b'#', b'?', ..] => Ok(Format::Radiance),
        _ => Err(InputError::UnknownPicture { path: path.to_owned() }),
    }
}

fn convert(mut pixels: Vec<[f32; 3]>, to_bt2020: DMat3) -> Vec<[f32; 3]> {
    const PIECE: usize = 1024;
    let matrix = to_bt2020.as_mat3();
    parallel::change(&mut pixels, PIECE, |_, piece| {
        for pixel in piece {
            // Infinities of either sign would meet in the sum and become NaN: this keeps the too bright too bright.
            let finite = pixel.map(|component| component.clamp(-1e30, 1e30));
            *pixel = (matrix * Vec3::from(finite)).to_array();
        }
    });
    pixels
}

#[cfg(test)]
mod tests;
