mod openexr_files;
mod radiance_files;

use std::fs;
use std::io::{Cursor, Write};
use std::path::PathBuf;

use ::exr::prelude as openexr;
use ::exr::prelude::WritableImage;
use glam::{DMat3, DVec3};
use tempfile::TempDir;

use super::super::chromaticities::CIE_XYZ;
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
    read_environment(&path, &mut Vec::new())
}

/// What is read, and what is told of it after the file's name.
fn load_told(name: &str, bytes: &[u8]) -> (Equirect, Vec<String>) {
    let (_folder, path) = file(name, bytes);
    let mut notes = Vec::new();
    let environment = read_environment(&path, &mut notes).unwrap_or_else(|error| panic!("{error}"));
    let told = |note: &String| note.strip_prefix(&format!("{} ", path.display())).expect(note).to_owned();
    (environment, notes.iter().map(told).collect())
}

/// The one line a user sees; must name the file.
fn message(name: &str, bytes: &[u8]) -> String {
    let (_folder, path) = file(name, bytes);
    let message = read_environment(&path, &mut Vec::new()).unwrap_err().to_string();
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
fn the_name_does_not_matter() {
    assert!(load("panorama.picture", &Exr::default().bytes()).is_ok());
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

/// Writes parts of one file, each flat and of the same size.
fn parts(layers: impl IntoIterator<Item = openexr::Layer<openexr::AnyChannels<openexr::FlatSamples>>>) -> Vec<u8> {
    let layers = layers.into_iter().collect::<openexr::Layers<_>>();
    let image = openexr::Image::from_layers(openexr::ImageAttributes::with_size((8, 4)), layers);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A part whose red tells it from others.
fn part(name: &str, channels: &[&str], red: f32) -> openexr::Layer<openexr::AnyChannels<openexr::FlatSamples>> {
    let channel = |name: &&str| {
        openexr::AnyChannel::new(
            *name,
            openexr::FlatSamples::F32(vec![if name.ends_with(['R', 'Y', 'r', 'd']) { red } else { 0.0 }; 32]),
        )
    };
    let attributes = openexr::LayerAttributes::named(name);
    let channels = openexr::AnyChannels::sort(channels.iter().map(channel).collect());
    openexr::Layer::new((8, 4), attributes, openexr::Encoding::UNCOMPRESSED, channels)
}

#[test]
fn missing_files_folders_and_empty_files_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let missing = read_environment(&folder.path().join("none.exr"), &mut Vec::new()).unwrap_err();
    assert!(matches!(missing, InputError::NotFound { .. }), "{missing}");
    let not_a_file = read_environment(folder.path(), &mut Vec::new()).unwrap_err();
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
fn impossible_light_is_repaired_and_counted() {
    let pixels = [[f32::NAN, 1.0, 1.0], [f32::INFINITY, 0.0, 0.0], [-1.0, -1.0, -1.0]];
    let mut panorama = vec![[1.0; 3]; 32];
    panorama[..3].copy_from_slice(&pixels);
    let environment = Equirect::new(8, 4, convert(panorama, BT709.to_bt2020().unwrap())).unwrap();
    let repairs = environment.repairs();
    assert_eq!((repairs.not_a_number, repairs.too_bright, repairs.negative), (1, 1, 1));

    let mut layer = part("", &["R", "G", "B"], 1.0);
    let openexr::FlatSamples::F32(blue) = &mut layer.channel_data.list[0].sample_data else { panic!() };
    blue[..4].copy_from_slice(&[f32::NAN, f32::INFINITY, -1e4, f32::NEG_INFINITY]);
    let (_, told) = load_told("a.exr", &parts([layer]));
    let expected = "1 NaN (made black), 2 negative (raised to 0), 1 brighter than 65000 or infinite (clamped)";
    assert_eq!(told, [format!("has pixels that no light can have: {expected}")]);
}
