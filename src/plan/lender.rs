//! From a generator of the scene to the swarm that it makes, and to the films that it lends.

use glam::DVec3;

use crate::{
    physics::{
        bubble::{Lending, Origin, Renewal, Swarm},
        film::fold_seed,
    },
    scene::{Bubble, Film, Generator, Layout},
};

/// A generator, as what it makes.
#[derive(Debug)]
pub(super) struct Lender {
    /// Its bubbles.
    pub swarm: Swarm,
    /// The first of its films among the owners of all films.
    pub first_owner: usize,
}

impl Lender {
    /// What a generator makes in a scene with ticks of a length in seconds.
    pub fn new(generator: &Generator, first_owner: usize, tick_s: f64) -> Self {
        let swarm = Swarm {
            origin: match generator.layout {
                Layout::Cloud => Origin::Cloud,
                Layout::Grid => Origin::Grid,
                Layout::Wand => Origin::Wand {
                    direction: DVec3::from(generator.direction).normalize_or(DVec3::X),
                    speed_m_s: generator.speed_m_s,
                    spread_rad: generator.spread_deg.to_radians(),
                },
            },
            count: generator.count,
            seed: fold_seed(generator.seed),
            center_m: generator.center_m.into(),
            size_m: generator.size_m.into(),
            radius_m: 1e-3 * generator.radius_mm,
            radius_spread: generator.radius_spread,
            thickness_m: 1e-9 * generator.film.thickness_nm,
            thickness_spread: generator.thickness_spread,
            lending: Lending {
                films: generator.films,
                life_s: (generator.life_s > 0.0).then_some(generator.life_s),
                tick_s,
            },
            wind_m_s: DVec3::from(generator.wind_m_s) + generator.rise_m_s * DVec3::Z,
            wander_m: 1e-3 * generator.wander_mm,
            wobble: generator.wobble,
        };
        Self { swarm, first_owner }
    }

    /// When each of its films is blown anew.
    pub fn renewals(&self) -> impl Iterator<Item = Option<Renewal>> {
        let Lending { films, .. } = self.swarm.lending;
        let interval = self.swarm.lending.interval_ticks();
        (0..films).map(move |film| {
            let [first_tick, period_ticks] = [film, films].map(|films| Some(interval? * u64::from(films)));
            Some(Renewal { first_tick: first_tick?, period_ticks: period_ticks? })
        })
    }
}

/// The bubbles of a scene, and then one for each film that its generators lend, of the generator's mean size and where it is: the index of a film is
/// that of its owner.
#[must_use]
pub fn film_owners(bubbles: &[Bubble], generators: &[Generator]) -> Vec<Bubble> {
    let lent = generators.iter().flat_map(|generator| {
        (0..generator.films).map(|number| Bubble {
            center_m: generator.center_m,
            radius_mm: generator.radius_mm,
            film: Film { seed: generator.film.seed.wrapping_add(number.into()), ..generator.film.clone() },
            ..Bubble::default()
        })
    });
    bubbles.iter().cloned().chain(lent).collect()
}
