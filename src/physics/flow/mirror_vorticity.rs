//! A rim as a wall of the flow, by the method of images: the twin of `shaders/pass/flow_mirror.wgsl`.
//!
//! On a sphere as on a plane a circle is a wall to a flow whose every vortex has an image behind it, which turns the other way round and
//! sits where the inversion x ↦ x* in the circle takes the vortex, because the inversion is conformal (Newton 2001, "The N-Vortex Problem").
//! With λ the factor by which the inversion stretches lines at x, beyond the rim
//!
//! ```text
//! ζ(x) = −λ² ζ(x*)                                                                                  (F9)
//! ```
//!
//! so that the circulation of every patch is taken back by its image, and ψ is constant on the rim.

use crate::physics::sphere::{Cap, HaloTable, PaddedField};

/// Vorticity ζ in 1/s with that beyond the rim of a film replaced by the image of what is within (F9). `halo` is the grid's table. The lookup is
/// linear: at the rim vorticity jumps, and a wider stencil would ring.
#[must_use]
pub fn mirrored(zeta: &PaddedField<f64>, cap: Cap, halo: &HaloTable) -> PaddedField<f64> {
    let (grid, cells) = (zeta.grid(), zeta.cells());
    PaddedField::from_cells(grid, halo, |cell| {
        let x = grid.cell_direction(cell);
        if cap.contains(x) { cells[cell] } else { -cap.stretch(x).powi(2) * zeta.bilinear(cap.image(x)) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;
    use glam::DVec3;

    fn field(n: usize, value: impl Fn(DVec3) -> f64 + Sync) -> (PaddedField<f64>, HaloTable) {
        let grid = CubedSphere::new(n).unwrap();
        let halo = HaloTable::new(grid);
        (PaddedField::sample_cells(grid, &halo, value), halo)
    }

    #[test]
    fn on_a_hemisphere_it_is_the_mirror_image_with_the_other_sign() {
        let (zeta, halo) = field(16, |x| x.x + 2.0 * x.z * x.y);
        let mirror = mirrored(&zeta, Cap::HEMISPHERE, &halo);
        let grid = zeta.grid();
        for (cell, value) in mirror.cells().into_iter().enumerate() {
            let x = grid.cell_direction(cell);
            let expected = if x.z >= 0.0 { x.x + 2.0 * x.z * x.y } else { -x.x + 2.0 * x.z * x.y };
            // The image of a cell is a cell.
            assert!((value - expected).abs() < 1e-12, "{x}: {value} {expected}");
        }
    }

    #[test]
    fn the_sphere_as_a_whole_does_not_turn() {
        for rim in [1.2, 2.2] {
            let circulation = [24, 48].map(|n| {
                let (zeta, halo) = field(n, |x| 1.0 + x.x * x.z);
                let areas = zeta.grid().areas();
                let cells = mirrored(&zeta, Cap::above(rim), &halo).cells();
                cells.iter().zip(areas).map(|(zeta, area)| zeta * area).sum::<f64>()
            });
            // Cells that the rim cuts count for one side alone: first order at worst, of a film of about 8 sr.
            assert!(circulation[0].abs() < 0.4 && circulation[1].abs() < 0.2, "{rim}: {circulation:?}");
        }
    }
}
