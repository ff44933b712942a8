//! A film as it begins: the values of a function on the grids of its field.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::{
    parallel,
    physics::sphere::{Cap, CubedSphere},
};

/// The grids that a function is put on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedGrids {
    /// The film's.
    pub film: CubedSphere,
    /// The tracer's, where it is another one.
    pub tracer: Option<CubedSphere>,
    /// Where the film ends, if anywhere. Beyond stands its image.
    pub cap: Option<Cap>,
}

/// A function as its departures from a level, on all grids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seed {
    /// What the values depart from.
    pub level: f32,
    /// On the film's grid.
    pub film: Seeded,
    /// On the tracer's grid, where it is another one.
    pub tracer: Option<Seeded>,
}

impl Seed {
    /// The departures of a function of direction from its mean, or from 0.
    #[must_use]
    pub fn new(grids: &SeedGrids, from_mean: bool, value: &(impl Fn(DVec3) -> f64 + Sync)) -> Self {
        let cap = grids.cap;
        let values = |sphere| Values::new(sphere, cap, value);
        let film = values(grids.film);
        let level = if from_mean { film.level(grids, value) } else { 0.0 };
        Self { level, film: film.seeded(level), tracer: grids.tracer.map(|sphere| values(sphere).seeded(level)) }
    }
}

/// A function's departures from a level on one grid, and what must be kept of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seeded {
    /// By padded index.
    #[serde(with = "crate::physics::bulk")]
    pub values: Vec<f32>,
    /// Their mean over the film.
    pub mean: f64,
    /// The least and the greatest.
    pub range: [f32; 2],
}

/// A function on a grid.
struct Values {
    /// By padded index.
    values: Vec<f64>,
    /// Solid angle of film in each cell, and the cell's padded index.
    cells: Vec<(f64, usize)>,
    film_area: f64,
}

impl Values {
    fn new(sphere: CubedSphere, cap: Option<Cap>, value: &(impl Fn(DVec3) -> f64 + Sync)) -> Self {
        let folded = |x| cap.map_or(x, |cap| cap.folded(x));
        let direction = sphere.padded_directions();
        let values = parallel::map(sphere.padded_len(), |index| value(folded(direction(index))));
        let areas = cap.map_or_else(|| sphere.areas(), |cap| cap.areas(sphere));
        let film_area = if cap.is_some() { areas.iter().sum() } else { 4.0 * std::f64::consts::PI };
        let place = |cell: usize| {
            let (panel, i, j) = sphere.cell(cell);
            sphere.padded_index(panel, i as isize, j as isize)
        };
        let cells = areas.into_iter().enumerate().map(|(cell, area)| (area, place(cell))).collect();
        Self { values, cells, film_area }
    }

    /// The mean over the film; 0 if it is not finite. Cells that the rim cuts count with the function's own value, not its image's.
    fn level(&self, grids: &SeedGrids, value: &impl Fn(DVec3) -> f64) -> f32 {
        let at = |(cell, (area, place)): (usize, &(f64, usize))| {
            let is_cut = *area > 0.0 && grids.cap.is_some_and(|cap| !cap.contains(grids.film.cell_direction(cell)));
            area * if is_cut { value(grids.film.cell_direction(cell)) } else { self.values[*place] }
        };
        let sum: f64 = self.cells.iter().enumerate().map(at).sum();
        if sum.is_finite() { (sum / self.film_area) as f32 } else { 0.0 }
    }

    fn seeded(self, level: f32) -> Seeded {
        let values: Vec<f32> = self.values.iter().map(|value| (value - f64::from(level)) as f32).collect();
        let mass: f64 = self.cells.iter().map(|(area, place)| area * f64::from(values[*place])).sum();
        let range = values.iter().fold([f32::MAX, f32::MIN], |[low, high], v| [low.min(*v), high.max(*v)]);
        Seeded { mean: mass / self.film_area, range, values }
    }
}
