//! OpenEXR pictures.

mod layers;
mod window;

use std::io::{BufRead, Seek, SeekFrom};
use std::path::Path;

use ::exr::block::lines::LineRef;
use ::exr::block::{UncompressedBlock, chunk::Chunk};
use ::exr::io::PeekRead;
use ::exr::meta::header::Header;
use ::exr::prelude::{self as openexr, Compression, MetaData, SampleType};
use glam::DVec2;
use half::f16;

use super::InputError;
use super::chromaticities::{BT709, RgbSpace};
use super::picture::{DecodedPicture, Shape};
use layers::Layer;
use window::Placement;

/// Decodes the layer that is most likely the finished picture, of any compression and sample type that the decoder knows.
///
/// On one thread: the `exr` crate decompresses on a pool of its own, where a panic over a damaged block would abort the
/// program. Block by block: its readers of whole pictures refuse a file with any deep part, and cannot tell layers apart.
pub(super) fn decode(path: &Path, mut file: impl BufRead + Seek, shape: Shape) -> Result<DecodedPicture, InputError> {
    let in_words = |error| in_words(path, error);
    let meta = read_meta(&mut file).map_err(in_words)?;
    let (layer, note) = layers::choose(path, &meta.headers)?;
    let header = &meta.headers[layer.part];
    check_decoder(path, header)?;
    let placement = Placement::of(path, header, shape)?;
    let [width, height] = placement.size;
    let mut pixels = vec![[0.0; 3]; width * height];
    read_blocks(file, &meta, layer.part, |line| put(&mut pixels, &layer, header, &placement, line))
        .map_err(in_words)?;
    Ok(DecodedPicture {
        width,
        height,
        pixels,
        space: rgb_space(header),
        notes: note.into_iter().chain(placement.note()).collect(),
    })
}

fn read_meta(file: &mut (impl BufRead + Seek)) -> openexr::Result<MetaData> {
    let lenient = MetaData::read_from_buffered(&mut *file, false);
    if !matches!(lenient, Err(openexr::Error::Invalid(_))) {
        return lenient;
    }
    // A lenient reader takes an attribute that it does not know for a missing one, where a strict one tells why.
    file.rewind()?;
    match MetaData::read_from_buffered(file, true) {
        Err(reason @ openexr::Error::NotSupported(_)) => Err(reason),
        _ => lenient,
    }
}

/// Refuses what the decoder cannot do, before it calls the file invalid.
fn check_decoder(path: &Path, header: &Header) -> Result<(), InputError> {
    let unsupported = |reason: &str| Err(InputError::Unsupported { path: path.to_owned(), reason: reason.to_owned() });
    if matches!(header.compression, Compression::HTJ2K32 | Compression::HTJ2K256) {
        return unsupported("its compression is HTJ2K");
    }
    if header.channels.list.iter().any(|channel| channel.sampling != openexr::Vec2(1, 1)) {
        return unsupported("its channels are subsampled, like luminance and chroma channels");
    }
    Ok(())
}

/// Hands on each line of each channel of a part, in full resolution.
fn read_blocks(
    mut file: impl BufRead + Seek,
    meta: &MetaData,
    part: usize,
    mut take: impl FnMut(LineRef<'_>),
) -> openexr::Result<()> {
    let offsets = MetaData::read_offset_tables(&mut PeekRead::new(&mut file), &meta.headers)?;
    let header = &meta.headers[part];
    for (block, &offset) in header.blocks_increasing_y_order().zip(&offsets[part]) {
        if block.location.level_index != openexr::Vec2(0, 0) {
            continue;
        }
        file.seek(SeekFrom::Start(offset))?;
        let chunk = Chunk::read(&mut file, meta)?;
        if chunk.layer_index != part {
            return Err(openexr::Error::Invalid("a block of another part".into()));
        }
        UncompressedBlock::decompress_chunk(chunk, meta, false)?.lines(&header.channels).for_each(&mut take);
    }
    Ok(())
}

/// Puts a line of one channel where it belongs in the picture.
fn put(pixels: &mut [[f32; 3]], layer: &Layer, header: &Header, placement: &Placement, line: LineRef<'_>) {
    let openexr::Vec2(x, y) = line.location.position;
    let kind = header.channels.list[line.location.channel].sample_type;
    for component in (0..3).filter(|&component| layer.channels[component] == line.location.channel) {
        for (column, value) in samples(line.value, kind).enumerate() {
            if let Some(index) = placement.index(x + column, y) {
                pixels[index][component] = value;
            }
        }
    }
}

fn samples(bytes: &[u8], kind: SampleType) -> impl Iterator<Item = f32> {
    bytes.chunks_exact(kind.bytes_per_sample()).map(move |sample| match (kind, sample) {
        (SampleType::F16, &[a, b]) => f16::from_ne_bytes([a, b]).to_f32(),
        (SampleType::F32, &[a, b, c, d]) => f32::from_ne_bytes([a, b, c, d]),
        (SampleType::U32, &[a, b, c, d]) => u32::from_ne_bytes([a, b, c, d]) as f32,
        _ => f32::NAN,
    })
}

fn rgb_space(header: &Header) -> RgbSpace {
    let point = |xy: openexr::Vec2<f32>| DVec2::new(f64::from(xy.x()), f64::from(xy.y()));
    header
        .shared_attributes
        .chromaticities
        .map_or(BT709, |named| RgbSpace::stated([named.red, named.green, named.blue].map(point), point(named.white)))
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
