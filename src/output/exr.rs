//! OpenEXR pictures: numbers to measure, not to look at.

use std::io::{self, Seek, Write};
use std::path::Path;

use ::exr::prelude as openexr;
use ::exr::prelude::WritableImage;

use super::{FrameRate, Metadata, OutputError, write_atomically};

/// The primaries that a picture's header names, all with D65 white; other channels than colours need none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExrPrimaries {
    /// ITU-R BT.709: what pictures are written in.
    Bt709,
    /// ITU-R BT.2020: the program's own, for its tables.
    Bt2020,
}

/// How many bits a sample takes in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Samples {
    Half,
    Single,
}

/// A picture of `N` channels to be written, ZIP-compressed.
#[derive(Debug, Clone, Copy)]
pub struct ExrPicture<'a, const N: usize> {
    /// Pixels in a row, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
    /// The channels' names in the order of a pixel's values: `["R", "G", "B"]`, or as a table needs; ASCII, no two equal.
    pub channels: [&'a str; N],
    /// Row by row from the top left; [`Self::save`] stores them bit for bit.
    pub pixels: &'a [[f32; N]],
    /// The primaries of R, G and B.
    pub primaries: Option<ExrPrimaries>,
    /// Metadata, one line `key: value` each in the `comments` attribute.
    pub metadata: &'a Metadata,
}

impl<const N: usize> ExrPicture<'_, N> {
    /// Writes the picture as a file, whole or not at all. Equal pictures give equal bytes.
    ///
    /// # Errors
    /// Those of [`write_atomically`], and content that the format cannot hold: no pixels, a wrong count of them, or channel
    /// names that are empty, equal or not ASCII.
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        write_atomically(path, |writer| self.encode(writer))
    }

    /// As [`Self::save`], each sample rounded to the nearest half float.
    ///
    /// # Errors
    /// Those of [`Self::save`].
    pub fn save_halves(&self, path: &Path) -> Result<(), OutputError> {
        write_atomically(path, |writer| self.encode_as(Samples::Half, writer))
    }

    /// Encodes the picture, bit for bit, into any writer that can seek.
    ///
    /// # Errors
    /// The writer's, and content that the format cannot hold.
    pub fn encode(&self, writer: impl Write + Seek) -> io::Result<()> {
        self.encode_as(Samples::Single, writer)
    }

    fn encode_as(&self, samples: Samples, writer: impl Write + Seek) -> io::Result<()> {
        self.check()?;
        write([self.width, self.height], self.any_channels(samples), self.primaries, self.metadata, writer)
    }

    fn check(&self) -> io::Result<()> {
        let wrong = |reason: String| Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        let Self { width, height, channels, pixels, .. } = self;
        if pixels.is_empty() || width.checked_mul(*height) != Some(pixels.len()) {
            return wrong(format!("{} pixels do not make a picture of {width}x{height}", pixels.len()));
        }
        let bad = |i: usize| channels[i].is_empty() || !channels[i].is_ascii() || channels[..i].contains(&channels[i]);
        if N == 0 || (0..N).any(bad) {
            return wrong(format!("{channels:?} cannot be channel names"));
        }
        Ok(())
    }

    fn any_channels(&self, samples: Samples) -> openexr::AnyChannels<openexr::FlatSamples> {
        let channel = |i: usize| {
            let values = self.pixels.iter().map(|pixel| pixel[i]);
            let samples = match samples {
                Samples::Half => openexr::FlatSamples::F16(values.map(openexr::f16::from_f32).collect()),
                Samples::Single => openexr::FlatSamples::F32(values.collect()),
            };
            openexr::AnyChannel::new(self.channels[i], samples)
        };
        openexr::AnyChannels::sort((0..N).map(channel).collect())
    }
}

/// Writes channels that are checked and sorted. Equal ones give equal bytes.
pub(super) fn write(
    [width, height]: [usize; 2],
    channels: openexr::AnyChannels<openexr::FlatSamples>,
    primaries: Option<ExrPrimaries>,
    metadata: &Metadata,
    writer: impl Write + Seek,
) -> io::Result<()> {
    let encoding = openexr::Encoding {
        compression: openexr::Compression::ZIP16,
        blocks: openexr::Blocks::ScanLines,
        // Blocks in a fixed order, however many threads compress them.
        line_order: openexr::LineOrder::Increasing,
    };
    let layer = openexr::Layer::new((width, height), layer_attributes(metadata), encoding, channels);
    let mut image = openexr::Image::from_layer(layer);
    image.attributes.chromaticities = primaries.map(chromaticities);
    image.attributes.time_code = metadata.frame().and_then(|(rate, frame)| time_code(rate, frame));
    image.write().to_buffered(writer).map_err(in_io)
}

/// All metadata goes into one attribute: the `exr` crate keeps custom attributes in a hash map and would write them in
/// another order each time.
fn layer_attributes(metadata: &Metadata) -> openexr::LayerAttributes {
    let comments = metadata.to_lines();
    openexr::LayerAttributes {
        software_name: Some(openexr::Text::from(concat!("soapfilm ", env!("CARGO_PKG_VERSION")))),
        comments: (!comments.is_empty()).then(|| openexr::Text::from_slice_unchecked(comments.as_bytes())),
        frames_per_second: metadata.frame().map(|(rate, _)| {
            let [numerator, denominator] = rate.ratio();
            (numerator as i32, denominator)
        }),
        ..Default::default()
    }
}

