//! The drop that may hang at the bottom of a film, as a region that is held fast: the twin of `shaders/pass/flow_pin.wgsl`.
//!
//! With s(ϑ) = 1 in the inner part of the drop, 0 outside of it and a smooth step between, ψ̄ the mean of ψ over that step weighted by s(1 − s),
//!
//! ```text
//! ψ ← (1 − s) ψ + s ψ̄,     ζ ← (1 − s) ζ                                                            (F10)
//! ```
//!
//! Where ψ is constant nothing flows, and a flow past the drop goes around it.

use glam::DVec3;

use super::operators::CellMetric;
use crate::physics::sphere::{CubedSphere, HaloTable, PaddedField};

/// Minimum cells from the edge of the region to where nothing flows, as the differences of the flow need.
const MIN_WIDTH_CELLS: f64 = 3.0;

/// A round region about the lowest point of a film in which nothing flows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinnedRegion {
    /// Angle from the lowest point at which the region begins to hold the film, radians.
    pub outer: f64,
    /// Angle within which nothing flows, radians.
    pub inner: f64,
}

impl PinnedRegion {
    /// A region of an angular radius on a grid with an angle between cells, both in radians. It holds the film fast within half of its radius,
    /// and is never narrower than three cells.
    #[must_use]
    pub fn new(radius: f64, cell_angle: f64) -> Self {
        let width = (0.5 * radius).max(MIN_WIDTH_CELLS * cell_angle);
        Self { outer: radius.max(width), inner: (radius - width).max(0.0) }
    }

    /// How firmly the film is held at unit vector `x`, s: 0 to 1.
    #[must_use]
    pub fn firmness(&self, x: DVec3) -> f64 {
        if x.z >= 0.0 {
            return 0.0;
        }
        let angle = 2.0 * (0.5 * x.distance(DVec3::NEG_Z)).min(1.0).asin();
        let t = ((angle - self.inner) / (self.outer - self.inner)).clamp(0.0, 1.0);
        1.0 - t * t * (3.0 - 2.0 * t)
    }

    /// Vorticity in 1/s and stream function in rad²/s after (F10), in this order. `halo` is the table of their grid.
    #[must_use]
    pub fn stopped(
        &self,
        zeta: &PaddedField<f64>,
        psi: &PaddedField<f64>,
        halo: &HaloTable,
    ) -> (PaddedField<f64>, PaddedField<f64>) {
        let (grid, [zeta, psi]) = (psi.grid(), [zeta.cells(), psi.cells()]);
        let firm: Vec<f64> = (0..grid.cells()).map(|cell| self.firmness(grid.cell_direction(cell))).collect();
        let at_rim = mean_at_rim(grid, &firm, &psi);
        let mixed = |cell: usize| psi[cell] + firm[cell] * (at_rim - psi[cell]);
        let left = |cell: usize| (1.0 - firm[cell]) * zeta[cell];
        (PaddedField::from_cells(grid, halo, left), PaddedField::from_cells(grid, halo, mixed))
    }
}

/// Mean of values over where the film is partly held.
fn mean_at_rim(grid: CubedSphere, firm: &[f64], values: &[f64]) -> f64 {
    let weight = |cell: usize| CellMetric::new(grid, cell).area_density() * firm[cell] * (1.0 - firm[cell]);
    let sums = (0..values.len()).map(|cell| (weight(cell), values[cell]));
    let (weights, sum) = sums.fold((0.0, 0.0), |(weights, sum), (w, value)| (weights + w, sum + w * value));
    sum / f64::max(weights, 1e-20)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::flow::turned_gradient;

    #[test]
    fn nothing_flows_inside_and_nothing_changes_outside() {
        let grid = CubedSphere::new(32).unwrap();
        let (halo, region) = (HaloTable::new(grid), PinnedRegion::new(0.8, grid.cell_angle()));
        let psi = PaddedField::sample_cells(grid, &halo, |x| (2.0 * x.x).sin() + x.z * x.y);
        let zeta = PaddedField::sample_cells(grid, &halo, |x| x.y - 3.0 * x.x * x.z);
        let (held_zeta, held_psi) = region.stopped(&zeta, &psi, &halo);
        let angle = |cell| std::f64::consts::PI - grid.cell_direction(cell).z.acos();
        for cell in 0..grid.cells() {
            if angle(cell) > region.outer {
                assert_eq!((held_zeta.cells()[cell], held_psi.cells()[cell]), (zeta.cells()[cell], psi.cells()[cell]));
            } else if angle(cell) < region.inner - 3.0 * grid.cell_angle() {
                let u = turned_gradient(&held_psi, cell);
                assert!(held_zeta.cells()[cell] == 0.0 && u.length() < 1e-13, "{u}");
            }
        }
    }

    #[test]
    fn a_small_drop_is_as_wide_as_differences_need() {
        let region = PinnedRegion::new(0.01, 0.1);
        assert!((region.outer - 0.3).abs() < 1e-15 && region.inner == 0.0);
        assert_eq!([DVec3::NEG_Z, DVec3::Z, DVec3::X].map(|x| region.firmness(x)), [1.0, 0.0, 0.0]);
        let wide = PinnedRegion::new(0.8, 0.1);
        assert_eq!((wide.outer, wide.inner), (0.8, 0.4));
    }
}
