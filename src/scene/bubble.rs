//! A bubble and its film.

use super::check::{self, Checked, Fault};
use serde::{Deserialize, Serialize};

/// Thinnest mean film that can flow, nm: its logarithm drives the buoyancy, so it must not vanish.
const MIN_FLOWING_NM: f64 = 1.0;

/// Radius in mm beyond which bubbles are no spheres: there the weight of a film of 1 µm, ρ g h, is a tenth of the pressure inside, 4γ/R with
/// γ = 25 mN/m.
const ROUND_MM: f64 = 1000.0;

/// A spherical bubble: one `[[bubble]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bubble {
    /// Centre, m; each coordinate -1000 ..= 1000. Default: the origin.
    pub center_m: [f64; 3],
    /// Radius, mm; 0.1 ..= 5000. Default: 50.
    pub radius_mm: f64,
    /// The film at tick 0.
    pub film: Film,
}

impl Default for Bubble {
    fn default() -> Self {
        Self { center_m: [0.0; 3], radius_mm: 50.0, film: Film::default() }
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
        self.film.check().map_err(|fault| fault.inside("film"))
    }
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
                let known = "\"water\", \"water 25C\", \"glycerol 30%\", the path of a .csv file, or a number";
                return Err(Fault::new("index", format!("is {name:?}; use {known}")));
            }
            _ => {}
        }
        check::in_range("skin_nm", self.skin_nm, 0.0..=5.0)?;
        check::in_range("cells", self.cells, 16..=1024)
    }
}

/// Whether a name can be a liquid's or a file's; what it says of temperature or share is read with the film.
fn is_liquid(name: &str) -> bool {
    let name = name.trim().to_ascii_lowercase();
    name.ends_with(".csv") || name.starts_with("water") || name.starts_with("glycerol")
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
