//! Fields in padded storage, and their interpolation at any direction without looking at panel edges.

use std::ops::{Add, Mul};

use glam::DVec3;

use crate::parallel;

use super::{CubedSphere, HaloEntry, HaloTable, cubic_weights, quintic_weights};

/// What a field may hold: values that can be weighted and added, `f64` and [`DVec3`] among them. The default is zero.
pub trait FieldValue: Copy + Default + Send + Sync + Add<Output = Self> + Mul<f64, Output = Self> {}

impl<T: Copy + Default + Send + Sync + Add<Output = T> + Mul<f64, Output = T>> FieldValue for T {}

/// Point values on a cubed sphere with filled halos.
#[derive(Clone, Debug, PartialEq)]
pub struct PaddedField<T> {
    grid: CubedSphere,
    values: Vec<T>,
}

impl<T: FieldValue> PaddedField<T> {
    /// The field whose value in each cell, numbered in the order panel, j, i, is `value(cell)`. `halo` is the grid's table.
    pub fn from_cells(grid: CubedSphere, halo: &HaloTable, value: impl Fn(usize) -> T + Sync) -> Self {
        let inner = parallel::map(grid.cells(), value);
        let mut values = vec![T::default(); grid.padded_len()];
        for (row, cells) in inner.chunks_exact(grid.n()).enumerate() {
            let start = grid.padded_index(row / grid.n(), 0, (row % grid.n()) as isize);
            values[start..start + grid.n()].copy_from_slice(cells);
        }
        let mut field = Self { grid, values };
        field.fill(halo, |entry, source| weighted(weights(entry).zip(source)));
        field
    }

    /// The field that samples a function of direction at the cell centers, halo included: they are places on the sphere like
    /// any other.
    pub fn sample(grid: CubedSphere, value: impl Fn(DVec3) -> T + Sync) -> Self {
        let direction = grid.padded_directions();
        Self { grid, values: parallel::map(grid.padded_len(), |index| value(direction(index))) }
    }

    /// The field that samples a function of direction at the cells alone, with its halo interpolated from them: what fields are like that only
    /// their cells are computed of. `halo` is the grid's table.
    pub fn sample_cells(grid: CubedSphere, halo: &HaloTable, value: impl Fn(DVec3) -> T + Sync) -> Self {
        Self::from_cells(grid, halo, |cell| value(grid.cell_direction(cell)))
    }

    /// The field of these values by padded index, one for each of [`CubedSphere::padded_len`]; missing ones are zero.
    pub fn from_padded(grid: CubedSphere, mut values: Vec<T>) -> Self {
        values.resize(grid.padded_len(), T::default());
        Self { grid, values }
    }

    /// The field whose value at each place of padded storage that is at least `margin` cells from a panel's outer edge is `value(place)`;
    /// elsewhere it is zero. A function that reads this many cells around a place stays within storage.
    pub fn from_places(grid: CubedSphere, margin: usize, value: impl Fn(usize) -> T + Sync) -> Self {
        let width = grid.padded_width();
        let inside = |k: usize| (margin..width - margin).contains(&k);
        let at = |place: usize| {
            let stored = inside(place % width) && inside(place / width % width);
            if stored { value(place) } else { T::default() }
        };
        Self { grid, values: parallel::map(grid.padded_len(), at) }
    }

    /// The grid.
    pub fn grid(&self) -> CubedSphere {
        self.grid
    }

    /// All values by padded index.
    pub fn padded(&self) -> &[T] {
        &self.values
    }

    /// The values of the cells in the order panel, j, i.
    pub fn cells(&self) -> Vec<T> {
        let cell = |index| {
            let (panel, i, j) = self.grid.cell(index);
            self.values[self.grid.padded_index(panel, i as isize, j as isize)]
        };
        (0..self.grid.cells()).map(cell).collect()
    }

    /// Cubic interpolation in both coordinates, 4×4 Lagrange: exact at cell centers, error O(D⁴).
    pub fn bicubic(&self, direction: DVec3) -> T {
        self.interpolate(direction, -1, cubic_weights)
    }

    /// Quintic interpolation in both coordinates, 6×6 Lagrange: exact at cell centers, error O(D⁶).
    pub fn biquintic(&self, direction: DVec3) -> T {
        self.interpolate(direction, -2, quintic_weights)
    }

    /// Linear interpolation in both coordinates: exact at cell centers, error O(D²), never leaves the range of the values.
    pub fn bilinear(&self, direction: DVec3) -> T {
        self.interpolate(direction, 0, |t| [1.0 - t, t])
    }

