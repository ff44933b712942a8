//! The passes of films: where one begins, its steps, its checkpoints, what it shows, and the hole in it.

use std::collections::BTreeMap;

use super::{Products, Renderer, told};
use crate::{
    gpu::{
        device::GpuError,
        film::{Field, MovingFilm, play_together, rules},
        passes::open_hole::OpenHole,
        timing::Recorder,
    },
    plan::{FieldKey, OpenHoleKey, Pass, Product, SeedKey, Work},
};

/// Cells stepped in one submission, so that none runs long: about 50 ms on a software rasteriser.
const CELLS_PER_SUBMISSION: u64 = 1_600_000;

impl Renderer {
    pub(super) fn seed(&mut self, film: usize, key: &FieldKey) -> Result<(), GpuError> {
        if self.products.films.len() <= film {
            self.products.films.resize_with(film + 1, || None);
        }
        let seed = SeedKey::of(key).map_err(|error| GpuError::Refused(error.to_string()))?;
        let sphere = seed.grids.film;
        let Product::Seed(begun) = self.prepared.take(&Work::Seed(seed)) else { return Ok(()) };
        let slot = &mut self.products.films[film];
        let fits = |film: &MovingFilm| (film.field.sphere(), film.field.rules()) == (sphere, rules(key));
        let film = match slot.take().filter(fits) {
            Some(film) => slot.insert(film),
            None => slot.insert(MovingFilm::new(Field::new(&self.gpu, sphere, rules(key))?)),
        };
        film.begin(&self.gpu, &begun);
        Ok(())
    }

    /// Copies a film's state to or from a checkpoint.
    pub(super) fn copy_state(
        &mut self,
        film: usize,
        copy: impl FnOnce(&mut MovingFilm, &mut Recorder<'_>) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let Some(Some(film)) = self.products.films.get_mut(film) else { return Ok(()) };
        let mut recorder = Recorder::new(&self.gpu);
        copy(film, &mut recorder)?;
        Self::submit(&self.times, &mut self.counts, recorder);
        Ok(())
    }

    /// Takes the steps of some passes, which are the same, together.
    pub(super) fn step<'p>(&mut self, passes: impl Iterator<Item = &'p Pass>) -> Result<(), GpuError> {
        let Self { gpu, products, times, counts, watcher, .. } = self;
        let (mut keys, mut from_tick) = (BTreeMap::new(), 0);
        for pass in passes {
            if let Pass::StepField { film, key, ticks } = pass {
                keys.insert(*film, key);
                from_tick = ticks.start;
            }
        }
        let films = products.films.iter_mut().enumerate();
        let mut members: Vec<_> =
            films.filter_map(|(index, film)| Some((film.as_mut()?, *keys.get(&index)?))).collect();
        let cells: u64 = members.iter().map(|(_, key)| key.cell_count()).sum();
        let per_submission = (CELLS_PER_SUBMISSION / cells.max(1)).max(1) as usize;
        play_together(gpu, &mut members, &mut products.company, (from_tick, per_submission), |recorder| {
            let work = recorder.counts.cells_stepped;
            Self::submit(times, counts, recorder);
            told(watcher, gpu, work)
        })
    }

    pub(super) fn show(&mut self, film: usize, key: &FieldKey) -> Result<(), GpuError> {
        let Some(Some(film)) = self.products.films.get_mut(film) else { return Ok(()) };
        let mut recorder = Recorder::new(&self.gpu);
        let ahead = film.ahead(key);
        film.field.show(&mut recorder, ahead.as_ref())?;
        Self::submit(&self.times, &mut self.counts, recorder);
        Ok(())
    }

    pub(super) fn open_hole(&mut self, film: usize, key: &OpenHoleKey) -> Result<(), GpuError> {
        let Products { films, holes, .. } = &mut self.products;
        if holes.len() <= film {
            holes.resize_with(film + 1, || None);
        }
        let hole = holes[film].get_or_insert_with(|| OpenHole::new(&self.gpu));
        let shown = films.get(film).and_then(Option::as_ref).map(|film| film.field.shown());
        let mut recorder = Recorder::new(&self.gpu);
        hole.open(&mut recorder, key, shown)?;
        Self::submit(&self.times, &mut self.counts, recorder);
        Ok(())
    }
}
