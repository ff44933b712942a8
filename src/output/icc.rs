//! The ICC profile of Display P3, for readers of PNG files that know no newer tag (ICC.1:2022, version 4.4).

use glam::{DMat3, DVec3};

use crate::physics::colour::{DISPLAY_P3, adapted_to_d50};

/// The profile connection space's white, as the standard rounds it.
const D50: [f64; 3] = [0.9642, 1.0, 0.8249];
/// Bytes of the header.
const HEADER: usize = 128;

/// A matrix profile with the primaries of Display P3 and the curve of sRGB.
pub fn display_p3_profile() -> Vec<u8> {
    let (to_d50, adaptation) = adapted_to_d50(&DISPLAY_P3);
    let curve = parametric_curve();
    let tags: [(&[u8; 4], Vec<u8>); 10] = [
        (b"desc", text("Display P3")),
        (b"cprt", text("No copyright, use freely")),
        (b"wtpt", xyz(DVec3::from(D50))),
        (b"chad", matrix(adaptation)),
        (b"rXYZ", xyz(to_d50.x_axis)),
        (b"gXYZ", xyz(to_d50.y_axis)),
        (b"bXYZ", xyz(to_d50.z_axis)),
        (b"rTRC", curve.clone()),
        (b"gTRC", curve.clone()),
        (b"bTRC", curve),
    ];
    let mut table = (tags.len() as u32).to_be_bytes().to_vec();
    let mut data = Vec::new();
    let first = HEADER + 4 + 12 * tags.len();
    for (signature, content) in &tags {
        table.extend_from_slice(*signature);
        table.extend(((first + data.len()) as u32).to_be_bytes());
        table.extend((content.len() as u32).to_be_bytes());
        data.extend_from_slice(content);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    [header(first + data.len()), table, data].concat()
}

fn header(size: usize) -> Vec<u8> {
    let mut header = Vec::with_capacity(HEADER);
    header.extend((size as u32).to_be_bytes());
    // No preferred engine, version 4.4, a display, RGB to XYZ.
    header.extend_from_slice(b"\0\0\0\0\x04\x40\0\0mntrRGB XYZ ");
    // Made on 1 January 2026, at 0 o'clock.
    header.extend([2026_u16, 1, 1, 0, 0, 0].into_iter().flat_map(u16::to_be_bytes));
    header.extend_from_slice(b"acsp");
    header.resize(68, 0);
    D50.iter().for_each(|value| header.extend(fixed(*value)));
    header.resize(HEADER, 0);
    header
}

/// s15Fixed16Number.
fn fixed(value: f64) -> [u8; 4] {
    ((value * 65536.0).round() as i32).to_be_bytes()
}

fn numbers(kind: &[u8; 4], values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    let mut bytes = kind.to_vec();
    bytes.extend([0; 4]);
    bytes.extend(values.into_iter().flat_map(fixed));
    bytes
}

fn xyz(value: DVec3) -> Vec<u8> {
    numbers(b"XYZ ", value.to_array())
}

fn matrix(matrix: DMat3) -> Vec<u8> {
    numbers(b"sf32", matrix.transpose().to_cols_array())
}

/// sRGB's curve, function type 3: (a x + b)^g from d on, c x below.
fn parametric_curve() -> Vec<u8> {
    let mut bytes = b"para\0\0\0\0\0\x03\0\0".to_vec();
    let parameters = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045];
    bytes.extend(parameters.into_iter().flat_map(fixed));
    bytes
}

/// multiLocalizedUnicodeType with one text in English.
fn text(text: &str) -> Vec<u8> {
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let mut bytes = b"mluc\0\0\0\0".to_vec();
    bytes.extend([1_u32, 12].into_iter().flat_map(u32::to_be_bytes));
    bytes.extend_from_slice(b"enUS");
    bytes.extend([utf16.len() as u32, 28].into_iter().flat_map(u32::to_be_bytes));
    bytes.extend(utf16);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_places_fit() {
        let profile = display_p3_profile();
        let number = |at: usize| u32::from_be_bytes(profile[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(number(0), profile.len());
        assert_eq!(&profile[36..40], b"acsp");
        assert_eq!(number(HEADER), 10);
        for tag in 0..10 {
            let entry = HEADER + 4 + 12 * tag;
            let (first, size) = (number(entry + 4), number(entry + 8));
            assert!(first.is_multiple_of(4) && first + size <= profile.len());
        }
    }

    #[test]
    fn primaries_add_up_to_the_white_of_the_connection_space() {
        let (to_d50, _) = adapted_to_d50(&DISPLAY_P3);
        // Display P3's red in ICC profiles of displays: 0.5151, 0.2412, -0.0011.
        assert!((to_d50 * DVec3::ONE - DVec3::from(D50)).abs().max_element() < 3e-4);
        assert!((to_d50.x_axis - DVec3::new(0.5151, 0.2412, -0.0011)).abs().max_element() < 2e-4);
    }
}
