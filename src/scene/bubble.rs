//! A bubble and its film.

use super::check::{self, Checked, Fault};
use super::{is_table, shorten};
use serde::{Deserialize, Serialize};

/// Thinnest mean film that can flow, nm: its logarithm drives the buoyancy, so it must not vanish.
const MIN_FLOWING_NM: f64 = 1.0;

/// Radius in mm beyond which bubbles are no spheres: there the weight of a film of 1 µm, ρ g h, is a tenth of the pressure inside, 4γ/R with
/// γ = 25 mN/m.
const ROUND_MM: f64 = 1000.0;

/// Colatitude of the lowest ring, degrees: below, the image of the film beyond its rim is finer than the flow's cells.
const LOWEST_RING_DEG: f64 = 150.0;

/// A spherical bubble: one `[[bubble]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bubble {
    /// Centre, m; each coordinate -1000 ..= 1000. Default: the origin.
    pub center_m: [f64; 3],
    /// Radius, mm; 0.1 ..= 5000. Default: 50.
    pub radius_mm: f64,
    /// What the film ends at. Default: `free`, at nothing.
    pub boundary: Boundary,
    /// Colatitude of the rim of a film on a `ring` or that carries a `drop`, degrees; 30 ..= 175, on a ring to 150 at most. That of a film
    /// on a bath is 90. Default: 120.
    pub rim_deg: f64,
    /// Factor on how many thin patches rise from the rim of a film that has one; 0 ..= 10. Default: 1.
    pub regeneration: f64,
    /// Radius of these patches, mm; 0.1 ..= 100, at most a quarter of the bubble's where they rise. Default: 3.
    pub patch_mm: f64,
    /// The film at tick 0.
    pub film: Film,
}

impl Default for Bubble {
    fn default() -> Self {
        Self {
            center_m: [0.0; 3],
            radius_mm: 50.0,
            boundary: Boundary::Free,
            rim_deg: 120.0,
            regeneration: 1.0,
            patch_mm: 3.0,
            film: Film::default(),
        }
    }
}

impl Bubble {
    pub(super) fn warning(&self, number: usize) -> Option<String> {
        let radius_mm = self.radius_mm;
        (radius_mm > ROUND_MM).then(|| {
            format!(
                "[[bubble]] number {number} has a radius of {radius_mm} mm and is drawn as a sphere; a real one flattens under its weight beyond {ROUND_MM} mm"
            )
        })
    }

    pub(super) fn check(&self) -> Checked {
        check::all_in_range("center_m", self.center_m, check::POSITION_M)?;
        check::in_range("radius_mm", self.radius_mm, 0.1..=5000.0)?;
        check::in_range("rim_deg", self.rim_deg, 30.0..=175.0)?;
        if self.boundary == Boundary::Ring && self.rim_deg > LOWEST_RING_DEG {
            let reason = format!("is {}; a ring's must be within 30 ..= {LOWEST_RING_DEG}", self.rim_deg);
            return Err(Fault::new("rim_deg", reason));
        }
        check::in_range("regeneration", self.regeneration, 0.0..=10.0)?;
        check::in_range("patch_mm", self.patch_mm, 0.1..=100.0)?;
        if self.boundary != Boundary::Free && self.regeneration > 0.0 && self.patch_mm > 0.25 * self.radius_mm {
            let reason = format!("is {}, which is more than a quarter of the bubble's radius", self.patch_mm);
            return Err(Fault::new("patch_mm", reason));
        }
        self.film.check().map_err(|fault| fault.inside("film"))
    }
}

/// What a film ends at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// Nothing: it is all around.
    Free,
    /// A bath of liquid, on which the bubble is a hemisphere.
    Bath,
    /// A ring: a cap of film above a circle of latitude.
    Ring,
    /// A drop that hangs at its bottom and lets no film through.
    Drop,
}

/// The film of a bubble at tick 0: `[bubble.film]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Film {
    /// How the thickness is spread over the sphere. Default: `blown`.
    pub state: FilmStateName,
    /// Mean total thickness along the normal, nm; 0 ..= 10000, and at least 1 unless `state` is `uniform`. Default: 700.
    pub thickness_nm: f64,
    /// The `a` of the rest state `h = mean (a / sinh a) exp(-a cos colatitude)`, no unit; -5 ..= 5, negative is thick on top.
    /// Only `rest` uses it. Default: 0.7, a drained film.
    pub stratification: f64,
    /// Refractive index. Default: `water`.
    pub index: FilmIndexName,
    /// Thickness of the layer of soap molecules (n = 1.45) on each face, nm; part of `thickness_nm`; 0 ..= 5. Default: 0.
    pub skin_nm: f64,
    /// Seed of the random patches of a `blown` film. Default: 1.
    pub seed: u64,
    /// Thickness cells along an edge of the cubed sphere, 6 `cells`² in all; 16 ..= 1024. Default: 256.
    pub cells: u32,
    /// How many of them the film takes. Default: `auto`.
    pub detail: Detail,
}

impl Default for Film {
    fn default() -> Self {
        Self {
            state: FilmStateName::Blown,
            thickness_nm: 700.0,
            stratification: 0.7,
            index: FilmIndexName::Water,
            skin_nm: 0.0,
            seed: 1,
            cells: 256,
            detail: Detail::Auto,
        }
    }
}

impl Film {
    fn check(&self) -> Checked {
        check::in_range("thickness_nm", self.thickness_nm, 0.0..=10_000.0)?;
        if self.state != FilmStateName::Uniform && self.thickness_nm < MIN_FLOWING_NM {
            let reason =
                format!("is {}; only a film with `state = \"uniform\"` may be thinner than 1", self.thickness_nm);
            return Err(Fault::new("thickness_nm", reason));
        }
        check::in_range("stratification", self.stratification, -5.0..=5.0)?;
        match &self.index {
            FilmIndexName::Constant(index) => check::in_range("index", *index, 1.0..=4.0)?,
            FilmIndexName::Named(name) if !is_liquid(name) => {
                let name = shorten(name, check::LONGEST_NAME);
                let known = "\"water\", \"water 25C\", \"glycerol 30%\", the path of a .csv file, or a number";
                return Err(Fault::new("index", format!("is {name:?}; use {known}")));
            }
            FilmIndexName::Named(name) => check::plain_text("index", name)?,
            FilmIndexName::Water => {}
        }
        check::in_range("skin_nm", self.skin_nm, 0.0..=5.0)?;
        check::in_range("cells", self.cells, 16..=1024)
    }
}

/// How many of its cells a film takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Detail {
    /// All, or half if the bubble is small in the picture of the scene's camera.
    Auto,
    /// All.
    Full,
    /// Half along each edge, 16 at least, and half of those of its flow.
    Half,
}

/// Whether a name can be a liquid's or a file's; what it says of temperature or share is read with the film.
fn is_liquid(name: &str) -> bool {
    let name = name.trim().to_ascii_lowercase();
    is_table(&name) || name.starts_with("water") || name.starts_with("glycerol")
}

/// How the thickness of a film is spread over its sphere at tick 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FilmStateName {
    /// The same thickness everywhere; nothing to simulate.
    Uniform,
    /// Sorted by gravity: thin above, thick below, as `stratification` says.
    Rest,
    /// Freshly blown: random patches around the mean, not yet sorted.
    Blown,
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
