//! The collapse of thin film to black film: the twin of `shaders/pass/blacken.wgsl`.
//!
//! Film whose surfaces attract each other thins to black film of thickness h_b within a fraction of a second. Where the mean thickness h̄ around a
//! cell is below the onset h_c, the difference to black film decays for a time t at a rate k, which sets in within a tenth of the onset:
//!
//! ```text
//! lost = max(h − h_b, 0) (1 − e^(−k r t)),     r = clamp((h_c − h̄) / 0.1 h_c, 0, 1)                  (B1)
//! ```
//!
//! It is the film *around* a cell that must be thin, and no cell counts there for more than makes a straight border stand still: borders then
//! straighten, as a line under tension does (Merriman, Bence & Osher 1992), and black spots are round. Film thinner than [`NUCLEATION_NM`]
//! collapses around a nucleus of black film too (see [`Nucleus`]). With s a smooth step from the nucleus's middle to its radius:
//!
//! ```text
//! lost = max(h − h_b, 0) max(1 − e^(−k r t), s)                                                      (B2)
//! ```
//!
//! What collapses has left the border before a picture could show it: a rim that gathers it is far narrower than cells, sinks, and spreads. The film
//! as a whole gets it, when its liquid is restored; kept in the cells along the border it stays there, in a maze of silver.

use glam::DVec3;

use crate::physics::{
    film::{
        NUCLEATION_NM, Nucleus,
        properties::{BLACK_FILM_COLLAPSE, BLACK_FILM_NM, BLACK_FILM_ONSET},
    },
    sphere::{HALO, HaloTable, PaddedField},
};

/// Nuclei that a film takes in one step at most.
pub const MAX_NUCLEI: usize = 32;
/// Cells on each side that count for a cell's mean.
const REACH: usize = 3;
/// Part of the onset within which the collapse sets in: borders are smooth, and some cells wide.
const ONSET_WIDTH: f64 = 0.1;

/// How film collapses, now.
#[derive(Clone, Debug, PartialEq)]
pub struct BlackeningLaw {
    /// What has evaporated from the film, nm.
    pub evaporated_nm: f64,
    /// Thickness of black film, at which evaporation ends, h_b, nm.
    pub black_nm: f64,
    /// Thickness below which film collapses, h_c, nm.
    pub onset_nm: f64,
    /// Rate at which the difference to black film decays, k, 1/tick.
    pub rate: f64,
    /// Nuclei of the last ticks, each with the ticks since it formed, the youngest first: [`MAX_NUCLEI`] of them count.
    pub nuclei: Vec<(Nucleus, u32)>,
}

impl BlackeningLaw {
    /// The law of [`BLACK_FILM_NM`], [`BLACK_FILM_ONSET`] and [`BLACK_FILM_COLLAPSE`] for a film from which so much has evaporated, in ticks of a
    /// length in seconds.
    #[must_use]
    pub fn new(evaporated_nm: f64, tick_s: f64) -> Self {
        Self {
            evaporated_nm,
            black_nm: BLACK_FILM_NM,
            onset_nm: 1e9 * BLACK_FILM_ONSET,
            rate: BLACK_FILM_COLLAPSE * tick_s,
            nuclei: Vec::new(),
        }
    }
}

/// Thickness in nm that is left of film from which so much would have evaporated: evaporation ends at black film, and what is thinner stays
/// as it is.
#[must_use]
pub fn remaining_nm(thickness_nm: f64, evaporated_nm: f64) -> f64 {
    (thickness_nm - evaporated_nm).max(thickness_nm.min(BLACK_FILM_NM))
}

/// A tracer, which departs from a level in nm, with what did not evaporate of film that was black already given back to it.
#[must_use]
pub fn stop_evaporation(tracer: &PaddedField<f64>, law: &BlackeningLaw, level_nm: f64) -> PaddedField<f64> {
    let remaining_level_nm = level_nm - law.evaporated_nm;
    let spared = |departure: &f64| {
        let left = (departure + remaining_level_nm).max((departure + level_nm).min(law.black_nm));
        departure.max(left - remaining_level_nm)
    };
    PaddedField::from_padded(tracer.grid(), tracer.padded().iter().map(spared).collect())
}

/// A film before it collapses.
struct Collapse<'a> {
    law: &'a BlackeningLaw,
    tracer: &'a PaddedField<f64>,
    /// Means of the tracer around cells.
    means: PaddedField<f64>,
    /// What the tracer departs from, less what has evaporated, nm.
    level_nm: f64,
    /// Ticks since the last remap.
    ticks: u32,
}

/// A tracer, which departs from a level in nm, after it has collapsed for some ticks (B2). `halo` is the grid's table. What collapsed is
/// missing: restore it.
#[must_use]
pub fn collapse(
    tracer: &PaddedField<f64>,
    law: &BlackeningLaw,
    level_nm: f64,
    ticks: u32,
    halo: &HaloTable,
) -> PaddedField<f64> {
    let (grid, level_nm) = (tracer.grid(), level_nm - law.evaporated_nm);
    let film = Collapse {
        law,
        tracer,
        means: means(tracer, 2.0 * law.onset_nm - law.black_nm - level_nm, halo),
        level_nm,
        ticks,
    };
    let left = |place: usize| tracer.padded()[place] - film.lost_nm(place);
    PaddedField::from_places(grid, HALO, left).with_bounded_halo(halo)
}

