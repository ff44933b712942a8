use std::fs;
use std::io::{Cursor, Write};
use std::path::PathBuf;

use ::exr::prelude as openexr;
use ::exr::prelude::WritableImage;
use glam::{DMat3, DVec3};
use tempfile::TempDir;

use super::super::chromaticities::BT709;
use super::*;

/// Half-float values of a small panorama, different in every pixel.
fn panorama(width: usize, height: usize) -> Vec<[f32; 3]> {
    (0..width * height).map(|i| [i as f32 + 0.5, 2.0 * i as f32, 0.25]).collect()
}

/// An OpenEXR file in memory, as another program would write it.
struct Exr {
    size: (usize, usize),
    names: [&'static str; 3],
    compression: openexr::Compression,
    chromaticities: Option<openexr::attribute::Chromaticities>,
    half: bool,
}

impl Default for Exr {
    fn default() -> Self {
        let compression = openexr::Compression::ZIP16;
        Self { size: (8, 4), names: ["R", "G", "B"], compression, chromaticities: None, half: false }
    }
}

impl Exr {
    fn layer(&self) -> openexr::Layer<openexr::AnyChannels<openexr::FlatSamples>> {
        let pixels = panorama(self.size.0, self.size.1);
        let channel = |i: usize| {
            let samples = pixels.iter().map(|pixel: &[f32; 3]| pixel[i]);
            let samples = if self.half {
                openexr::FlatSamples::F16(samples.map(openexr::f16::from_f32).collect())
            } else {
                openexr::FlatSamples::F32(samples.collect())
            };
            openexr::AnyChannel::new(self.names[i], samples)
        };
        let encoding = openexr::Encoding { compression: self.compression, ..openexr::Encoding::FAST_LOSSLESS };
        let attributes = openexr::LayerAttributes::named(self.names[0]);
        openexr::Layer::new(self.size, attributes, encoding, openexr::AnyChannels::sort((0..3).map(channel).collect()))
    }

