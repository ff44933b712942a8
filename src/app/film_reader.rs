//! Reads films back from the device without waiting: only those that are asked for, and only when they have changed.

use std::{
    collections::{BTreeMap, BTreeSet},
    time::Duration,
};

use glam::DVec3;
use web_time::Instant;

use crate::{
    gpu::{GpuError, Renderer, readback::Readback},
    physics::sphere::{CubedSphere, HaloTable, PaddedField},
    plan::{DrawKey, FieldKey, FilmKey, Moment},
    studio::FilmsRead,
};

/// Shortest time between two readings of a film that moves.
const PERIOD: Duration = Duration::from_millis(150);

/// Films as they were read last.
#[derive(Default)]
pub struct FilmReader {
    films: FilmsRead,
    /// How many films have been read.
    reads: u64,
    /// Which film each of them was, and its moment: after an edit another film may stand at the same moment.
    read: BTreeMap<usize, (FieldKey, Moment)>,
    halos: BTreeMap<usize, HaloTable>,
    pending: Option<Pending>,
    next: Option<Instant>,
}

/// A film on its way from the device.
struct Pending {
    film: usize,
    of: (FieldKey, Moment),
    grid: CubedSphere,
    thickness: Readback,
    flow: Option<(CubedSphere, Readback)>,
    thickness_nm: Option<Vec<u8>>,
}

impl FilmReader {
    /// What was read so far.
    pub fn films(&self) -> &FilmsRead {
        &self.films
    }

    /// How many films have been read so far.
    pub fn reads(&self) -> u64 {
        self.reads
    }

    /// The moment that the thickness of a film in a picture is of, at a moment of the clock.
    pub fn time(&self, renderer: &Renderer, draw: &DrawKey, film: usize, clock: Moment) -> Moment {
        // The device may still hold the field of a film that was opened before.
        let has_field = draw.films().any(|(index, key)| index == film && matches!(key, FilmKey::Field(_)));
        let field = renderer.state().fields.get(film).and_then(Option::as_ref);
        // A film at rest, or without a field, is what it was; only evaporation goes on.
        let moves = has_field && field.is_some_and(|field| field.rest.is_none());
        let read = self.read.get(&film).filter(|_| moves);
        read.map_or(clock, |(_, moment)| *moment)
    }

    /// Reads a film if it has changed since; returns whether what is here is what the picture shows, or has just arrived: a film that moves is
    /// always a little ahead.
    ///
    /// # Errors
    /// The device is lost, or refused a command.
    pub fn read(&mut self, renderer: &Renderer, film: usize, now: Instant) -> Result<bool, GpuError> {
        let arrived = self.collect(renderer)?;
        let Some(Some(field)) = renderer.state().fields.get(film) else { return Ok(true) };
        let of = (field.key.clone(), field.shown.unwrap_or(field.key.moment));
        if arrived == Some(film) || self.read.get(&film) == Some(&of) {
            return Ok(true);
        }
        if self.pending.is_none() && self.next.is_none_or(|next| now >= next) {
            self.next = Some(now + PERIOD);
            self.begin(renderer, film, of)?;
        }
        Ok(false)
    }

    /// Reads all films of a picture that have changed; returns whether all that is here is what the picture shows.
    pub fn read_all(&mut self, renderer: &Renderer, draw: &DrawKey, now: Instant) -> bool {
        let films: BTreeSet<usize> = draw.films().map(|(film, _)| film).collect();
        // A failure is told where the probe reads.
        let unread = films.into_iter().filter(|film| !self.read(renderer, *film, now).unwrap_or(true));
        // Counted, for each film must be asked for.
        unread.count() == 0
    }

    fn begin(&mut self, renderer: &Renderer, film: usize, of: (FieldKey, Moment)) -> Result<(), GpuError> {
        let Some((grid, thickness)) = renderer.read_film(film)? else { return Ok(()) };
        let flow = renderer.read_flow(film);
        self.pending = Some(Pending { film, of, grid, thickness, flow, thickness_nm: None });
        Ok(())
    }

    /// Takes what has arrived; returns its film.
    fn collect(&mut self, renderer: &Renderer) -> Result<Option<usize>, GpuError> {
        let Some(pending) = &mut self.pending else { return Ok(None) };
        renderer.gpu.device.poll(wgpu::PollType::Poll).map_err(|error| GpuError::Lost(error.to_string()))?;
        if pending.thickness_nm.is_none() {
            pending.thickness_nm = pending.thickness.try_take().transpose()?;
        }
        if pending.thickness_nm.is_none() {
            return Ok(None);
        }
        let velocity = match &pending.flow {
            None => None,
            Some((grid, readback)) => match readback.try_take().transpose()? {
                None => return Ok(None),
                Some(bytes) => Some((*grid, bytes)),
            },
        };
        Ok(self.pending.take().map(|pending| {
            let film = pending.film;
            self.put(pending, velocity);
            film
        }))
    }

    fn put(&mut self, pending: Pending, velocity: Option<(CubedSphere, Vec<u8>)>) {
        let Pending { film, of, grid, thickness_nm, .. } = pending;
        let cells: Vec<f32> = bytemuck::pod_collect_to_vec(&thickness_nm.unwrap_or_default());
        let halo = self.halos.entry(grid.n()).or_insert_with(|| HaloTable::new(grid));
        let thickness_nm = PaddedField::from_cells(grid, halo, |cell| f64::from(cells[cell]));
        self.films.thickness_nm.insert(film, thickness_nm);
        if let Some((grid, bytes)) = velocity {
            let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
            let vector = |[x, y, z, _]: &[f32; 4]| DVec3::new((*x).into(), (*y).into(), (*z).into());
            let field = PaddedField::from_padded(grid, values.iter().map(vector).collect());
            self.films.velocity_rad_s.insert(film, field);
        }
        self.read.insert(film, of);
        self.reads += 1;
    }
}
