//! Differential operators at cell centers of the equiangular cubed sphere.
//!
//! The panel coordinates α and β are longitudes about two axes, and so are harmonic: in them the Laplacian has no first derivatives,
//! `Δψ = δ² [ψ_αα / A + 2 X Y ψ_αβ / (A B) + ψ_ββ / B]` with `X = tan α`, `Y = tan β`, `A = 1 + X²`, `B = 1 + Y²`, `δ² = 1 + X² + Y²`
//! (from the metric of Ronchi, Iacono & Paolucci 1996). Constants are in its kernel exactly. Derivatives are central differences, which
//! read the halo and so know nothing of panel edges.

use std::f64::consts::FRAC_PI_4;

use glam::DVec3;

use crate::physics::sphere::{CubedSphere, HALO, PANELS, PaddedField};

/// Where a cell is in its panel.
#[derive(Clone, Copy, Debug)]
pub struct CellMetric {
    panel: usize,
    x: f64,
    y: f64,
}

/// How the Laplacian is differenced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Second order, 3 × 3 cells: for the coarse grids, which need only point the right way.
    Second,
    /// Fourth order, 5 × 5 cells: for the answer.
    Fourth,
}

impl CellMetric {
    /// The metric at a cell, given its place in the order panel, j, i.
    pub fn new(grid: CubedSphere, cell: usize) -> Self {
        Self::at_place(grid, place_of(grid, cell))
    }

    /// The metric at a place of padded storage: the halo continues a panel's own coordinates.
    pub fn at_place(grid: CubedSphere, place: usize) -> Self {
        let width = grid.padded_width();
        let tangent = |k: usize| ((k as f64 - HALO as f64 + 0.5) * grid.cell_angle() - FRAC_PI_4).tan();
        Self { panel: place / (width * width), x: tangent(place % width), y: tangent(place / width % width) }
    }

    /// Solid angle of the cell over the square of the cell angle, by the metric at its center: `A B / δ³`.
    pub fn area_density(self) -> f64 {
        let [a, b] = [1.0 + self.x * self.x, 1.0 + self.y * self.y];
        let delta2 = a + self.y * self.y;
        a * b / (delta2 * delta2.sqrt())
    }

    /// Factors of ψ_αα, ψ_αβ and ψ_ββ in the Laplacian.
    pub fn laplacian_factors(self) -> [f64; 3] {
        let [a, b] = [1.0 + self.x * self.x, 1.0 + self.y * self.y];
        let delta2 = a + self.y * self.y;
        [delta2 / a, 2.0 * delta2 * self.x * self.y / (a * b), delta2 / b]
    }

    /// `n × ∇ψ` of a field with slopes ψ_α and ψ_β: a tangent vector. n × ∇α and n × ∇β are written out.
    fn turned_gradient(self, by_alpha: f64, by_beta: f64) -> DVec3 {
        let ([f, r, u], [x, y]) = (PANELS[self.panel], [self.x, self.y]);
        let alpha = u - y / (1.0 + x * x) * (f + x * r);
        let beta = x / (1.0 + y * y) * (f + y * u) - r;
        by_alpha * alpha + by_beta * beta
    }
}

/// The place of a cell in padded storage.
fn place_of(grid: CubedSphere, cell: usize) -> usize {
    let (panel, i, j) = grid.cell(cell);
    grid.padded_index(panel, i as isize, j as isize)
}

/// The values around a place of padded storage: `at(di, dj)` is the value of the cell di and dj steps away along i and j.
fn around(field: &PaddedField<f64>, place: usize) -> impl Fn(isize, isize) -> f64 + '_ {
    let width = field.grid().padded_width() as isize;
    move |di, dj| field.padded()[place.wrapping_add_signed(dj * width + di)]
}

/// `n × ∇ψ` at the center of a cell, fourth order: the velocity, in rad/s, if ψ is the stream function.
pub fn turned_gradient(psi: &PaddedField<f64>, cell: usize) -> DVec3 {
    let at = around(psi, place_of(psi.grid(), cell));
    let slope =
        |at: &dyn Fn(isize) -> f64| (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * psi.grid().cell_angle());
    CellMetric::new(psi.grid(), cell).turned_gradient(slope(&|k| at(k, 0)), slope(&|k| at(0, k)))
}

/// The Laplacian at the center of a cell, and the factor of the cell's own value in it, which is negative.
pub fn laplacian(psi: &PaddedField<f64>, cell: usize, order: Order) -> (f64, f64) {
    laplacian_at(psi, place_of(psi.grid(), cell), order)
}

