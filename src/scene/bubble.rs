//! A bubble and its film.

use super::{
    Boundary, Key,
    check::{self, Checked, Fault},
    is_table,
    section::{Value, section},
    shorten,
};
use crate::words::words;
use serde::{Deserialize, Serialize};

/// Thinnest mean film that can flow, nm: its logarithm drives the buoyancy, so it must not vanish.
const MIN_FLOWING_NM: f64 = 1.0;

/// Radius in mm beyond which bubbles are no spheres: there the weight of a film of 1 µm, ρ g h, is a tenth of the pressure inside, 4γ/R with
/// γ = 25 mN/m.
const ROUND_MM: f64 = 1000.0;

section! {
    /// A spherical bubble: one `[[bubble]]`.
    pub struct Bubble, BubbleKeys: [
        film: Film = Film::default(), "The film at tick 0";
    ]
    center_m: [f64; 3] = [0.0; 3], [-1000.0 ..= 1000.0], "Center", " m", "center, m";
    radius_mm: f64 = 50.0, [0.1 ..= 5000.0], "Radius", " mm", "radius, mm";
    boundary: Boundary = Boundary::Free, [word], "Boundary", "", "boundary of the film";
    rim_deg: f64 = 120.0, [30.0 ..= 175.0], "Rim", "°", "colatitude of the rim at a ring (at most 150) or a drop; at a bath it is 90";
    wire_mm: f64 = 1.5, [0.0 ..= 20.0], "Wire", " mm", "diameter of the wire that a ring is made of, mm; 0 draws none";
    regeneration: f64 = 1.0, [0.0 ..= 10.0], "Regeneration", "", "factor on the rate at which thin patches rise from the rim of the film";
    patch_mm: f64 = 3.0, [0.1 ..= 100.0], "Patches", " mm", "radius of these patches, mm; at most a quarter of the bubble's radius";
}

impl Bubble {
    pub(super) fn warning(&self, number: usize) -> Option<String> {
        let radius_mm = self.radius_mm;
        (radius_mm > ROUND_MM).then(|| {
            format!(
                "[[bubble]] number {number} has a radius of {radius_mm} mm and is drawn as a sphere; a real bubble flattens under its weight beyond {ROUND_MM} mm"
            )
        })
    }

    pub(super) fn check(&self) -> Checked {
        self.check_ranges()?;
        if let Some([lowest, highest]) = self.boundary.rims_deg()
            && !(lowest..=highest).contains(&self.rim_deg)
        {
            let reason =
                format!("is {}; for a {} it must be within {lowest} ..= {highest}", self.rim_deg, self.boundary.name());
            return Err(Fault::new("rim_deg", reason));
        }
        if self.boundary != Boundary::Free && self.regeneration > 0.0 && self.patch_mm > 0.25 * self.radius_mm {
            let reason = format!("is {}, which is more than a quarter of the bubble's radius", self.patch_mm);
            return Err(Fault::new("patch_mm", reason));
        }
        self.film.check().map_err(|fault| fault.inside("film"))
    }
}

section! {
    /// The film of a bubble at tick 0: `[bubble.film]`.
    pub struct Film, FilmKeys:
    state: FilmStateName = FilmStateName::Blown, [word], "State", "", "initial distribution of the thickness";
    thickness_nm: f64 = 700.0, [1.0 ..= 10000.0], "Thickness", " nm", "mean total thickness, nm; with `state = \"uniform\"` it may be as low as 0";
    stratification: f64 = 0.7, [-5.0 ..= 5.0], "Stratification", "", "the `a` of the rest state `h = mean * a / sinh(a) * exp(-a * cos(colatitude))`; negative: thick on top; only for `state = \"rest\"`";
    index: FilmIndexName = FilmIndexName::Water, [1.0 ..= 4.0], "Index", "", "refractive index: `\"water\"` at 20 °C with its dispersion, `\"water 25C\"` (0 to 40), `\"glycerol 30%\"` (by mass, in water), the path of a `.csv` [table](#files-that-a-scene-names) of wavelengths and indices, or one number for all wavelengths";
    skin_nm: f64 = 0.0, [0.0 ..= 5.0], "Skins", " nm", "thickness of the layer of soap molecules (n = 1.45) on each face, nm; soap has about 2";
    seed: u64 = 1, [whole], "Film seed", "", "random seed of the patches of a `\"blown\"` film";
    cells: u32 = 256, [16 ..= 1024], "Cells", "", "cells of the film along an edge of a panel of the cubed sphere";
    detail: Detail = Detail::Auto, [word], "Detail", "", "resolution that the film and its flow use; decided once, when a window opens the scene: zooming does not change the film";
}

impl Film {
    pub(super) fn check(&self) -> Checked {
        if self.state == FilmStateName::Uniform && (0.0..MIN_FLOWING_NM).contains(&self.thickness_nm) {
            return Self { thickness_nm: MIN_FLOWING_NM, ..self.clone() }.check();
        }
        if (0.0..MIN_FLOWING_NM).contains(&self.thickness_nm) {
            let reason =
                format!("is {}; only a film with `state = \"uniform\"` may be thinner than 1", self.thickness_nm);
            return Err(Fault::new("thickness_nm", reason));
        }
        self.check_ranges()
    }
}

impl Value for FilmIndexName {
    fn check(&self, key: &Key) -> Checked {
        match self {
            Self::Water => Ok(()),
            Self::Constant(index) => index.check(key),
            Self::Named(name) if is_liquid(name) => name.check(key),
            Self::Named(name) => {
                let name = shorten(name, check::LONGEST_NAME);
                let known = "\"water\", \"water 25C\", \"glycerol 30%\", the path of a .csv file, or a number";
                Err(Fault::new(key.name, format!("is {name:?}; use {known}")))
            }
        }
    }
}

words! {
    /// The part of its cells that a film takes.
    pub enum Detail: "detail" {
        Auto = "auto", "Half if the bubble is `free` and never, wherever it is dragged, more than 40 pixels across in a picture of 1080 rows, else full";
        Full = "full", "All of these cells";
        Half = "half", "Half the cells along each edge: enough for a bubble of 40 pixels, in a third of the time";
    }
}

/// Whether a name can be a liquid's or a file's; what it says of temperature or share is read with the film.
fn is_liquid(name: &str) -> bool {
    let name = name.trim().to_ascii_lowercase();
    is_table(&name) || name.starts_with("water") || name.starts_with("glycerol")
}

words! {
    /// How the thickness of a film is spread over its sphere at tick 0.
    pub enum FilmStateName: "state" {
        Uniform = "uniform", "One thickness everywhere; nothing flows";
        Rest = "rest", "Sorted by gravity: thin above, thick below";
        Blown = "blown", "Freshly blown: random patches, not yet sorted";
    }
}

/// The refractive index of a film.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    rename_all = "lowercase",
    expecting = "expected \"water\", another liquid's name, the path of a .csv file, or a number"
)]
pub enum FilmIndexName {
    /// Water at 20 °C, with its dispersion.
    Water,
    /// The same index at every wavelength; 1 ..= 4.
    #[serde(untagged)]
    Constant(f64),
    /// Another liquid, as in `water 25C` or `glycerol 30%`, or the path of a `.csv` file with lines `wavelength_nm,n`.
    #[serde(untagged)]
    Named(String),
}
