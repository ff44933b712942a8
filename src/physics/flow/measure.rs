//! What a flow conserves, and how it compares with an exact one.

use glam::DVec3;

use crate::physics::sphere::CubedSphere;

/// Integrals over the unit sphere that a flow without friction or buoyancy conserves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants {
    /// Kinetic energy −½ ∫ψζ.
    pub energy: f64,
    /// Enstrophy ½ ∫ζ².
    pub enstrophy: f64,
    /// Angular momentum, up to a factor: ∫ζx.
    pub angular_momentum: DVec3,
}

/// The invariants of vorticity and stream function at each cell, in the grid's order.
#[must_use]
pub fn invariants(grid: CubedSphere, zeta: &[f64], psi: &[f64]) -> Invariants {
    let zero = Invariants { energy: 0.0, enstrophy: 0.0, angular_momentum: DVec3::ZERO };
    let cells = zeta.iter().zip(psi).zip(grid.areas()).enumerate();
    cells.fold(zero, |sum, (cell, ((&zeta, &psi), area))| Invariants {
        energy: sum.energy - 0.5 * area * psi * zeta,
        enstrophy: sum.enstrophy + 0.5 * area * zeta * zeta,
        angular_momentum: sum.angular_momentum + area * zeta * grid.cell_direction(cell),
    })
}

/// √(∫(values − exact)² / ∫exact²), both in the grid's order; not a number where they are not of one length.
#[must_use]
pub fn relative_l2(grid: CubedSphere, values: &[f64], exact: &[f64]) -> f64 {
    if values.len() != exact.len() || values.len() != grid.cells() {
        return f64::NAN;
    }
    let cells = values.iter().zip(exact).zip(grid.areas());
    let (error, norm) = cells.fold((0.0, 0.0), |(error, norm), ((value, exact), area)| {
        (error + area * (value - exact).powi(2), norm + area * exact * exact)
    });
    (error / norm).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invariants_of_solid_rotation() {
        let grid = CubedSphere::new(32).unwrap();
        let along = |factor: f64| -> Vec<f64> {
            (0..grid.cells()).map(|cell| factor * grid.cell_direction(cell).dot(DVec3::X)).collect()
        };
        let found = invariants(grid, &along(2.0), &along(-1.0));
        // ∫x² = 4π/3; point values times areas are a midpoint rule, with an error of D²/12 or so.
        let third = 4.0 * std::f64::consts::PI / 3.0;
        assert!((found.energy / third - 1.0).abs() < 1e-3 && (found.enstrophy / (2.0 * third) - 1.0).abs() < 1e-3);
        assert!(found.angular_momentum.distance(2.0 * third * DVec3::X) < 1e-2);
    }

    #[test]
    fn a_planted_error_is_measured() {
        let grid = CubedSphere::new(8).unwrap();
        let exact = vec![2.0; grid.cells()];
        let off = vec![2.5; grid.cells()];
        assert!((relative_l2(grid, &off, &exact) - 0.25).abs() < 1e-14);
        assert!(relative_l2(grid, &off[1..], &exact).is_nan());
        assert!(relative_l2(grid, &vec![f64::NAN; grid.cells()], &exact).is_nan());
    }
}
