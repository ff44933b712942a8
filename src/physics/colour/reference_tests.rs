//! The film's colours against an independent computation: transfer matrices by `tmm`, colorimetry by `colour-science`.

use glam::DVec3;

use super::{BT709, FilmOptics, Illuminant, Walls};
use crate::physics::optics::FilmIndex;

const TABLE: &str = include_str!("../../../tests/data/optics_public.csv");
const ROWS: usize = 225;

/// What a row of the table holds, with the columns that its heading names.
struct Row {
    cos_theta: f64,
    thickness_nm: f64,
    xyz: DVec3,
    srgb: DVec3,
    /// (wavelength in nm, reflectance).
    spectrum: Vec<(f64, f64)>,
}

fn rows() -> Vec<Row> {
    let mut lines = TABLE.lines().filter(|line| !line.starts_with('#'));
    let heading: Vec<&str> = lines.next().expect("heading").split(',').collect();
    lines.map(|line| parse(&heading, &line.split(',').collect::<Vec<_>>())).collect()
}

fn parse(heading: &[&str], fields: &[&str]) -> Row {
    let text = |name: &str| fields[heading.iter().position(|&column| column == name).expect(name)];
    let number = |name: &str| -> f64 { text(name).parse().expect(name) };
    assert_eq!((text("film"), text("illuminant")), ("water", "D65"));
    let wavelengths = heading.iter().filter_map(|name| name.strip_prefix('R')?.parse::<f64>().ok());
    Row {
        cos_theta: number("cos_theta"),
        thickness_nm: number("d_nm"),
        xyz: DVec3::new(number("X"), number("Y"), number("Z")),
        srgb: DVec3::new(number("rgb_r"), number("rgb_g"), number("rgb_b")),
        spectrum: wavelengths.map(|nm| (nm, number(&format!("R{nm}")))).collect(),
    }
}

/// The largest of `error(row)` over the whole table.
fn worst(error: impl FnMut(&Row) -> f64) -> f64 {
    let rows = rows();
    assert_eq!(rows.len(), ROWS);
    rows.iter().map(error).fold(0.0, |worst, error| if error <= worst { worst } else { error })
}

fn water() -> FilmOptics {
    FilmOptics::new(FilmIndex::Water, &Illuminant::default())
}

#[test]
fn colours_equal_the_reference() {
    let optics = water();
    let colour = |row: &Row| optics.xyz(row.cos_theta, Walls::One { thickness_nm: row.thickness_nm });
    let xyz = worst(|row| (colour(row) - row.xyz).abs().max_element());
    let srgb = worst(|row| (BT709.from_xyz() * colour(row) - row.srgb).abs().max_element());
    // Measured 2.4e-15 and 3.7e-15: rounding, of sums of 421 terms and of tmm's complex matrices; other platforms' sines get the rest.
    assert!(xyz < 1e-14 && srgb < 2e-14, "XYZ {xyz:e}, sRGB {srgb:e}");
}

#[test]
fn spectra_equal_the_reference() {
    let optics = water();
    let error = |row: &Row| {
        assert_eq!(row.spectrum.len(), 7);
        let found = optics.spectrum(row.cos_theta, Walls::One { thickness_nm: row.thickness_nm });
        let at = |nm: f64| found.iter().find(|point| point.wavelength_nm == nm).expect("every 5 nm").reflectance;
        row.spectrum.iter().map(|&(nm, r)| (at(nm) - r).abs()).fold(0.0, f64::max)
    };
    let worst = worst(error);
    // Measured 1.6e-14, near grazing, where narrow fringes magnify the rounding of the phase.
    assert!(worst < 1e-13, "{worst:e}");
}

#[test]
fn a_wrong_film_would_be_noticed() {
    let thicker = |row: &Row| water().xyz(row.cos_theta, Walls::One { thickness_nm: row.thickness_nm + 1e-6 });
    assert!(worst(|row| (thicker(row) - row.xyz).abs().max_element()) > 1e-11);
    assert!(worst(|_| f64::NAN).is_nan());
}
