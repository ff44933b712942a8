//! A film's history in f64 on the CPU: the film model of [`physics::film::model`](crate::physics::film::model) by the same key that moves a film on
//! the device, step by step.

use std::ops::Range;

use crate::{
    physics::{
        film::model::{Film, FilmRules, RemapRule},
        sphere::{CubedSphere, GridError},
        transport::Scheme,
    },
    plan::{FieldKey, FlowLaw},
};

/// The most cells along an edge of a film that the CPU moves: beyond, the device's map and flow have grids of their own.
pub const MAX_CELLS: u32 = 64;

/// Why a film is not moved on the CPU.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReferenceFilmError {
    /// A grid that the model has no room for.
    #[error(
        "the reference moves films of at most {max} cells along an edge, and this one has {cells}: lower the bubble's film.cells, as with --set bubble.0.film.cells=32"
    )]
    TooFine {
        /// Cells along an edge.
        cells: u32,
        /// As many as there may be.
        max: u32,
    },
    /// A grid that is too coarse.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A scheme that the model does not have.
    #[error("the reference moves films by the scheme map, and this one is moved by {0}: set motion.scheme to map")]
    Scheme(&'static str),
}

/// A film, and how much of its history it has been through.
pub struct ReferenceFilm {
    film: Film,
    tick: u64,
}

impl ReferenceFilm {
    /// The film of a key as it begins.
    ///
    /// # Errors
    /// Grids and schemes that the model does not have.
    pub fn new(key: &FieldKey) -> Result<Self, ReferenceFilmError> {
        if key.scheme != Scheme::Map {
            return Err(ReferenceFilmError::Scheme(key.scheme.name()));
        }
        let max = MAX_CELLS.min(key.flow_cells);
        if key.cells > max {
            return Err(ReferenceFilmError::TooFine { cells: key.cells, max });
        }
        let remap = RemapRule { error_limit_cells: RemapRule::ERROR_LIMIT_CELLS, latest_ticks: key.remap_ticks };
        let rules = FilmRules { cap: key.cap(), drop_rad: key.drop_rad(), remap };
        let grid = CubedSphere::new(key.cells as usize)?;
        Ok(Self { film: Film::new(grid, rules, key.initial.profile()), tick: 0 })
    }

    /// Takes the steps that end until the moment of a key, of which this film's history is the beginning; `progress` hears of the ticks of each.
    pub fn play(&mut self, key: &FieldKey, progress: impl Fn(u64)) {
        let steps: Vec<Range<u64>> = key.steps_from(self.tick).collect();
        for step in steps {
            if key.law(step.start) != FlowLaw::Rest {
                self.film.advance(&key.film_step(&step));
            }
            self.tick = step.end;
            progress(step.end - step.start);
        }
    }

    /// Thickness in nm at each cell at the moment of a key that has been played, in the grid's order, as if nothing had evaporated.
    #[must_use]
    pub fn thickness_nm(&self, key: &FieldKey) -> Vec<f64> {
        let ahead_s = ((key.moment.tick - self.tick) as f64 + key.moment.fraction) * key.tick_s;
        match key.law(self.tick) {
            FlowLaw::Rest => self.film.thickness_nm(),
            _ if ahead_s <= 0.0 => self.film.thickness_nm(),
            law => self.film.thickness_ahead_nm(law, self.tick as f64 * key.tick_s, ahead_s),
        }
    }

    /// The film.
    #[must_use]
    pub fn film(&self) -> &Film {
        &self.film
    }
}
