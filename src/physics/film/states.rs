//! Initial states of a film: its thickness as a function of direction.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::marble::Marble;

/// Thickness in nm as a function of a unit vector.
pub type Profile = Box<dyn Fn(DVec3) -> f64 + Send + Sync>;

/// A film before it flows. Thickness is the total along the normal, in nm; the top of the bubble is +z.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum InitialFilm {
    /// One thickness everywhere.
    Uniform {
        /// The thickness, nm.
        thickness_nm: f64,
    },
    /// The elastic rest state: thin above, thick below.
    Rest {
        /// The mean thickness over the sphere, nm.
        thickness_nm: f64,
        /// a = ρ g R h̄ / (2E): ln h falls by 2a from bottom to top. Negative is upside down.
        stratification: f64,
    },
    /// A freshly blown film: random marbled patches of 0.43 to 1.7 times the mean (300 to 1200 nm for 700 nm).
    Blown {
        /// The mean thickness in nm; the mean for a single seed differs from it by some percent.
        thickness_nm: f64,
        /// Multiplies the pattern by the rest state's profile; 0 for none.
        stratification: f64,
        /// Selects the pattern.
        seed: u32,
    },
}

/// The thinnest and thickest patch of a blown film over its mean.
const BLOWN_RANGE: [f64; 2] = [0.43, 1.7];

impl InitialFilm {
    /// Thickness in nm in the direction of a unit vector. For many directions take the [`Self::profile`] once.
    pub fn thickness_nm(&self, direction: DVec3) -> f64 {
        self.profile()(direction)
    }

    /// The mean thickness that was asked for, nm.
    #[must_use]
    pub fn mean_nm(&self) -> f64 {
        match *self {
            Self::Uniform { thickness_nm } | Self::Rest { thickness_nm, .. } | Self::Blown { thickness_nm, .. } => {
                thickness_nm
            }
        }
    }

    /// Bounds of the thickness in nm: no direction is thinner or thicker.
    pub fn range_nm(&self) -> (f64, f64) {
        let rest = |a: f64| (rest_profile(a, a.signum()), rest_profile(a, -a.signum()));
        match *self {
            Self::Uniform { thickness_nm } => (thickness_nm, thickness_nm),
            Self::Rest { thickness_nm, stratification } => {
                let (min, max) = rest(stratification);
                (thickness_nm * min, thickness_nm * max)
            }
            Self::Blown { thickness_nm, stratification, .. } => {
                let (min, max) = rest(stratification);
                (thickness_nm * min * BLOWN_RANGE[0], thickness_nm * max * BLOWN_RANGE[1])
            }
        }
    }

    /// The seed that selects its pattern; 0 where it has none.
    #[must_use]
    pub fn seed(&self) -> u32 {
        match *self {
            Self::Blown { seed, .. } => seed,
            Self::Uniform { .. } | Self::Rest { .. } => 0,
        }
    }

    /// About how thin the film is at the top once gravity has sorted it, nm. A blown film mixes while it sorts itself; of 700 nm on average
    /// it was seen to keep 390 to 430 nm there.
    pub fn sorted_top_nm(&self) -> f64 {
        const BLOWN_TOP: f64 = 0.57;
        match *self {
            Self::Blown { thickness_nm, .. } => thickness_nm * BLOWN_TOP,
            Self::Uniform { .. } | Self::Rest { .. } => self.range_nm().0,
        }
    }

    /// The thickness in nm as a function, with what its directions have in common done once.
    pub fn profile(&self) -> Profile {
        match *self {
            Self::Uniform { thickness_nm } => Box::new(move |_| thickness_nm),
            Self::Rest { thickness_nm, stratification } => {
                Box::new(move |x| thickness_nm * rest_profile(stratification, x.z))
            }
            Self::Blown { thickness_nm, stratification, seed } => {
                let marble = Marble::new(seed);
                Box::new(move |x| thickness_nm * rest_profile(stratification, x.z) * blown_profile(marble.value(x)))
            }
        }
    }
}

