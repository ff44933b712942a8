//! A picture of the colours that a film shows as its thickness grows.

use std::path::Path;

use glam::{DMat3, DVec3};

use crate::{
    output::{Metadata, OutputError, Picture},
    physics::{
        colour::{BT2020, Display, Gamut, daylight_scale},
        optics::FilmMaterial,
    },
};

/// Thickness of the last column: one column per nanometre, the first without film.
pub const LAST_NM: u32 = 1500;
const HEIGHT: u32 = 120;

/// Saves the colours of the columns, XYZ where a perfect mirror has Y = 1, exposed so that the maximum reflected by the film is white.
pub fn save(path: &Path, colours: &[DVec3], film: &FilmMaterial, metadata: &Metadata) -> Result<(), OutputError> {
    let exposure_ev = -film.max_reflectance(1.0).max(1e-3).log2();
    let display = Display { exposure_ev, balance: DMat3::IDENTITY, gamut: Gamut::Srgb, dither: None };
    let row = colours.iter().flat_map(|xyz| {
        let [r, g, b] = display.encode(daylight_scale() * (BT2020.from_xyz() * *xyz), [0, 0]);
        [r, g, b, u8::MAX]
    });
    let rgba = row.collect::<Vec<u8>>().repeat(HEIGHT as usize);
    Picture::Display { size: [colours.len() as u32, HEIGHT], gamut: Gamut::Srgb, rgba }.save(path, metadata)
}