/// Means of a tracer around cells, no value counting for more than a limit.
fn means(tracer: &PaddedField<f64>, limit: f64, halo: &HaloTable) -> PaddedField<f64> {
    let (grid, width) = (tracer.grid(), tracer.grid().padded_width());
    let is_inside = |column: usize| (HALO..width - HALO).contains(&column);
    // Along rows, including rows of the halo, then along columns.
    let along_row = |place: usize| {
        if is_inside(place % width) { mean_along(tracer.padded(), place, 1, limit) } else { 0.0 }
    };
    let rows = PaddedField::from_places(grid, 0, along_row);
    let along_column = |place: usize| mean_along(rows.padded(), place, width, limit);
    PaddedField::from_places(grid, HALO, along_column).with_bounded_halo(halo)
}

/// The mean over the cells before and after one that are so far apart in storage, nearer ones counting more.
fn mean_along(values: &[f64], place: usize, stride: usize, limit: f64) -> f64 {
    let counted = |place: usize| values[place].min(limit);
    let weight = |k: usize| (REACH + 1 - k) as f64;
    let pairs = (1..=REACH).map(|k| weight(k) * (counted(place - k * stride) + counted(place + k * stride)));
    (weight(0) * counted(place) + pairs.sum::<f64>()) / weight(0).powi(2)
}

impl Collapse<'_> {
    fn mean_nm(&self, place: usize) -> f64 {
        self.means.padded()[place] + self.level_nm
    }

    fn thickness_nm(&self, place: usize) -> f64 {
        self.tracer.padded()[place] + self.level_nm
    }

    /// What a cell loses (B2), nm.
    fn lost_nm(&self, place: usize) -> f64 {
        let BlackeningLaw { black_nm, onset_nm, rate, .. } = *self.law;
        let below = (onset_nm - self.mean_nm(place)) / (ONSET_WIDTH * onset_nm);
        let decayed = -(-below.clamp(0.0, 1.0) * rate * f64::from(self.ticks)).exp_m1();
        (self.thickness_nm(place) - black_nm).max(0.0) * decayed.max(self.nucleated(place))
    }

    /// How far nuclei that formed since the last remap let a cell collapse, 0 to 1.
    fn nucleated(&self, place: usize) -> f64 {
        let grid = self.tracer.grid();
        let x = grid.padded_direction(place);
        let new = self.law.nuclei.iter().take(MAX_NUCLEI).filter(|(_, age)| *age < self.ticks);
        let has_nuclei = |middle: DVec3| self.thickness_nm(grid.padded_place(middle)) < NUCLEATION_NM;
        new.filter(|(nucleus, _)| x.distance(nucleus.middle) < nucleus.radius && has_nuclei(nucleus.middle))
            .map(|(nucleus, _)| nucleus.collapsed(x))
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;
    use glam::DVec3;

    const LEVEL_NM: f64 = 100.0;

    fn law(evaporated_nm: f64) -> BlackeningLaw {
        BlackeningLaw::new(evaporated_nm, 1.0 / 60.0)
    }

    fn film(nm: impl Fn(DVec3) -> f64 + Sync) -> (PaddedField<f64>, HaloTable) {
        let grid = CubedSphere::new(24).unwrap();
        (PaddedField::sample(grid, move |x| nm(x) - LEVEL_NM), HaloTable::new(grid))
    }

    #[test]
    fn thin_film_becomes_black_and_thick_film_stays() {
        let (tracer, halo) = film(|x| if x.z > 0.5 { 40.0 } else { 200.0 });
        let after = (0..50).fold(tracer, |film, _| collapse(&film, &law(0.0), LEVEL_NM, 6, &halo));
        let at = |x: DVec3| LEVEL_NM + after.bilinear(x);
        assert!((at(DVec3::Z) - BLACK_FILM_NM).abs() < 0.1, "{}", at(DVec3::Z));
        assert_eq!(at(DVec3::NEG_Z), 200.0);
    }

    #[test]
    fn a_nucleus_opens_a_round_spot_in_thin_film_and_none_in_thicker() {
        let (tracer, halo) = film(|x| if x.z > 0.0 { 100.0 } else { 200.0 });
        let nucleus = |middle: DVec3| Nucleus { middle, radius: 0.2 };
        let at = |middle: DVec3, age: u32| {
            let law = BlackeningLaw { nuclei: vec![(nucleus(middle), age)], ..law(0.0) };
            collapse(&tracer, &law, LEVEL_NM, 6, &halo)
        };
        let middle = DVec3::new(0.3, -0.4, 0.8).normalize();
        let spotted = at(middle, 3);
        for (cell, (before, after)) in tracer.cells().into_iter().zip(spotted.cells()).enumerate() {
            let away = tracer.grid().cell_direction(cell).distance(middle);
            let lost = before - after;
            assert!(if away < 0.13 { (lost - 90.0).abs() < 1e-9 } else { away < 0.2 || lost == 0.0 }, "{away} {lost}");
        }
        assert_eq!(at(-middle, 3).cells(), tracer.cells(), "the film there is too thick");
        assert_eq!(at(middle, 6).cells(), tracer.cells(), "it formed before the last remap");
    }

    #[test]
    fn evaporation_ends_at_black_film() {
        let (tracer, _) = film(|x| 30.0 + 20.0 * x.z);
        let spared = stop_evaporation(&tracer, &law(25.0), LEVEL_NM);
        for (before, after) in tracer.padded().iter().zip(spared.padded()) {
            let [before, after] = [before, after].map(|departure| LEVEL_NM + departure);
            assert!((remaining_nm(before, 25.0) - (after - 25.0)).abs() < 1e-12, "{before} {after}");
        }
        assert_eq!(
            (remaining_nm(500.0, 100.0), remaining_nm(12.0, 100.0), remaining_nm(4.0, 100.0)),
            (400.0, 10.0, 4.0)
        );
    }
}