    /// A product stencil of S × S values that starts `first` cells from the one below the point.
    fn interpolate<const S: usize>(&self, direction: DVec3, first: isize, weights: impl Fn(f64) -> [f64; S]) -> T {
        let place = self.grid.locate(direction);
        let [x, y] = [place.x.floor(), place.y.floor()];
        let [across, up] = [weights(place.x - x), weights(place.y - y)];
        let corner = self.grid.padded_index(place.panel, x as isize + first, y as isize + first);
        let row = |j: usize| {
            let start = corner + j * self.grid.padded_width();
            weighted(across.into_iter().zip(self.values[start..start + S].iter().copied()))
        };
        weighted(up.into_iter().enumerate().map(|(j, weight)| (weight, row(j))))
    }

    /// Gives each halo cell its value, made of an entry of the table and the four values that it reads.
    fn fill(&mut self, halo: &HaloTable, value: impl Fn(&HaloEntry, [T; 4]) -> T) {
        for entry in halo.edges.iter().chain(&halo.corners) {
            let source = |k| self.values[entry.source(k) as usize];
            self.values[entry.cell as usize] = value(entry, [source(0), source(1), source(2), source(3)]);
        }
    }
}

impl PaddedField<f64> {
    /// The same cells, with a halo in which no value leaves the range of the four that it is interpolated from: a thickness must stay
    /// positive. `halo` is the grid's table.
    #[must_use]
    pub fn with_bounded_halo(mut self, halo: &HaloTable) -> Self {
        self.fill(halo, |entry, source| {
            let [low, high] = range(source);
            weighted(weights(entry).zip(source)).clamp(low, high)
        });
        self
    }

    /// [`Self::bicubic`], within the range of the four cells around.
    pub fn bicubic_limited(&self, direction: DVec3) -> f64 {
        self.limited(direction, self.bicubic(direction))
    }

    /// [`Self::biquintic`], within the range of the four cells around.
    pub fn biquintic_limited(&self, direction: DVec3) -> f64 {
        self.limited(direction, self.biquintic(direction))
    }

    /// The nearest number to `value` within the range of the four cells around a direction.
    fn limited(&self, direction: DVec3, value: f64) -> f64 {
        let place = self.grid.locate(direction);
        let first = self.grid.padded_index(place.panel, place.x.floor() as isize, place.y.floor() as isize);
        let above = first + self.grid.padded_width();
        let cells = &self.values;
        let [low, high] = range([cells[first], cells[first + 1], cells[above], cells[above + 1]]);
        value.clamp(low, high)
    }
}

