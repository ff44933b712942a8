//! Error norms and diagnostics of the transport tests.

use crate::physics::sphere::CubedSphere;

/// How a transported field compares with the exact one. Integrals are weighted by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// I|φ − φ_exact| / I|φ_exact|.
    pub l1: f64,
    /// √(I(φ − φ_exact)² / I φ_exact²).
    pub l2: f64,
    /// max|φ − φ_exact| / max|φ_exact|.
    pub linf: f64,
    /// Relative change of Iφ from the initial field's; not a number for an initial field without mass.
    pub mass_drift: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
}

/// Compares a field's cell values, in the grid's order, with the exact ones and with the mass of the initial ones.
/// Nothing is a number in the answer unless all three have a value for each cell; nor are norms with a value that is none.
pub fn measure(grid: CubedSphere, values: &[f64], exact: &[f64], initial: &[f64]) -> Measured {
    if [values, exact, initial].iter().any(|field| field.len() != grid.cells()) {
        return INCOMPARABLE;
    }
    let areas = grid.areas();
    let integral = |of: &dyn Fn(usize) -> f64| (0..values.len()).map(|cell| areas[cell] * of(cell)).sum::<f64>();
    let largest = |of: &dyn Fn(usize) -> f64| (0..values.len()).map(of).fold(0.0, nan_max);
    let error = |cell: usize| (values[cell] - exact[cell]).abs();
    let mass = integral(&|cell| initial[cell]);
    Measured {
        l1: integral(&error) / integral(&|cell| exact[cell].abs()),
        l2: (integral(&|cell| error(cell).powi(2)) / integral(&|cell| exact[cell].powi(2))).sqrt(),
        linf: largest(&error) / largest(&|cell| exact[cell].abs()),
        mass_drift: (integral(&|cell| values[cell]) - mass) / mass,
        min: -values.iter().map(|value| -value).fold(f64::NEG_INFINITY, nan_max),
        max: values.iter().copied().fold(f64::NEG_INFINITY, nan_max),
    }
}

/// The answer for fields that are not on the grid.
const INCOMPARABLE: Measured =
    Measured { l1: f64::NAN, l2: f64::NAN, linf: f64::NAN, mass_drift: f64::NAN, min: f64::NAN, max: f64::NAN };

/// The larger of two, or not a number if either is not: `f64::max` would hide it.
fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_of_planted_errors() {
        let grid = CubedSphere::new(8).unwrap();
        let exact = vec![2.0; grid.cells()];
        let shifted = vec![2.5; grid.cells()];
        let found = measure(grid, &shifted, &exact, &exact);
        for norm in [found.l1, found.l2, found.linf, found.mass_drift] {
            assert!((norm - 0.25).abs() < 1e-14);
        }
        let mut spike = exact.clone();
        spike[17] = -1.0;
        let found = measure(grid, &spike, &exact, &exact);
        assert_eq!((found.linf, found.min, found.max), (1.5, -1.0, 2.0));
        assert!(found.l1 > 0.0 && found.l1 < found.l2 && found.mass_drift < 0.0);
    }

    #[test]
    fn a_field_that_is_not_finite_has_nan_errors() {
        let grid = CubedSphere::new(8).unwrap();
        let exact = vec![1.0; grid.cells()];
        let mut broken = exact.clone();
        broken[3] = f64::NAN;
        let found = measure(grid, &broken, &exact, &exact);
        assert!([found.l1, found.l2, found.linf, found.min, found.max].iter().all(|norm| norm.is_nan()));
    }
}