/// [`laplacian`] at a place of padded storage, around which as many cells must be stored as the order reads.
pub fn laplacian_at(psi: &PaddedField<f64>, place: usize, order: Order) -> (f64, f64) {
    let at = around(psi, place);
    let [aa, ab, bb] = CellMetric::at_place(psi.grid(), place).laplacian_factors();
    let (by_aa, by_ab, by_bb, own) = match order {
        Order::Second => (
            at(1, 0) + at(-1, 0) - 2.0 * at(0, 0),
            0.25 * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)),
            at(0, 1) + at(0, -1) - 2.0 * at(0, 0),
            -2.0,
        ),
        Order::Fourth => {
            let second = |at: &dyn Fn(isize) -> f64| (16.0 * (at(1) + at(-1)) - (at(2) + at(-2)) - 30.0 * at(0)) / 12.0;
            let row = |j| 8.0 * (at(1, j) - at(-1, j)) - (at(2, j) - at(-2, j));
            let mixed = (8.0 * (row(1) - row(-1)) - (row(2) - row(-2))) / 144.0;
            (second(&|k| at(k, 0)), mixed, second(&|k| at(0, k)), -2.5)
        }
    };
    let cell_angle2 = psi.grid().cell_angle().powi(2);
    ((aa * by_aa + ab * by_ab + bb * by_bb) / cell_angle2, own * (aa + bb) / cell_angle2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::HaloTable;

    /// A harmonic polynomial of degree 5, order 4 about a tilted axis.
    fn harmonic(x: DVec3) -> f64 {
        let p = glam::DMat3::from_rotation_x(0.7) * x;
        (p.x.powi(4) - 6.0 * (p.x * p.y).powi(2) + p.y.powi(4)) * p.z
    }

    fn field(n: usize) -> PaddedField<f64> {
        let grid = CubedSphere::new(n).unwrap();
        PaddedField::sample_cells(grid, &HaloTable::new(grid), harmonic)
    }

    /// The largest errors of the Laplacian and of the turned gradient.
    fn errors(n: usize, order: Order) -> [f64; 2] {
        let field = field(n);
        (0..field.grid().cells()).fold([0.0; 2], |worst: [f64; 2], cell| {
            let x = field.grid().cell_direction(cell);
            let d = 1e-5;
            let slope = |e: DVec3| (harmonic((x + d * e).normalize()) - harmonic((x - d * e).normalize())) / (2.0 * d);
            let (e1, e2) = x.any_orthonormal_pair();
            let turned = slope(e1) * x.cross(e1) + slope(e2) * x.cross(e2);
            let laplacian = laplacian(&field, cell, order).0 + 30.0 * harmonic(x);
            [worst[0].max(laplacian.abs()), worst[1].max(turned_gradient(&field, cell).distance(turned))]
        })
    }

    #[test]
    fn operators_converge() {
        let [coarse, fine] = [32, 64].map(|n| errors(n, Order::Fourth));
        // Ideally 16, but halo cells err by O(D⁴), which in the outermost two rings the Laplacian divides by D² and the gradient by D;
        // the largest errors sit at corners, where halo stencils are one-sided by parts that differ from grid to grid.
        assert!(coarse[0] / fine[0] > 2.5 && fine[0] < 0.01, "{coarse:?} {fine:?}");
        assert!(coarse[1] / fine[1] > 5.0 && fine[1] < 1e-4, "{coarse:?} {fine:?}");
        let [coarse, fine] = [32, 64].map(|n| errors(n, Order::Second)[0]);
        assert!(coarse / fine > 3.5, "{coarse} {fine}");
    }

    #[test]
    fn the_metric_measures_cells() {
        let grid = CubedSphere::new(64).unwrap();
        let density = |cell| CellMetric::new(grid, cell).area_density() * grid.cell_angle().powi(2);
        let worst = grid.areas().into_iter().enumerate().map(|(cell, area)| (density(cell) / area - 1.0).abs());
        assert!(worst.fold(0.0, f64::max) < 2e-4, "midpoint rule, error O(D²)");
    }

    #[test]
    fn constants_have_no_laplacian_and_no_gradient() {
        let grid = CubedSphere::new(12).unwrap();
        let one = PaddedField::sample_cells(grid, &HaloTable::new(grid), |_| 1.0);
        for cell in 0..grid.cells() {
            assert!(turned_gradient(&one, cell).length() < 1e-13);
            // Rounding, magnified by 1/D² = 58.
            assert!([Order::Second, Order::Fourth].iter().all(|&order| laplacian(&one, cell, order).0.abs() < 1e-12));
        }
    }
}