    fn bytes(&self) -> Vec<u8> {
        let mut image = openexr::Image::from_layer(self.layer());
        image.attributes.chromaticities = self.chromaticities;
        let mut file = Cursor::new(Vec::new());
        image.write().to_buffered(&mut file).unwrap();
        file.into_inner()
    }
}

/// A file of these bytes; the folder lives as long as the test holds it.
fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn load(name: &str, bytes: &[u8]) -> Result<Equirect, InputError> {
    let (_folder, path) = file(name, bytes);
    read_environment(&path)
}

/// The one line a user sees; must name the file.
fn message(name: &str, bytes: &[u8]) -> String {
    let (_folder, path) = file(name, bytes);
    let message = read_environment(&path).unwrap_err().to_string();
    assert!(message.contains(&path.display().to_string()), "{message}");
    assert!(!message.contains('\n'), "{message}");
    message
}

fn assert_pixels(environment: &Equirect, to_bt2020: DMat3) {
    let expected = panorama(environment.width(), environment.height());
    assert_eq!(environment.pixels().len(), expected.len());
    for (&pixel, expected) in environment.pixels().iter().zip(expected) {
        let expected = to_bt2020 * DVec3::from_array(expected.map(f64::from));
        // f32 rounding of a sum of three products.
        let error = Vec3::from(pixel).as_dvec3().distance(expected);
        assert!(error <= 1e-6 * expected.length(), "{pixel:?}, expected {expected}");
    }
}

#[test]
fn reads_every_lossless_compression_and_sample_type() {
    use openexr::Compression::{PIZ, RLE, Uncompressed, ZIP1, ZIP16};
    for compression in [Uncompressed, RLE, ZIP1, ZIP16, PIZ] {
        for half in [false, true] {
            let environment = load("a.exr", &Exr { compression, half, ..Exr::default() }.bytes()).unwrap();
            assert_eq!((environment.width(), environment.height()), (8, 4));
            assert_pixels(&environment, BT709.to_bt2020().unwrap());
        }
    }
}

#[test]
fn reads_lossy_compressions() {
    for compression in [openexr::Compression::DWAA(None), openexr::Compression::DWAB(None)] {
        let picture = Exr { size: (64, 32), compression, half: true, ..Exr::default() };
        let environment = load("a.exr", &picture.bytes()).unwrap();
        let expected = convert(panorama(64, 32), BT709.to_bt2020().unwrap());
        for (&pixel, expected) in environment.pixels().iter().zip(expected) {
            // The compression's default level promises about 1 % of what the eye would see; dark pixels beside bright ones
            // fare worse.
            let error = Vec3::from(pixel).distance(Vec3::from(expected));
            assert!(error < 0.02 * Vec3::from(expected).length() + 2.0, "{pixel:?}, expected {expected:?}");
        }
    }
}

#[test]
fn the_name_does_not_matter() {
    assert!(load("panorama.picture", &Exr::default().bytes()).is_ok());
}

#[test]
fn honours_chromaticities() {
    let point = |x, y| openexr::Vec2(x, y);
    let chromaticities = openexr::attribute::Chromaticities {
        red: point(0.708, 0.292),
        green: point(0.170, 0.797),
        blue: point(0.131, 0.046),
        white: point(0.3127, 0.3290),
    };
    let environment = load("a.exr", &Exr { chromaticities: Some(chromaticities), ..Exr::default() }.bytes()).unwrap();
    assert_pixels(&environment, DMat3::IDENTITY);

    let grey =
        openexr::attribute::Chromaticities { red: chromaticities.blue, green: chromaticities.blue, ..chromaticities };
    let message = message("a.exr", &Exr { chromaticities: Some(grey), ..Exr::default() }.bytes());
    assert!(message.contains("chromaticities"), "{message}");
}

#[test]
fn finds_colours_in_named_channels_and_later_layers() {
    let named = Exr { names: ["light.R", "light.G", "light.B"], ..Exr::default() };
    assert_pixels(&load("a.exr", &named.bytes()).unwrap(), BT709.to_bt2020().unwrap());

    let depth = Exr { names: ["X", "Y", "Z"], ..Exr::default() };
    let layers = [depth.layer(), named.layer()].into_iter().collect::<openexr::Layers<_>>();
    let image = openexr::Image::from_layers(openexr::ImageAttributes::with_size((8, 4)), layers);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    assert_pixels(&load("a.exr", &bytes.into_inner()).unwrap(), BT709.to_bt2020().unwrap());
}

#[test]
fn pictures_without_colours_are_refused() {
    let message = message("a.exr", &Exr { names: ["X", "Y", "Z"], ..Exr::default() }.bytes());
    assert!(message.ends_with("has no layer with R, G and B channels (it has X, Y, Z): save it as RGB"), "{message}");
}

#[test]
fn sizes_out_of_range_are_refused_before_pixels_are_read() {
    let refused = |size| message("a.exr", &Exr { size, ..Exr::default() }.bytes());
    assert!(refused((8, 8)).contains("has 8x8 pixels, but an environment is an equirectangular panorama"));
    assert!(refused((1, 1)).contains("has only 1x1 pixels"));
    assert!(load("a.exr", &Exr { size: (2, 1), ..Exr::default() }.bytes()).is_ok());

    let header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n";
    assert!(message("a.hdr", header.as_bytes()).ends_with("has 16384x8192 pixels: scale it down to 8192x4096 or less"));
    let monster = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4294967295 +X 4294967295\n";
    message("a.hdr", monster.as_bytes());
}

#[test]
fn cropped_pictures_are_refused() {
    let mut image = openexr::Image::from_layer(Exr::default().layer());
    image.attributes.display_window.size = openexr::Vec2(16, 8);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    let message = message("a.exr", &bytes.into_inner());
    assert!(message.contains("its data window is not its display window"), "{message}");
}

#[test]
fn missing_files_folders_and_empty_files_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let missing = read_environment(&folder.path().join("none.exr")).unwrap_err();
    assert!(matches!(missing, InputError::NotFound { .. }), "{missing}");
    let not_a_file = read_environment(folder.path()).unwrap_err();
    assert!(matches!(not_a_file, InputError::Folder { .. }), "{not_a_file}");
    assert!(message("a.exr", b"").ends_with("is empty: save or copy it again"));
}