/// The smallest and the largest of four values.
fn range([a, b, c, d]: [f64; 4]) -> [f64; 2] {
    [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
}

/// The weights of an entry.
fn weights(entry: &HaloEntry) -> impl Iterator<Item = f64> {
    entry.weights.map(f64::from).into_iter()
}

/// The weighted sum of values.
fn weighted<T: FieldValue>(terms: impl Iterator<Item = (f64, T)>) -> T {
    terms.fold(T::default(), |sum, (weight, value)| sum + value * weight)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn smooth(x: DVec3) -> f64 {
        (2.0 * x.x - x.y).sin() + x.z * x.y
    }

    fn field(n: usize) -> PaddedField<f64> {
        PaddedField::sample(CubedSphere::new(n).unwrap(), smooth)
    }

    /// The same with its halo interpolated from the cells.
    fn filled(n: usize) -> PaddedField<f64> {
        let grid = CubedSphere::new(n).unwrap();
        PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| smooth(grid.cell_direction(cell)))
    }

    /// The largest error over the halo cells.
    fn halo_error(n: usize) -> f64 {
        let (filled, exact) = (filled(n), field(n));
        filled.values.iter().zip(&exact.values).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()))
    }

    /// The largest interpolation error over directions that include edges and corners.
    fn lookup_error(n: usize, lookup: fn(&PaddedField<f64>, DVec3) -> f64) -> f64 {
        let field = filled(n);
        let probe = CubedSphere::new(37).unwrap();
        let corners = [1.0, -1.0].map(|s| DVec3::new(1.0, s, -1.0).normalize());
        let near_corners = corners.map(|c| (c + DVec3::new(1e-3, 0.0, 2e-3)).normalize());
        let directions = (0..probe.cells()).map(|cell| probe.cell_direction(cell)).chain(corners).chain(near_corners);
        directions.fold(0.0, |worst: f64, x| worst.max((lookup(&field, x) - smooth(x)).abs()))
    }

    #[test]
    fn halos_and_bicubic_lookup_converge_at_fourth_order() {
        for error in [halo_error, |n| lookup_error(n, PaddedField::bicubic)] {
            let (coarse, fine) = (error(20), error(40));
            assert!(fine < 1e-5, "{fine:e}");
            assert!(coarse / fine > 12.0, "ideal 16, less the mixture of positions: {coarse:e} / {fine:e}");
        }
    }

    #[test]
    fn biquintic_lookup_converges_at_sixth_order() {
        let error = |n| {
            let (field, probe) = (field(n), CubedSphere::new(37).unwrap());
            (0..probe.cells())
                .map(|cell| probe.cell_direction(cell))
                .fold(0.0, |worst: f64, x| worst.max((field.biquintic(x) - smooth(x)).abs()))
        };
        let (coarse, fine) = (error(20), error(40));
        assert!(fine < 1e-7 && coarse / fine > 45.0, "ideal 64: {coarse:e} / {fine:e}");
    }

    #[test]
    fn bilinear_lookup_converges_at_second_order() {
        let (coarse, fine) = (lookup_error(20, PaddedField::bilinear), lookup_error(40, PaddedField::bilinear));
        assert!(coarse / fine > 3.2, "ideal 4: {coarse:e} / {fine:e}");
    }

    #[test]
    fn limited_lookups_and_bounded_halos_make_no_new_extreme() {
        let grid = CubedSphere::new(9).unwrap();
        let halo = HaloTable::new(grid);
        let step = |cell: usize| f64::from(u8::from(grid.cell_direction(cell).dot(DVec3::new(0.5, 0.3, 0.7)) > 0.2));
        let free = PaddedField::from_cells(grid, &halo, step);
        let bounded = free.clone().with_bounded_halo(&halo);
        assert_eq!(free.cells(), bounded.cells());
        let stays = |values: &[f64]| values.iter().all(|value| (0.0..=1.0).contains(value));
        assert!(!stays(free.padded()) && stays(bounded.padded()));
        let probe = CubedSphere::new(31).unwrap();
        let looked_up = |lookup: fn(&PaddedField<f64>, DVec3) -> f64| -> Vec<f64> {
            (0..probe.cells()).map(|cell| lookup(&bounded, probe.cell_direction(cell))).collect()
        };
        assert!(!stays(&looked_up(PaddedField::bicubic)) && !stays(&looked_up(PaddedField::biquintic)));
        assert!(stays(&looked_up(PaddedField::bicubic_limited)) && stays(&looked_up(PaddedField::biquintic_limited)));
    }

    #[test]
    fn cells_come_back_in_order_and_lookup_is_exact_at_centers() {
        for n in [8, 11] {
            let field = field(n);
            for (index, value) in field.cells().into_iter().enumerate() {
                let x = field.grid().cell_direction(index);
                assert_eq!(value, smooth(x));
                assert!((field.bicubic(x) - value).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn constants_and_vectors_survive() {
        let grid = CubedSphere::new(15).unwrap();
        let halo = HaloTable::new(grid);
        let constant = PaddedField::from_cells(grid, &halo, |_| 0.7);
        assert!(constant.padded().iter().all(|v| (v - 0.7).abs() < 1e-15));
        let identity = PaddedField::from_cells(grid, &halo, |cell| grid.cell_direction(cell));
        let x = DVec3::new(0.99, 1.0, 0.98).normalize();
        assert!(identity.bicubic(x).distance(x) < 1e-4);
    }

    /// Any values in the cells of a grid.
    fn rough(n: std::ops::Range<usize>) -> impl Strategy<Value = PaddedField<f64>> {
        let values = n.prop_flat_map(|n| (Just(n), prop::collection::vec(-1.0..1.0, 6 * n * n)));
        values.prop_map(|(n, values)| {
            let grid = CubedSphere::new(n).unwrap();
            let halo = HaloTable::new(grid);
            PaddedField::from_cells(grid, &halo, |cell| values[cell]).with_bounded_halo(&halo)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn limited_lookups_stay_within_the_field(field in rough(8..14), x in prop::array::uniform3(-1.0..1.0)) {
            let x = DVec3::from(x);
            prop_assume!(x.length() > 1e-3);
            let cells = field.cells();
            let [low, high] = [cells.iter().fold(1.0, |a: f64, b| a.min(*b)), cells.iter().fold(-1.0, |a: f64, b| a.max(*b))];
            for value in [field.bilinear(x), field.bicubic_limited(x), field.biquintic_limited(x)] {
                prop_assert!((low..=high).contains(&value), "{} outside {} to {}", value, low, high);
            }
        }

        #[test]
        fn lookups_are_linear_in_the_field(
            field in rough(8..11), x in prop::array::uniform3(-1.0..1.0), factor in -10.0..10.0_f64
        ) {
            let x = DVec3::from(x);
            prop_assume!(x.length() > 1e-3);
            let values = field.padded().iter().map(|value| factor * value).collect();
            let scaled: PaddedField<f64> = PaddedField::from_padded(field.grid(), values);
            let lookups: [fn(&PaddedField<f64>, DVec3) -> f64; 3] =
                [PaddedField::bilinear, PaddedField::bicubic, PaddedField::biquintic];
            for lookup in lookups {
                let difference: f64 = lookup(&scaled, x) - factor * lookup(&field, x);
                prop_assert!(difference.abs() < 1e-12);
            }
        }
    }
}
