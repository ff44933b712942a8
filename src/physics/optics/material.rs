//! What a film is made of: its liquid, and the skins of soap on both faces.

use serde::{Deserialize, Serialize};

use super::{
    Coherence, FilmIndex, Incidence, Polarised, REFERENCE_NM, SpectralIncidence, coated_coherence, coated_reflectance,
    cos_refracted, equivalent_extra_nm, max_reflectance,
};

/// Index of water at the sodium line, at any temperature at most.
pub const WATER_INDEX: f64 = 1.334;

/// Path difference of one order of Newton's colours, nm: that of the red end of the first.
pub const ORDER_NM: f64 = 551.0;

/// The order of Newton's colours, from 1 on, of a path difference in nm.
pub fn newton_order(path_nm: f64) -> u32 {
    (path_nm / ORDER_NM) as u32 + 1
}

/// A film's liquid and skins.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FilmMaterial {
    /// The liquid.
    pub index: FilmIndex,
    /// Thickness of each of the two layers of soap molecules, nm; part of the film's total thickness. 0 for none.
    pub skin_nm: f64,
}

impl From<FilmIndex> for FilmMaterial {
    fn from(index: FilmIndex) -> Self {
        Self { index, skin_nm: 0.0 }
    }
}

impl FilmMaterial {
    /// Index of the liquid at the sodium line, the one number that stands for the film.
    pub fn reference_index(&self) -> f64 {
        self.index.n(REFERENCE_NM)
    }

    /// Ratio of the film's fringes to the fringes of water of the same thickness: fringes are proportional to the optical path. At least 1.
    pub fn fringes_over_water(&self) -> f64 {
        (self.reference_index() / WATER_INDEX).max(1.0)
    }

    /// Path difference between the light of both faces, 2 n d cos of the angle inside, at the sodium line, in nm.
    pub fn path_nm(&self, thickness_nm: f64, cos_theta: f64) -> f64 {
        let n = self.reference_index();
        2.0 * n * thickness_nm * cos_refracted(n, cos_theta)
    }

    /// Light of one wavelength that meets the film at an angle; `n` is the liquid's index there.
    pub fn wall(&self, n: f64, cos_theta: f64, wavelength_nm: f64) -> Wall {
        let skin = (self.skin_nm > 0.0).then_some(Skin { n, cos_theta, skin_nm: self.skin_nm });
        Wall { incidence: Incidence::new(n, cos_theta), skin, wavelength_nm }
    }

    /// As [`Self::wall`], for light of several wavelengths in nm, with the liquid's index at each.
    pub fn spectral_wall(&self, indices: &[f64], cos_theta: f64, wavelengths_nm: &[f64]) -> SpectralWall {
        if self.skin_nm > 0.0 {
            let wall = |(n, nm): (&f64, &f64)| self.wall(*n, cos_theta, *nm);
            SpectralWall::Coated(indices.iter().zip(wavelengths_nm).map(wall).collect())
        } else {
            SpectralWall::Plain(SpectralIncidence::new(indices, wavelengths_nm, cos_theta))
        }
    }

    /// What the skins add to the thickness of a plain film that looks nearly the same, nm; see [`equivalent_extra_nm`].
    pub fn equivalent_extra_nm(&self) -> f64 {
        equivalent_extra_nm(self.reference_index(), self.skin_nm)
    }

    /// The thickness of a plain film that looks nearly like this one. The skins of a film thinner than both count in part, so that no
    /// film stays none.
    pub fn equivalent_nm(&self, thickness_nm: f64) -> f64 {
        let part = if self.skin_nm > 0.0 { (thickness_nm / (2.0 * self.skin_nm)).min(1.0) } else { 0.0 };
        thickness_nm + part * self.equivalent_extra_nm()
    }

    /// The most that the liquid reflects at an angle, unpolarised.
    pub fn max_reflectance(&self, cos_theta: f64) -> f64 {
        max_reflectance(self.reference_index(), cos_theta)
    }
}

/// Light of one wavelength at one angle, for films of any thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    incidence: Incidence,
    skin: Option<Skin>,
    wavelength_nm: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Skin {
    n: f64,
    cos_theta: f64,
    skin_nm: f64,
}

impl Wall {
    /// Reflectance of a film of that total thickness; what it does not reflect goes through.
    pub fn reflectance(&self, thickness_nm: f64) -> Polarised {
        match self.skin {
            None => self.incidence.reflectance(thickness_nm, self.wavelength_nm),
            Some(Skin { n, cos_theta, skin_nm }) => {
                coated_reflectance(n, skin_nm, cos_theta, thickness_nm, self.wavelength_nm)
            }
        }
    }

    /// What a film of that total thickness makes of the coherence of s and p light.
    pub fn coherence(&self, thickness_nm: f64) -> Coherence {
        match self.skin {
            None => self.incidence.coherence(thickness_nm, self.wavelength_nm),
            Some(Skin { n, cos_theta, skin_nm }) => {
                coated_coherence(n, skin_nm, cos_theta, thickness_nm, self.wavelength_nm)
            }
        }
    }
}

/// Light of several wavelengths at one angle, for films of any thickness.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectralWall {
    /// A film without skins.
    Plain(SpectralIncidence),
    /// A film with skins, at each wavelength.
    Coated(Vec<Wall>),
}

impl SpectralWall {
    /// Reflectance of a film of that total thickness at each wavelength.
    #[must_use]
    pub fn reflectances(&self, thickness_nm: f64) -> Vec<Polarised> {
        match self {
            Self::Plain(incidence) => incidence.reflectances(thickness_nm),
            Self::Coated(walls) => walls.iter().map(|wall| wall.reflectance(thickness_nm)).collect(),
        }
    }

    /// What a film of that total thickness makes of the coherence of s and p light at each wavelength.
    #[must_use]
    pub fn coherences(&self, thickness_nm: f64) -> Vec<Coherence> {
        match self {
            Self::Plain(incidence) => incidence.coherences(thickness_nm),
            Self::Coated(walls) => walls.iter().map(|wall| wall.coherence(thickness_nm)).collect(),
        }
    }
}
