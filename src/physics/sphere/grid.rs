//! The equiangular cubed sphere: where its cells are, how large they are, and how their values are ordered in memory.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Cells of padding around each panel: what a 6×6 stencil reads beyond the edge, and no more.
pub const HALO: usize = 3;

/// The axes `[f, r, u]` of the six panels: a panel looks along `f`, its index i grows along `r` and j along `u`.
pub const PANELS: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::Y, DVec3::Z],
    [DVec3::Y, DVec3::NEG_X, DVec3::Z],
    [DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z],
    [DVec3::NEG_Y, DVec3::X, DVec3::Z],
    [DVec3::Z, DVec3::Y, DVec3::NEG_X],
    [DVec3::NEG_Z, DVec3::Y, DVec3::X],
];

/// Why a grid could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "{0} cells along a cube edge is out of range: use {min} to {max}",
    min = CubedSphere::MIN_N,
    max = CubedSphere::MAX_N
)]
pub struct GridError(pub usize);

/// A place on the grid in fractional cell coordinates: the center of cell (i, j) is at `x = i`, `y = j`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelPoint {
    /// Panel, 0 to 5.
    pub panel: usize,
    /// Coordinate along `r`; −0.5 to N − 0.5 inside the panel.
    pub x: f64,
    /// Coordinate along `u`; −0.5 to N − 0.5 inside the panel.
    pub y: f64,
}

/// An equiangular cubed sphere with N × N cells on each of its six panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct CubedSphere {
    n: usize,
}

impl CubedSphere {
    /// The coarsest grid: below this the two halos of a panel are no longer thin beside it.
    pub const MIN_N: usize = 8;
    /// The finest grid: padded indices fit 32 bits with room to spare.
    pub const MAX_N: usize = 8192;

    /// The grid with `n` cells along a cube edge. Fails outside [`Self::MIN_N`]..=[`Self::MAX_N`].
    pub fn new(n: usize) -> Result<Self, GridError> {
        if (Self::MIN_N..=Self::MAX_N).contains(&n) { Ok(Self { n }) } else { Err(GridError(n)) }
    }

    /// Cells along a cube edge, N.
    pub fn n(self) -> usize {
        self.n
    }

    /// Cells in all, 6N².
    pub fn cells(self) -> usize {
        6 * self.n * self.n
    }

    /// The angle D = π/(2N) between neighbouring cell centers along a panel's axes, in radians.
    pub fn cell_angle(self) -> f64 {
        FRAC_PI_2 / self.n as f64
    }

    /// Panel, i and j of a cell, given its place in the order panel, j, i.
    pub fn cell(self, index: usize) -> (usize, usize, usize) {
        let row = index / self.n;
        (row / self.n, index % self.n, row % self.n)
    }

    /// The unit vector at fractional cell coordinates, which may lie outside the panel (halo cells do).
    pub fn direction(self, point: PanelPoint) -> DVec3 {
        let [f, r, u] = PANELS[point.panel];
        (f + self.tangent(point.x) * r + self.tangent(point.y) * u).normalize()
    }

    /// The unit vector at the center of a cell, given its place in the order panel, j, i.
    pub fn cell_direction(self, index: usize) -> DVec3 {
        let (panel, i, j) = self.cell(index);
        self.direction(PanelPoint { panel, x: i as f64, y: j as f64 })
    }

    /// The inverse of [`Self::direction`] for any non-zero vector: the panel it points through, coordinates within
    /// [−0.5, N − 0.5]. A vector on an edge belongs to either panel.
    pub fn locate(self, direction: DVec3) -> PanelPoint {
        let panel = panel_of(direction);
        let [f, r, u] = PANELS[panel];
        let depth = direction.dot(f);
        let coordinate = |axis: DVec3| {
            let angle = (direction.dot(axis) / depth).atan() + FRAC_PI_4;
            (angle / self.cell_angle() - 0.5).clamp(-0.5, self.n as f64 - 0.5)
        };
        PanelPoint { panel, x: coordinate(r), y: coordinate(u) }
    }

