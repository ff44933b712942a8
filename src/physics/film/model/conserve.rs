//! The film's amount of liquid: the twin of `shaders/pass/conserve.wgsl` and `shaders/pass/balance_film.wgsl`.
//!
//! With A the film's solid angle, φ̄ the mean at the start, s what evaporation has spared in black film and q what has left at the rim, both means
//! over the film, a field φ has too much of
//!
//! ```text
//! E = ∫ (φ − φ̄) dA − (s − q) A                                                                       (M3)
//! ```
//!
//! which is taken from it, without bounds as `φ − E/A`, and within the film's bounds in proportion to the room that is left: with b the bound that
//! liquid is taken from above, or given to below,
//!
//! ```text
//! φ ← φ + p (b − φ),     p = |E| / (|φ̄ − b| A + |E|)                                                 (M4)
//! ```

use crate::physics::sphere::{Cap, CubedSphere, PaddedField};

/// What is known of a film's liquid. Values are departures from the film's level, nm.
#[derive(Clone, Debug)]
pub struct Liquid {
    /// Solid angles of film in all cells, sr.
    areas: Vec<f64>,
    /// That of the whole film, sr.
    film_area: f64,
    /// Mean at the start, nm.
    mean: f64,
    /// Least and largest value at the start, nm, which corrected values keep to until something drains; then they keep to nothing.
    bounds: Option<[f64; 2]>,
    /// What evaporation has spared in black film, s: a mean over the film, nm.
    pub spared_nm: f64,
    /// What has left at the rim, q: a mean over the film, nm.
    pub drained_nm: f64,
}

impl Liquid {
    /// The liquid of a field as it begins.
    #[must_use]
    pub fn of(field: &PaddedField<f64>, cap: Option<Cap>) -> Self {
        let areas = film_areas(field.grid(), cap);
        let film_area: f64 = areas.iter().sum();
        let integral: f64 = field.cells().iter().zip(&areas).map(|(value, area)| value * area).sum();
        let range = field.padded().iter().fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(*v), high.max(*v)]);
        Self { areas, film_area, mean: integral / film_area, bounds: Some(range), spared_nm: 0.0, drained_nm: 0.0 }
    }

    /// The mean over the film at the start, nm.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// From now on liquid may leave the film, and values their range.
    pub fn unbind(&mut self) {
        self.bounds = None;
    }

    /// What a field has more than at the start, nm sr.
    fn gained(&self, field: &PaddedField<f64>) -> f64 {
        field.cells().iter().zip(&self.areas).map(|(value, area)| area * (value - self.mean)).sum()
    }

    /// Makes the present amount the one to be conserved, because evaporation has spared some film.
    pub fn count_spared(&mut self, field: &PaddedField<f64>) {
        self.spared_nm = self.gained(field) / self.film_area + self.drained_nm;
    }

    /// Takes what a field lacks for what has left it at the rim.
    pub fn count_drained(&mut self, field: &PaddedField<f64>) {
        self.drained_nm = self.spared_nm - self.gained(field) / self.film_area;
    }

    /// A field with its liquid restored, (M3) and (M4).
    #[must_use]
    pub fn restored(&self, field: &PaddedField<f64>) -> PaddedField<f64> {
        let excess = self.gained(field) - (self.spared_nm - self.drained_nm) * self.film_area;
        let [offset, slope] =
            self.bounds.map_or([-excess / self.film_area, 0.0], |bounds| self.balance(excess, bounds));
        let values = field.padded().iter().map(|value| value + offset + slope * value);
        PaddedField::from_padded(field.grid(), values.collect())
    }

    /// What is added to a value, and how many times the value besides (M4).
    fn balance(&self, excess: f64, [low, high]: [f64; 2]) -> [f64; 2] {
        let bound = if excess > 0.0 { low } else { high };
        let room = (self.mean - bound).abs() * self.film_area + excess.abs();
        let part = if room > 0.0 { (excess.abs() / room).min(1.0) } else { 0.0 };
        [part * bound, -part]
    }
}

/// Solid angles of film in all cells, in the grid's order, sr.
#[must_use]
pub fn film_areas(grid: CubedSphere, cap: Option<Cap>) -> Vec<f64> {
    cap.map_or_else(|| grid.areas(), |cap| cap.areas(grid))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn field(value: impl Fn(DVec3) -> f64 + Sync) -> PaddedField<f64> {
        PaddedField::sample(CubedSphere::new(12).unwrap(), value)
    }

    #[test]
    fn liquid_is_restored_within_bounds_and_without() {
        let film = field(|x| x.z + 0.2 * x.x);
        for cap in [None, Some(Cap::HEMISPHERE), Some(Cap::above(1.1))] {
            let mut liquid = Liquid::of(&film, cap);
            let [low, high] = liquid.bounds.unwrap();
            for change in [-0.1, 0.05] {
                let spoilt = field(|x| (x.z + 0.2 * x.x + change * x.y.abs()).clamp(low, high));
                let restored = liquid.restored(&spoilt);
                assert!(liquid.gained(&restored).abs() < 1e-13, "{}", liquid.gained(&restored));
                assert!(restored.padded().iter().all(|value| (low - 1e-14..=high + 1e-14).contains(value)));
            }
            liquid.unbind();
            let shifted = liquid.restored(&field(|x| 7.0 + x.z + 0.2 * x.x));
            assert!(liquid.gained(&shifted).abs() < 1e-12);
        }
    }

    #[test]
    fn counted_losses_are_not_restored() {
        let film = field(|x| x.z);
        let mut liquid = Liquid::of(&film, None);
        liquid.unbind();
        liquid.count_drained(&field(|x| x.z - 0.25));
        assert!((liquid.drained_nm - 0.25).abs() < 1e-13);
        liquid.count_spared(&field(|x| x.z + 0.5));
        assert!(
            (liquid.spared_nm - 0.75).abs() < 1e-13,
            "half a nanometre more than there was, though a quarter has left"
        );
        let kept = liquid.restored(&film);
        assert!((liquid.gained(&kept) / liquid.film_area - 0.5).abs() < 1e-13);
    }
}
