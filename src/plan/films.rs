//! From a bubble and its age to its film's key.

use super::{FieldKey, FilmBoundary, FilmKey, laws::initial_film};
use crate::{
    physics::{
        bubble::{Age, CenterPath},
        film::{Cap, Evaporation, InitialFilm, Pushes, Regeneration, fold_seed},
    },
    scene::{Bubble, Motion},
};

/// Whether the film of a bubble can move: a film of one thickness looks the same however it flows.
pub(super) fn has_field(bubble: &Bubble) -> bool {
    !matches!(initial_film(bubble), InitialFilm::Uniform { .. })
}

/// Where the film of a bubble ends, if anything lies beyond.
pub(super) fn cap(bubble: &Bubble) -> Option<Cap> {
    bubble.boundary.cap(bubble.rim_deg)
}

/// The boundary of the film of bubble number `generation`, unless it is free.
fn film_boundary(bubble: &Bubble, generation: u32) -> Option<FilmBoundary> {
    let rim_deg = bubble.boundary.rim_deg(bubble.rim_deg)?;
    let regeneration = || Regeneration {
        rim: rim_deg.to_radians(),
        radius: bubble.patch_mm / bubble.radius_mm,
        amount: bubble.regeneration,
        seed: fold_seed(bubble.film.seed.wrapping_add(generation.into())),
    };
    Some(FilmBoundary {
        cap: cap(bubble),
        drop_rad: bubble.boundary.drop_rad(bubble.rim_deg),
        regeneration: (bubble.regeneration > 0.0).then(regeneration),
    })
}

/// The film of a bubble at an age, on grids of the given sizes, with the clock and the scheme of a motion.
pub(super) fn film(bubble: &Bubble, age: &Age, [cells, flow_cells]: [u32; 2], motion: &Motion) -> FilmKey {
    let life = &age.life;
    if let InitialFilm::Uniform { thickness_nm } = life.film {
        return FilmKey::Uniform(thickness_nm);
    }
    let mut key = FieldKey {
        cells,
        flow_cells,
        initial: life.film,
        boundary: film_boundary(bubble, life.generation).map(Box::new),
        tick_s: motion.tick_s,
        scheme: motion.scheme,
        remap_ticks: motion.remap_ticks,
        evaporation: Evaporation::default(),
        flows: life.flows.clone(),
        pushes: Pushes::default(),
        path: CenterPath::default(),
        moment: age.moment,
    };
    key.moment = key.last_moved();
    // Laws that come into force later leave the film as it is: a key holds what its product depends on.
    let end = key.moment.end_tick();
    key.flows = life.flows.until(end);
    if life.free_from.is_some_and(|from| from < end) {
        key.evaporation = life.evaporation.until(end);
        key.pushes = life.pushes.until(end);
        key.path = life.path.until(end as f64 * key.tick_s);
    }
    FilmKey::Field(key)
}