    /// The solid angle of cell (i, j) of any panel, in steradians; all cells together make 4π.
    pub fn cell_area(self, i: usize, j: usize) -> f64 {
        let [x0, x1] = [i as f64 - 0.5, i as f64 + 0.5].map(|x| self.tangent(x));
        let [y0, y1] = [j as f64 - 0.5, j as f64 + 0.5].map(|y| self.tangent(y));
        (pyramid(x1, y1) - pyramid(x0, y1)) - (pyramid(x1, y0) - pyramid(x0, y0))
    }

    /// The solid angles of the cells of one panel in the order j, i: those of [`Self::cell_area`], with what neighbours share computed once.
    pub fn panel_areas(self) -> Vec<f64> {
        let n = self.n;
        let edges: Vec<f64> = (0..=n).map(|k| self.tangent(k as f64 - 0.5)).collect();
        let corners = |y: f64| edges.iter().map(|x| pyramid(*x, y)).collect::<Vec<_>>();
        let mut areas = Vec::with_capacity(n * n);
        let mut below = corners(edges[0]);
        for y in &edges[1..] {
            let above = corners(*y);
            areas.extend((0..n).map(|i| (above[i + 1] - above[i]) - (below[i + 1] - below[i])));
            below = above;
        }
        areas
    }

    /// The solid angles of all cells in the order panel, j, i.
    pub fn areas(self) -> Vec<f64> {
        self.panel_areas().repeat(6)
    }

    /// Values along a row of a padded panel, N + 2·[`HALO`].
    pub fn padded_width(self) -> usize {
        self.n + 2 * HALO
    }

    /// tan(α) of each cell coordinate of an edge, halo included, rounded once from f64: what passes find directions from.
    pub fn edge_tangents(self) -> Vec<f32> {
        let angle = |k: usize| (k as f64 - HALO as f64 + 0.5) * self.cell_angle() - FRAC_PI_4;
        (0..self.padded_width()).map(|k| angle(k).tan() as f32).collect()
    }

    /// Values in padded storage, halos included.
    pub fn padded_len(self) -> usize {
        6 * self.padded_width().pow(2)
    }

    /// The place of cell (i, j) in padded storage; i and j run from −[`HALO`] to N + [`HALO`] − 1.
    pub fn padded_index(self, panel: usize, i: isize, j: isize) -> usize {
        let width = self.padded_width();
        let (i, j) = (i + HALO as isize, j + HALO as isize);
        (panel * width + j as usize) * width + i as usize
    }

    /// The unit vector at a place in padded storage, the inverse of [`Self::padded_index`].
    pub fn padded_direction(self, index: usize) -> DVec3 {
        let width = self.padded_width();
        let row = index / width;
        let (x, y) = ((index % width) as f64 - HALO as f64, (row % width) as f64 - HALO as f64);
        self.direction(PanelPoint { panel: row / width, x, y })
    }

    /// The place in padded storage of the cell that a unit vector is in.
    pub fn padded_place(self, direction: DVec3) -> usize {
        let PanelPoint { panel, x, y } = self.locate(direction);
        self.padded_index(panel, x.round() as isize, y.round() as isize)
    }

    /// [`Self::padded_direction`] as a function, with what many directions share computed once.
    pub fn padded_directions(self) -> impl Fn(usize) -> DVec3 + Sync {
        let width = self.padded_width();
        let tangents: Vec<f64> = (0..width).map(|k| self.tangent(k as f64 - HALO as f64)).collect();
        move |index| {
            let row = index / width;
            let [f, r, u] = PANELS[row / width];
            (f + tangents[index % width] * r + tangents[row % width] * u).normalize()
        }
    }

    /// Tangent of the angle from the panel's middle at a fractional cell coordinate.
    fn tangent(self, coordinate: f64) -> f64 {
        ((coordinate + 0.5) * self.cell_angle() - FRAC_PI_4).tan()
    }
}

/// The panel that a vector points through, by its largest component.
fn panel_of(v: DVec3) -> usize {
    let size = v.abs();
    let (pair, component) = if size.x >= size.y && size.x >= size.z {
        ([0, 2], v.x)
    } else if size.y >= size.z {
        ([1, 3], v.y)
    } else {
        ([4, 5], v.z)
    };
    pair[usize::from(component < 0.0)]
}

