//! How halo cells get their values, as a table that the CPU and the GPU apply alike.
//!
//! A halo cell is a cell of its own panel's grid continued beyond the edge. On the neighbour's equiangular grid it lies exactly on
//! a row of cells parallel to the edge and between two cells of that row, so a 1-D interpolation along the row is all it takes. The
//! same holds for the cells beyond a corner, whose rows run on into the neighbour's halo: they come second.

use bytemuck::{Pod, Zeroable};

use super::{CubedSphere, HALO, PanelPoint, cubic_weights};

/// One halo cell: `value[cell] = Σ weights[k] · value[first + k · step]`, all in padded indices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct HaloEntry {
    /// Lagrange weights. Their sum is exactly 1, so that constants stay constant in any precision.
    pub weights: [f32; 4],
    /// The halo cell.
    pub cell: u32,
    /// The first of four cells in a row on the neighbour panel.
    pub first: u32,
    /// From each of them to the next.
    pub step: u32,
    /// Nothing.
    pub padding: u32,
}

impl HaloEntry {
    /// The cells that the halo cell is interpolated from, numbered from 0 to 3.
    pub fn source(&self, k: u32) -> u32 {
        self.first + k * self.step
    }
}

/// The halo cells of a grid in two passes: all of `edges`, then all of `corners`, each from the innermost ring outwards. Within a pass any
/// order gives the same values. The 24 innermost corners read no edge cells beyond the second ring.
#[derive(Clone, Debug, PartialEq)]
pub struct HaloTable {
    /// The 48·N cells beyond one edge; they read inner cells only.
    pub edges: Vec<HaloEntry>,
    /// The 96 cells beyond two edges at once; they read inner and edge cells.
    pub corners: Vec<HaloEntry>,
}

impl HaloTable {
    /// The table of a grid.
    pub fn new(grid: CubedSphere) -> Self {
        let n = grid.n() as isize;
        let span = -(HALO as isize)..n + HALO as isize;
        let depth = |k: isize| (-k).max(k + 1 - n).max(0);
        let outside = |k: isize| usize::from(depth(k) > 0);
        let beyond = |edges: usize| {
            let span = span.clone();
            (0..6).flat_map(move |panel| {
                let rows = span.clone();
                let columns = span.clone();
                rows.flat_map(move |j| columns.clone().map(move |i| (panel, i, j)))
                    .filter(move |&(_, i, j)| outside(i) + outside(j) == edges)
            })
        };
        let entries = |edges, reach| {
            let mut cells: Vec<_> = beyond(edges).collect();
            cells.sort_by_key(|&(_, i, j)| depth(i).max(depth(j)));
            cells.into_iter().map(|(panel, i, j)| entry(grid, panel, i, j, reach)).collect()
        };
        Self { edges: entries(1, 0), corners: entries(2, HALO as isize) }
    }
}

/// The entry of halo cell (i, j) of a panel; its stencil may reach that many cells beyond the neighbour's ends.
fn entry(grid: CubedSphere, panel: usize, i: isize, j: isize, reach: isize) -> HaloEntry {
    let place = grid.locate(grid.direction(PanelPoint { panel, x: i as f64, y: j as f64 }));
    // One coordinate is a whole number but for rounding; should both be, then either way is exact.
    let along_x = off_center(place.x) > off_center(place.y);
    let (along, across) = if along_x { (place.x, place.y) } else { (place.y, place.x) };
    let row = across.round() as isize;
    let first = (along.floor() as isize - 1).clamp(-reach, grid.n() as isize + reach - 4);
    let (first_i, first_j) = if along_x { (first, row) } else { (row, first) };
    HaloEntry {
        weights: unit_sum(cubic_weights(along - (first + 1) as f64)),
        cell: grid.padded_index(panel, i, j) as u32,
        first: grid.padded_index(place.panel, first_i, first_j) as u32,
        step: if along_x { 1 } else { grid.padded_width() as u32 },
        padding: 0,
    }
}

/// Distance from the nearest cell center.
fn off_center(coordinate: f64) -> f64 {
    (coordinate - coordinate.round()).abs()
}

/// Rounds weights to multiples of 2⁻²³, which f32 holds exactly up to 2, and gives the largest what is missing to 1.
fn unit_sum(weights: [f64; 4]) -> [f32; 4] {
    const ONE: f64 = (1 << 23) as f64;
    let mut steps = weights.map(|weight| (weight * ONE).round());
    let missing = ONE - steps.iter().sum::<f64>();
    let largest = (0..4).fold(0, |best, k| if steps[k] > steps[best] { k } else { best });
    steps[largest] += missing;
    steps.map(|step| (step / ONE) as f32)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn inner_rings_come_first_and_their_corners_need_two_of_them() {
        for n in [8, 15, 40] {
            let table = HaloTable::new(CubedSphere::new(n).unwrap());
            let outer: HashSet<u32> = table.edges[48 * n..].iter().map(|entry| entry.cell).collect();
            let corners = &table.corners[..24];
            assert!(corners.iter().all(|entry| (0..4).all(|k| !outer.contains(&entry.source(k)))));
            let width = n + 2 * HALO;
            let inner = |k: usize| k == HALO - 1 || k == HALO + n;
            assert!(corners.iter().all(|entry| {
                let place = entry.cell as usize % (width * width);
                inner(place % width) && inner(place / width)
            }));
        }
    }

    #[test]
    fn the_index_across_the_edge_is_exact() {
        let grid = CubedSphere::new(13).unwrap();
        for index in 0..13 {
            let beyond = PanelPoint { panel: 0, x: 14.0, y: f64::from(index) };
            let place = grid.locate(grid.direction(beyond));
            assert_eq!(place.panel, 1);
            assert!((place.x - 1.0).abs() < 1e-12);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        #[test]
        fn a_table_fills_each_halo_cell_once_from_what_is_ready(n in 8_usize..=70) {
            let grid = CubedSphere::new(n).unwrap();
            let table = HaloTable::new(grid);
            let cells = (0..grid.cells()).map(|index| grid.cell(index));
            let mut ready: HashSet<u32> =
                cells.map(|(panel, i, j)| grid.padded_index(panel, i as isize, j as isize) as u32).collect();
            for pass in [&table.edges, &table.corners] {
                prop_assert!(pass.iter().all(|entry| (0..4).all(|k| ready.contains(&entry.source(k)))));
                ready.extend(pass.iter().map(|entry| entry.cell));
            }
            prop_assert_eq!(ready.len(), grid.padded_len());
        }

        #[test]
        fn weights_keep_constants_and_lead_to_the_halo_cell(n in 8_usize..=70) {
            let grid = CubedSphere::new(n).unwrap();
            let table = HaloTable::new(grid);
            // A cubic through cells an angle apart errs by (3/128) angle⁴ of the fourth derivative, which is 1 at most for a direction.
            let limit = grid.cell_angle().powi(4) + 1e-6;
            for entry in table.edges.iter().chain(&table.corners) {
                prop_assert_eq!(entry.weights.iter().map(|&w| f64::from(w)).sum::<f64>(), 1.0);
                let at = |cell: u32| grid.padded_direction(cell as usize);
                let terms = (0..4).zip(entry.weights);
                let found: glam::DVec3 = terms.map(|(k, weight)| f64::from(weight) * at(entry.source(k))).sum();
                prop_assert!(found.distance(at(entry.cell)) < limit, "{}", found.distance(at(entry.cell)));
            }
        }
    }
}
