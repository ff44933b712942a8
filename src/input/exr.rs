//! OpenEXR pictures.

use std::io::{BufRead, Seek};
use std::path::Path;

use ::exr::image::read::specific_channels::ReadSpecificChannel;
use ::exr::meta::header::Header;
use ::exr::prelude as openexr;
use ::exr::prelude::{ReadChannels, ReadLayers};
use glam::DVec2;

use super::InputError;
use super::chromaticities::{BT709, RgbSpace};
use super::environment::{DecodedPicture, check_size};

/// Decodes the first layer with R, G and B, of any compression and sample type.
///
/// On one thread: the `exr` crate decompresses on a pool of its own, where a panic over a damaged block would abort the
/// program.
pub(super) fn decode(path: &Path, mut file: impl BufRead + Seek) -> Result<DecodedPicture, InputError> {
    let in_words = |error| in_words(path, error);
    let meta = openexr::MetaData::read_from_buffered(&mut file, false).map_err(in_words)?;
    let (header, prefix) = find_colours(path, &meta.headers)?;
    check_layout(path, header)?;
    let openexr::Vec2(width, height) = header.layer_size;
    file.rewind().map_err(|reason| InputError::from_io(path, reason))?;

    let channel = |letter: &str| openexr::Text::from([prefix.as_str(), letter].concat().as_str());
    let image = openexr::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(channel("R"))
        .required(channel("G"))
        .required(channel("B"))
        .collect_pixels(
            |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
            |(width, pixels), openexr::Vec2(x, y), (r, g, b): (f32, f32, f32)| pixels[y * *width + x] = [r, g, b],
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(file)
        .map_err(in_words)?;
    let (_, pixels) = image.layer_data.channel_data.pixels;
    Ok(DecodedPicture { width, height, pixels, space: rgb_space(header) })
}

/// The first flat layer with colours, and what stands before the letters in its channels' names (as in `diffuse.R`).
fn find_colours<'a>(path: &Path, headers: &'a [Header]) -> Result<(&'a Header, String), InputError> {
    let colours = |header: &'a Header| {
        let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
        let complete = |prefix: &&str| {
            ["R", "G", "B"].iter().all(|letter| names.iter().any(|name| *name == format!("{prefix}{letter}")))
        };
        let mut prefixes: Vec<&str> = names.iter().filter_map(|name| name.strip_suffix('R')).filter(complete).collect();
        prefixes.sort_by_key(|prefix| prefix.len());
        prefixes.first().map(|prefix| (header, (*prefix).to_owned()))
    };
    headers.iter().filter(|header| !header.deep).find_map(colours).ok_or_else(|| no_colour(path, headers))
}

fn no_colour(path: &Path, headers: &[Header]) -> InputError {
    let channels = headers.iter().flat_map(|header| &header.channels.list);
    let names: Vec<String> = channels.take(8).map(|channel| channel.name.to_string()).collect();
    let deep = headers.iter().any(|header| header.deep);
    let found = if deep { "deep data".to_owned() } else { names.join(", ") };
    InputError::NoColour { path: path.to_owned(), found }
}

/// Refuses what would be read wrongly: a size we do not take, a part of a picture, or channels of different sizes.
fn check_layout(path: &Path, header: &Header) -> Result<(), InputError> {
    let openexr::Vec2(width, height) = header.layer_size;
    check_size(path, width, height)?;
    let unsupported = |reason: &str| Err(InputError::Unsupported { path: path.to_owned(), reason: reason.to_owned() });
    if header.shared_attributes.display_window.size != header.layer_size {
        return unsupported("its data window is not its display window");
    }
    if header.channels.list.iter().any(|channel| channel.sampling != openexr::Vec2(1, 1)) {
        return unsupported("its channels are subsampled");
    }
    Ok(())
}

fn rgb_space(header: &Header) -> RgbSpace {
    let point = |xy: openexr::Vec2<f32>| DVec2::new(f64::from(xy.x()), f64::from(xy.y()));
    header.shared_attributes.chromaticities.map_or(BT709, |named| RgbSpace {
        primaries: [named.red, named.green, named.blue].map(point),
        white: point(named.white),
    })
}

fn in_words(path: &Path, error: openexr::Error) -> InputError {
    let path = path.to_owned();
    match error {
        openexr::Error::Io(reason) => InputError::Unreadable { path, reason },
        openexr::Error::NotSupported(reason) => InputError::Unsupported { path, reason: reason.into_owned() },
        openexr::Error::Invalid(reason) => InputError::Damaged { path, reason: reason.into_owned() },
        openexr::Error::Aborted => InputError::Damaged { path, reason: "reading stopped".to_owned() },
    }
}
