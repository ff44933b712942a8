//! A film as it begins.

use glam::DVec3;
use rayon::prelude::*;

use crate::gpu::grid::Grid;

/// A function's departures from a level by padded index, and what must be kept of them.
pub(super) struct Seeded {
    pub(super) values: Vec<f32>,
    pub(super) mean: f64,
    pub(super) range: [f32; 2],
}

impl Seeded {
    pub(super) fn new(grid: &Grid, level: f32, value: &(impl Fn(DVec3) -> f64 + Sync)) -> Self {
        let (sphere, cap) = (grid.sphere, grid.cap);
        let folded = |x| cap.map_or(x, |cap| cap.folded(x));
        let departure = |x| (value(folded(x)) - f64::from(level)) as f32;
        let indices = (0..sphere.padded_len()).into_par_iter();
        let values: Vec<f32> = indices.map(|index| departure(sphere.padded_direction(index))).collect();
        let place = |cell: usize| {
            let (panel, i, j) = sphere.cell(cell);
            sphere.padded_index(panel, i as isize, j as isize)
        };
        let areas = grid.film_areas();
        let mass: f64 = areas.iter().enumerate().map(|(cell, area)| area * f64::from(values[place(cell)])).sum();
        let range = values.iter().fold([f32::MAX, f32::MIN], |[low, high], v| [low.min(*v), high.max(*v)]);
        Self { mean: mass / grid.film_area, range, values }
    }
}

/// Mean of a function over a grid's cells, which its values depart from; 0 if the mean is not finite.
pub(super) fn level_of(grid: &Grid, value: &(impl Fn(DVec3) -> f64 + Sync)) -> f32 {
    // Without the grid's buffers, which in a browser no thread may share.
    let sphere = grid.sphere;
    let areas = grid.film_areas().into_par_iter().enumerate();
    let weighted: Vec<f64> = areas.map(|(cell, area)| area * value(sphere.cell_direction(cell))).collect();
    let sum: f64 = weighted.into_iter().sum();
    if sum.is_finite() { (sum / grid.film_area) as f32 } else { 0.0 }
}