/// Solid angle of the rectangle [0, x] × [0, y] on the plane at distance 1, seen from the origin.
fn pyramid(x: f64, y: f64) -> f64 {
    (x * y / (1.0 + x * x + y * y).sqrt()).atan()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn panels_are_right_handed_frames_that_cover_the_six_axes() {
        for [f, r, u] in PANELS {
            assert_eq!(f.cross(r), u);
        }
        assert_eq!(PANELS.iter().map(|axes| axes[0]).sum::<DVec3>(), DVec3::ZERO);
    }

    #[test]
    fn areas_sum_to_the_sphere() {
        for n in [8, 17, 60, 255] {
            let areas = CubedSphere::new(n).unwrap().areas();
            let sum: f64 = areas.iter().sum();
            assert_eq!(areas.len(), 6 * n * n);
            // Summing 4e5 terms loses a few digits on top of the closed form's 1e-16.
            assert!((sum - 4.0 * PI).abs() < 1e-12, "N = {n}: {:e}", sum - 4.0 * PI);
        }
    }

    #[test]
    fn areas_of_a_panel_are_those_of_its_cells() {
        let grid = CubedSphere::new(17).unwrap();
        let cells: Vec<f64> = (0..17 * 17).map(|cell| grid.cell_area(cell % 17, cell / 17)).collect();
        assert_eq!(grid.panel_areas(), cells);
    }

    #[test]
    fn an_area_is_its_density_times_the_cell_at_fine_resolution() {
        let grid = CubedSphere::new(400).unwrap();
        let (i, j) = (17, 310);
        let [a, b] = [i, j].map(|k| grid.tangent(k as f64));
        // Metric of the equiangular projection: (1 + a²)(1 + b²) / (1 + a² + b²)^(3/2).
        let density = (1.0 + a * a) * (1.0 + b * b) / (1.0 + a * a + b * b).powf(1.5);
        let relative = grid.cell_area(i, j) / (density * grid.cell_angle().powi(2)) - 1.0;
        assert!(relative.abs() < 1e-5, "midpoint rule, error O(D²): {relative:e}");
    }

    #[test]
    fn locate_accepts_the_corners_and_edges() {
        let grid = CubedSphere::new(16).unwrap();
        for v in [DVec3::ONE, -DVec3::ONE, DVec3::new(1.0, -1.0, 0.3), DVec3::NEG_Z] {
            let back = grid.direction(grid.locate(v));
            assert!(back.distance(v.normalize()) < 1e-14);
        }
    }

    #[test]
    fn sizes_out_of_range_are_refused() {
        assert_eq!(CubedSphere::new(7), Err(GridError(7)));
        assert!(CubedSphere::new(8193).unwrap_err().to_string().contains("use 8 to 8192"));
    }

    proptest! {
        #[test]
        fn locate_inverts_direction(n in 8_usize..=8192, v in prop::array::uniform3(-1.0..1.0), length in 1e-3..1e3) {
            let v = DVec3::from(v);
            prop_assume!(v.length() > 1e-3);
            let grid = CubedSphere::new(n).unwrap();
            let place = grid.locate(length * v);
            prop_assert!(grid.direction(place).distance(v.normalize()) < 1e-14);
            let edge = n as f64 - 0.5 + 1e-9;
            prop_assert!(place.panel < 6 && [place.x, place.y].iter().all(|k| (-0.5 - 1e-9..=edge).contains(k)));
        }

        #[test]
        fn a_cells_center_is_located_in_the_cell(n in 8_usize..=500, at in 0.0..1.0) {
            let grid = CubedSphere::new(n).unwrap();
            let index = (at * grid.cells() as f64) as usize;
            let (panel, i, j) = grid.cell(index);
            let found = grid.locate(grid.cell_direction(index));
            prop_assert_eq!(found.panel, panel);
            prop_assert!((found.x - i as f64).abs() < 1e-10 && (found.y - j as f64).abs() < 1e-10);
        }
    }

    #[test]
    fn directions_by_shared_tangents_have_the_same_bits() {
        let grid = CubedSphere::new(9).unwrap();
        let direction = grid.padded_directions();
        assert!((0..grid.padded_len()).all(|index| direction(index) == grid.padded_direction(index)));
    }
}