#[test]
fn other_formats_are_refused_whatever_their_name() {
    for bytes in [&b"this is text\n"[..], b"v", b"\x89PNG\r\n\x1a\n0000"] {
        assert!(message("a.exr", bytes).contains("neither an OpenEXR nor a Radiance"));
    }
}

#[test]
fn a_file_cut_short_anywhere_is_damaged() {
    for compression in [openexr::Compression::ZIP16, openexr::Compression::PIZ, openexr::Compression::Uncompressed] {
        let bytes = Exr { size: (64, 32), compression, ..Exr::default() }.bytes();
        for length in (4..bytes.len()).step_by(97) {
            let error = load("a.exr", &bytes[..length]).unwrap_err();
            assert!(matches!(error, InputError::Damaged { .. }), "{length} bytes of {}: {error}", bytes.len());
        }
    }
}

#[test]
fn no_flipped_byte_panics() {
    for compression in [openexr::Compression::ZIP16, openexr::Compression::PIZ, openexr::Compression::DWAA(None)] {
        let bytes = Exr { size: (16, 8), compression, half: true, ..Exr::default() }.bytes();
        for position in 4..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[position] ^= [0xff, 0x80, 0x01][position % 3];
            // Flips in pixels, names or comments may leave a good file: an error or a picture, both are fine.
            let _ = load("a.exr", &damaged);
        }
    }
}

/// A Radiance picture without run lengths: (mantissas, exponent) for every pixel.
fn radiance(header: &str, width: usize, height: usize, pixel: [u8; 4]) -> Vec<u8> {
    let mut bytes = format!("{header}\n\n-Y {height} +X {width}\n").into_bytes();
    (0..width * height).for_each(|_| bytes.write_all(&pixel).unwrap());
    bytes
}

#[test]
fn reads_radiance_pictures_with_their_headers() {
    // Mantissa 128 of exponent 129 is 128/256 · 2 = 1; of 127 and 128 it is 1/4 and 1/2.
    let first = |header: &str| load("a.hdr", &radiance(header, 4, 2, [128, 128, 128, 129])).unwrap().pixels()[0];
    let white = first("#?RADIANCE\nFORMAT=32-bit_rle_rgbe");
    assert!(Vec3::from(white).distance(Vec3::ONE) < 1e-6, "{white:?}");
    assert_eq!(first("#?RGBE\nFORMAT=32-bit_rle_rgbe"), white);
    let halved = first("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2.0");
    assert!(Vec3::from(halved).distance(Vec3::splat(0.5)) < 1e-6, "{halved:?}");

    let red =
        radiance("#?RADIANCE\nPRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290", 4, 2, [128, 0, 0, 129]);
    let red = load("a.hdr", &red).unwrap().pixels()[0];
    assert!(Vec3::from(red).distance(Vec3::X) < 1e-6, "{red:?}");
}

#[test]
fn radiance_pictures_cut_short_are_damaged() {
    let bytes = radiance("#?RADIANCE\nFORMAT=32-bit_rle_rgbe", 4, 2, [128, 128, 128, 129]);
    for length in 2..bytes.len() {
        let error = load("a.hdr", &bytes[..length]).unwrap_err();
        assert!(!matches!(error, InputError::Unreadable { .. }), "{length} bytes: {error}");
    }
}

#[test]
fn impossible_light_is_repaired_and_counted() {
    let pixels = [[f32::NAN, 1.0, 1.0], [f32::INFINITY, 0.0, 0.0], [-1.0, -1.0, -1.0]];
    let mut panorama = vec![[1.0; 3]; 32];
    panorama[..3].copy_from_slice(&pixels);
    let environment = Equirect::new(8, 4, convert(panorama, BT709.to_bt2020().unwrap())).unwrap();
    let repairs = environment.repairs();
    assert_eq!((repairs.not_a_number, repairs.too_bright, repairs.negative), (1, 1, 1));
}
