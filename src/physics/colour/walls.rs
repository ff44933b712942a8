//! The walls of film that a ray meets, and what they reflect of one wavelength.

use crate::physics::optics::{Polarised, SpectralWall, Wall};

/// The film that a ray meets: one wall, or both walls of a bubble. Thickness along the normal, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walls {
    /// One film.
    One {
        /// Its thickness.
        thickness_nm: f64,
    },
    /// The front wall, and what its light shows of the back wall: R₀ + T₀ R₁ T₂. The angle is the same at all three, as on a sphere.
    Two {
        /// Where the ray enters, with R₀ and T₀.
        front_nm: f64,
        /// Where it turns back inside, with R₁.
        back_nm: f64,
        /// Where it leaves through the front wall, with T₂.
        exit_nm: f64,
    },
}

impl Walls {
    /// How many walls reflect: 1 or 2.
    pub fn count(&self) -> u32 {
        match self {
            Self::One { .. } => 1,
            Self::Two { .. } => 2,
        }
    }

    /// The thickest of them, nm.
    pub fn thickest_nm(&self) -> f64 {
        match *self {
            Self::One { thickness_nm } => thickness_nm,
            Self::Two { front_nm, back_nm, exit_nm } => front_nm.max(back_nm).max(exit_nm),
        }
    }

    /// The walls with each thickness replaced.
    #[must_use]
    pub fn map(self, thickness_nm: impl Fn(f64) -> f64) -> Self {
        match self {
            Self::One { thickness_nm: nm } => Self::One { thickness_nm: thickness_nm(nm) },
            Self::Two { front_nm, back_nm, exit_nm } => Self::Two {
                front_nm: thickness_nm(front_nm),
                back_nm: thickness_nm(back_nm),
                exit_nm: thickness_nm(exit_nm),
            },
        }
    }

    /// Reflectance of unpolarised light of one wavelength. On a sphere all hits share angle and plane of incidence, so one [`Wall`] stands
    /// for all of them and s and p stay apart until the end.
    pub fn reflectance(&self, wall: &Wall) -> f64 {
        self.polarised_reflectance(wall).mean()
    }

    /// As [`Self::reflectance`], of s and of p light.
    pub fn polarised_reflectance(&self, wall: &Wall) -> Polarised {
        let at = |thickness_nm| wall.reflectance(thickness_nm);
        match *self {
            Self::One { thickness_nm } => at(thickness_nm),
            Self::Two { front_nm, back_nm, exit_nm } => front_and_back(at(front_nm), at(back_nm), at(exit_nm)),
        }
    }

    /// As [`Self::reflectance`], at several wavelengths.
    pub fn reflectances(&self, wall: &SpectralWall) -> Vec<f64> {
        let at = |thickness_nm| wall.reflectances(thickness_nm);
        match *self {
            Self::One { thickness_nm } => at(thickness_nm).into_iter().map(Polarised::mean).collect(),
            Self::Two { front_nm, back_nm, exit_nm } => {
                let hits = at(front_nm).into_iter().zip(at(back_nm)).zip(at(exit_nm));
                hits.map(|((front, back), exit)| front_and_back(front, back, exit).mean()).collect()
            }
        }
    }

    /// Transmittance of unpolarised light of one wavelength: what passes all walls straight, T₀ or T₀ T₁. With one wall it is all that is not
    /// reflected; with two, what the walls reflect to and fro is missing in both.
    pub fn transmittance(&self, wall: &Wall) -> f64 {
        let at = |thickness_nm| wall.reflectance(thickness_nm);
        match *self {
            Self::One { thickness_nm } => 1.0 - at(thickness_nm).mean(),
            Self::Two { front_nm, back_nm, .. } => through(at(front_nm), at(back_nm)).mean(),
        }
    }

    /// As [`Self::transmittance`], of s and of p light.
    pub fn polarised_transmittance(&self, wall: &Wall) -> Polarised {
        let at = |thickness_nm| wall.reflectance(thickness_nm);
        match *self {
            Self::One { thickness_nm } => at(thickness_nm).rest(),
            Self::Two { front_nm, back_nm, .. } => through(at(front_nm), at(back_nm)),
        }
    }
}

/// The part of one-wavelength light that passes each of two walls straight, without reflections between them.
fn through(front: Polarised, back: Polarised) -> Polarised {
    Polarised { s: (1.0 - front.s) * (1.0 - back.s), p: (1.0 - front.p) * (1.0 - back.p) }
}

fn front_and_back(front: Polarised, back: Polarised, exit: Polarised) -> Polarised {
    let joined = |r0: f64, r1: f64, r2: f64| r0 + (1.0 - r0) * r1 * (1.0 - r2);
    Polarised { s: joined(front.s, back.s, exit.s), p: joined(front.p, back.p, exit.p) }
}