/// The elastic rest state over its mean, `(a / sinh a) e^(−a z)`, at height z = cos(colatitude). Written so that no a overflows.
fn rest_profile(a: f64, z: f64) -> f64 {
    let (a, z) = (a.abs(), z * a.signum());
    if a < f64::EPSILON {
        return 1.0; // The limit of the 0/0 below.
    }
    2.0 * a / -(-2.0 * a).exp_m1() * (-a * (z + 1.0)).exp()
}

/// Relative thickness of a pattern value in (−1, 1): monotone onto [`BLOWN_RANGE`], curved so that the mean is near 1.
fn blown_profile(pattern: f64) -> f64 {
    const CURVE: f64 = 0.29;
    let s = 0.5 * (1.0 + pattern);
    BLOWN_RANGE[0] + (BLOWN_RANGE[1] - BLOWN_RANGE[0]) * (s - CURVE * s * (1.0 - s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;

    const FILMS: [InitialFilm; 5] = [
        InitialFilm::Uniform { thickness_nm: 500.0 },
        InitialFilm::Rest { thickness_nm: 700.0, stratification: 0.6 },
        InitialFilm::Rest { thickness_nm: 700.0, stratification: -2.0 },
        InitialFilm::Blown { thickness_nm: 700.0, stratification: 0.0, seed: 1 },
        InitialFilm::Blown { thickness_nm: 400.0, stratification: 0.4, seed: 2 },
    ];

    fn values(film: InitialFilm, n: usize) -> Vec<f64> {
        let (grid, profile) = (CubedSphere::new(n).unwrap(), film.profile());
        (0..grid.cells()).map(|cell| profile(grid.cell_direction(cell))).collect()
    }

    fn mean(film: InitialFilm, n: usize) -> f64 {
        let areas = CubedSphere::new(n).unwrap().areas();
        let total: f64 = areas.iter().zip(values(film, n)).map(|(area, thickness_nm)| area * thickness_nm).sum();
        total / areas.iter().sum::<f64>()
    }

    #[test]
    fn the_rest_state_has_the_mean_asked_for() {
        for stratification in [0.0, 1e-12, 1e-5, 0.3, -0.6, 3.0] {
            let film = InitialFilm::Rest { thickness_nm: 600.0, stratification };
            // Midpoint rule over cells, second order; extrapolated it is fourth.
            let [coarse, fine] = [16, 32].map(|n| mean(film, n));
            let extrapolated = fine + (fine - coarse) / 3.0;
            assert!((extrapolated / 600.0 - 1.0).abs() < 1e-5, "a = {stratification}: {extrapolated}");
        }
    }

    #[test]
    fn the_rest_state_is_the_formula() {
        for a in [1e-9_f64, 0.1, 0.6, -2.0, 20.0] {
            for z in [-1.0, -0.2, 0.7, 1.0] {
                let formula = a / a.sinh() * (-a * z).exp();
                assert!((rest_profile(a, z) / formula - 1.0).abs() < 1e-12);
            }
        }
        assert_eq!(rest_profile(0.0, 0.3), 1.0);
        assert!(rest_profile(1e4, -1.0).is_finite());
    }

    #[test]
    fn films_stay_in_their_range() {
        for film in FILMS {
            let (min, max) = film.range_nm();
            // Rounding of a few operations.
            let range = min * (1.0 - 1e-14)..=max * (1.0 + 1e-14);
            assert!(values(film, 20).iter().all(|h| range.contains(h)), "{film:?}");
        }
    }

    #[test]
    fn a_blown_film_uses_its_range_and_has_its_mean() {
        for seed in 0..6 {
            let film = InitialFilm::Blown { thickness_nm: 700.0, stratification: 0.0, seed };
            let values = values(film, 24);
            let (min, max) = values.iter().fold((f64::MAX, 0.0_f64), |(min, max), &h| (min.min(h), max.max(h)));
            assert!((300.0..340.0).contains(&min) && (1120.0..1191.0).contains(&max), "{min} to {max} nm");
            assert!((mean(film, 24) / 700.0 - 1.0).abs() < 0.1, "{}", mean(film, 24));
        }
    }
}
