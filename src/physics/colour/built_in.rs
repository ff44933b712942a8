//! The built-in illuminants: one table, which names, parsing, the light panel, the help and the tests follow. A new illuminant is a row here, its
//! data, and its name in the help of `illuminant` in `scene/light.rs`, from which the page of the scene format is written.

use serde::{Deserialize, Serialize};

use crate::physics::spectra::Spectrum;

/// All of a lamp's light at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Where it is, 360 to 780 nm.
    pub wavelength_nm: f64,
    /// Its power, in the unit of the continuous spectrum times one nanometre.
    pub power: f64,
}

/// An illuminant that has a name.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// Its name, which is read in any case.
    pub name: &'static str,
    /// What it is, in a few words.
    pub help: &'static str,
    power: Power,
}

/// Where the spectral power of an illuminant comes from.
#[derive(Clone, Copy, Debug)]
enum Power {
    /// The text of a CSV file of wavelengths and powers.
    Table(&'static str),
    /// The same at every wavelength.
    Equal,
    /// Lines alone.
    Lines(&'static [Line]),
}

/// A row whose spectrum is a file of `assets/spectra/`.
macro_rules! table {
    ($name:literal, $help:literal, $file:literal) => {
        BuiltIn {
            name: $name,
            help: $help,
            power: Power::Table(include_str!(concat!("../../../assets/spectra/", $file))),
        }
    };
}

/// The sodium doublet D₂, D₁ in air, nm, and relative powers of a thin vapour lamp (NIST Atomic Spectra Database).
const SODIUM: [Line; 2] = [Line { wavelength_nm: 588.995, power: 2.0 }, Line { wavelength_nm: 589.592, power: 1.0 }];

/// All built-in illuminants, the default first.
pub const BUILT_IN: &[BuiltIn] = &[
    table!("D65", "Daylight, 6500 K", "illuminant_d65.csv"),
    table!("D50", "Daylight at the horizon, 5000 K", "illuminant_d50.csv"),
    table!("A", "Incandescent lamp, 2856 K", "illuminant_a.csv"),
    BuiltIn { name: "E", help: "Equal power at every wavelength", power: Power::Equal },
    table!("FL2", "Fluorescent lamp, broad bands", "illuminant_fl2.csv"),
    table!("FL11", "Fluorescent lamp, three narrow bands", "illuminant_fl11.csv"),
    table!("LED", "White LED: a blue one and a phosphor", "illuminant_led_b3.csv"),
    table!("LED-B1", "Warm white LED, 2733 K: a blue one and a phosphor", "illuminant_led_b1.csv"),
    BuiltIn { name: "sodium", help: "Sodium street lamp: two yellow lines", power: Power::Lines(&SODIUM) },
];

impl BuiltIn {
    /// The illuminant of a name in any case, if there is one.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        BUILT_IN.iter().find(|light| light.name.eq_ignore_ascii_case(name))
    }

    /// All names in the order of the table, separated by commas.
    #[must_use]
    pub fn names() -> String {
        BUILT_IN.iter().map(|light| light.name).collect::<Vec<_>>().join(", ")
    }

    /// The continuous spectrum, and the lines beside it.
    pub(super) fn light(&self) -> (Spectrum, Vec<Line>) {
        match self.power {
            // The text is part of the program, and a test parses every built-in.
            Power::Table(text) => (
                Spectrum::from_csv(self.name, text, &mut Vec::new()).expect("built-in illuminants are valid"),
                Vec::new(),
            ),
            Power::Equal => (Spectrum::constant(1.0), Vec::new()),
            Power::Lines(lines) => (Spectrum::constant(0.0), lines.to_vec()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::colour::{ColourWeights, Illuminant};

    #[test]
    fn every_illuminant_is_seen_and_has_a_name_of_its_own() {
        for light in BUILT_IN {
            assert_eq!(BuiltIn::named(&light.name.to_lowercase()).map(|found| found.name), Some(light.name));
            let illuminant = Illuminant::from(light);
            if let Power::Table(_) = light.power {
                assert!(Illuminant::new(light.name, illuminant.spectrum().clone()).is_ok(), "{}", light.name);
            }
            assert_eq!(illuminant.is_monochromatic(), light.name == "sodium", "{}", light.name);
            assert!(!light.help.is_empty());
        }
    }

    #[test]
    fn the_readme_of_scenes_lists_all_of_them() {
        let readme = include_str!("../../../assets/scenes/README.md");
        let row = readme.lines().find(|line| line.starts_with("| `illuminant` |")).expect("the key has a row");
        let listed = BUILT_IN.iter().map(|light| format!("`\"{}\"`", light.name)).collect::<Vec<_>>().join(", ");
        assert!(
            row.contains(&format!("has: {listed}, a black body")),
            "name {listed} in the help of `illuminant`, src/scene/light.rs"
        );
    }

    #[test]
    fn whites_of_lamps_are_the_published_ones() {
        // CIE 015:2018, chromaticities to four digits; LED is LED-B3. Sums at 1 nm and at 5 nm differ in the fourth.
        let published =
            [("FL2", 0.3721, 0.3751), ("FL11", 0.3805, 0.3769), ("LED", 0.3756, 0.3723), ("LED-B1", 0.4560, 0.4078)];
        for (name, x, y) in published {
            let xyz = ColourWeights::new(&name.parse().expect("built in")).white();
            let (found_x, found_y) = (xyz.x / xyz.element_sum(), xyz.y / xyz.element_sum());
            assert!((found_x - x).abs() < 1.5e-3 && (found_y - y).abs() < 1.5e-3, "{name}: {found_x} {found_y}");
        }
    }
}