/// ITU-R BT.709-6 and BT.2020-2, table "colorimetry".
fn chromaticities(primaries: ExrPrimaries) -> openexr::attribute::Chromaticities {
    let [red, green, blue] = match primaries {
        ExrPrimaries::Bt709 => [(0.640, 0.330), (0.300, 0.600), (0.150, 0.060)],
        ExrPrimaries::Bt2020 => [(0.708, 0.292), (0.170, 0.797), (0.131, 0.046)],
    };
    let [red, green, blue, white] = [red, green, blue, (0.3127, 0.3290)].map(|(x, y)| openexr::Vec2(x, y));
    openexr::attribute::Chromaticities { red, green, blue, white }
}

fn time_code(rate: FrameRate, frame: u64) -> Option<openexr::attribute::TimeCode> {
    let [hours, minutes, seconds, frame] = rate.time_code(frame)?;
    Some(openexr::attribute::TimeCode { hours, minutes, seconds, frame, ..Default::default() })
}

fn in_io(error: openexr::Error) -> io::Error {
    match error {
        openexr::Error::Io(reason) => reason,
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::read_back::read_exr;
    use super::*;

    /// Values that only bit-exact storage keeps: a tiny one, a negative one, the largest, an infinity.
    const ODD_PIXELS: [[f32; 3]; 4] =
        [[1e-40, -0.0, -7.5], [f32::MAX, f32::INFINITY, 0.1], [1.0, 2.0, 3.0], [65504.5, 1e-10, 0.333_333_34]];

    fn picture(metadata: &Metadata) -> ExrPicture<'_, 3> {
        ExrPicture {
            width: 2,
            height: 2,
            channels: ["R", "G", "B"],
            pixels: &ODD_PIXELS,
            primaries: Some(ExrPrimaries::Bt709),
            metadata,
        }
    }

    fn bytes<const N: usize>(picture: &ExrPicture<'_, N>) -> Vec<u8> {
        let mut file = io::Cursor::new(Vec::new());
        picture.encode(&mut file).unwrap();
        file.into_inner()
    }

    #[test]
    fn comes_back_bit_for_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let metadata = Metadata::new().with("Scene", "Jürgen µ").with("Time", "0.1");
        picture(&metadata).save(&path).unwrap();
        let read = read_exr(&path).unwrap();
        assert_eq!((read.width, read.height), (2, 2));
        assert_eq!(read.metadata, metadata);
        assert_eq!(read.chromaticities, Some([[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]]));
        for (i, name) in ["R", "G", "B"].into_iter().enumerate() {
            let bits = |samples: &mut dyn Iterator<Item = f32>| samples.map(f32::to_bits).collect::<Vec<_>>();
            let samples = read.channel(name).unwrap();
            assert_eq!(
                bits(&mut samples.iter().copied()),
                bits(&mut ODD_PIXELS.iter().map(|pixel| pixel[i])),
                "{name}"
            );
        }
    }

    #[test]
    fn frames_of_a_sequence_have_the_standard_attributes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let saved = |metadata: &Metadata| {
            picture(metadata).save(&path).unwrap();
            let read = read_exr(&path).unwrap();
            (read.frames_per_second, read.time_code)
        };
        assert_eq!(saved(&Metadata::new()), (None, None));
        let of = |rate: &str| Metadata::new().of_frame(rate.parse().unwrap(), 49);
        assert_eq!(saved(&of("24000/1001")), (Some([24000, 1001]), Some([0, 0, 2, 1])));
        assert_eq!(saved(&of("120")), (Some([120, 1]), None));
    }

    #[test]
    fn halves_are_the_nearest() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        picture(&Metadata::new()).save_halves(&path).unwrap();
        let read = read_exr(&path).unwrap();
        // Halves between 0.25 and 0.5 lie 2^-12 apart.
        let third = read.channel("B").unwrap()[3];
        assert!(third != 0.333_333_34 && (third - 0.333_333_34).abs() <= 0.5 / 4096.0, "{third}");
        assert_eq!(read.channel("G").unwrap()[2], 2.0);
    }

    #[test]
    fn equal_pictures_give_equal_bytes() {
        let metadata = ["Scene", "Time", "Adapter", "Driver", "Quality"]
            .iter()
            .fold(Metadata::new(), |all, key| all.with(key, "x"));
        // Enough rows for many blocks, which threads finish in any order.
        let pixels: Vec<[f32; 4]> = (0..64 * 300).map(|i| [i as f32, (i as f32).sin(), 0.5, 1.0]).collect();
        let picture = ExrPicture {
            width: 64,
            height: 300,
            channels: ["R", "G", "B", "A"],
            pixels: &pixels,
            primaries: None,
            metadata: &metadata,
        };
        let first = bytes(&picture);
        for _ in 0..5 {
            assert!(bytes(&picture) == first);
        }
    }

    #[test]
    fn any_channel_names_and_counts_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.exr");
        let metadata = Metadata::new();
        let picture = ExrPicture {
            width: 1,
            height: 2,
            channels: ["s", "p"],
            pixels: &[[1.0, 2.0], [3.0, 4.0]],
            primaries: None,
            metadata: &metadata,
        };
        picture.save(&path).unwrap();
        let read = read_exr(&path).unwrap();
        assert_eq!(read.channel("s"), Some(&[1.0, 3.0][..]));
        assert_eq!(read.channel("p"), Some(&[2.0, 4.0][..]));
        assert_eq!((read.channel("R"), read.chromaticities), (None, None));
    }

    #[test]
    fn content_that_does_not_fit_is_an_error_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let metadata = Metadata::new();
        let good = picture(&metadata);
        let wrong = [
            ExrPicture { width: 3, ..good },
            ExrPicture { width: 0, height: 0, pixels: &[], ..good },
            ExrPicture { channels: ["R", "G", "R"], ..good },
            ExrPicture { channels: ["R", "", "B"], ..good },
            ExrPicture { channels: ["R", "é", "B"], ..good },
        ];
        for picture in wrong {
            picture.save(&folder.path().join("a.exr")).unwrap_err();
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }
}
