//! Cheap irregularity: a tile of fractal noise, and curves that are looked up instead of computed.

use glam::DVec2;

/// Noise that repeats after 1 in both directions: mean 0, standard deviation 1, detail from an eighth down to a 128th.
pub(super) struct Tile {
    texels: Box<[f32; TILE_SIZE * TILE_SIZE]>,
}

/// Texels along the edge of a tile; a power of 2.
const TILE_SIZE: usize = 256;

/// Cells along the edge of the coarsest and the finest octave; each octave has 0.6 of the last one's height.
const COARSEST: usize = 8;
const FINEST: usize = 128;
const PERSISTENCE: f64 = 0.6;

impl Tile {
    /// The tile of a seed.
    pub fn new(seed: u64) -> Self {
        let mut texels = vec![0.0; TILE_SIZE * TILE_SIZE];
        let octaves = std::iter::successors(Some(COARSEST), |&cells| (cells < FINEST).then_some(2 * cells));
        for (octave, cells) in octaves.enumerate() {
            add_octave(&mut texels, cells, PERSISTENCE.powi(octave as i32), seed + octave as u64);
        }
        let count = texels.len() as f64;
        let mean = texels.iter().sum::<f64>() / count;
        let variance = texels.iter().map(|texel| (texel - mean).powi(2)).sum::<f64>() / count;
        let mut normal = Box::new([0.0; TILE_SIZE * TILE_SIZE]);
        normal.iter_mut().zip(&texels).for_each(|(normal, texel)| *normal = ((texel - mean) / variance.sqrt()) as f32);
        Self { texels: normal }
    }

    /// The noise at a place, interpolated linearly.
    pub fn at(&self, place: DVec2) -> f64 {
        let texel = place * TILE_SIZE as f64;
        let (column, across) = split(texel.x);
        let (row, down) = split(texel.y);
        let tap =
            |column: usize, row: usize| f64::from(self.texels[(row % TILE_SIZE) * TILE_SIZE + column % TILE_SIZE]);
        let along = |row| mix(tap(column, row), tap(column.wrapping_add(1), row), across);
        mix(along(row), along(row.wrapping_add(1)), down)
    }
}

/// Adds smooth noise of `cells` cells along each edge.
fn add_octave(texels: &mut [f64], cells: usize, height: f64, seed: u64) {
    let value = |column: usize, row: usize| random((column % cells + cells * (row % cells)) as u64, seed);
    let cell = TILE_SIZE / cells;
    for (index, texel) in texels.iter_mut().enumerate() {
        let (column, row) = (index % TILE_SIZE, index / TILE_SIZE);
        let smooth = |position: usize| {
            let t = (position % cell) as f64 / cell as f64;
            t * t * (3.0 - 2.0 * t)
        };
        let (left, top) = (column / cell, row / cell);
        let along = |row| mix(value(left, row), value(left + 1, row), smooth(column));
        *texel += height * mix(along(top), along(top + 1), smooth(row));
    }
}

/// A number between 0 and 1 that looks random: the finaliser of SplitMix64.
pub(super) fn random(index: u64, seed: u64) -> f64 {
    let mut bits = index.wrapping_add(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// The whole part of a number, wrapped for use as an index, and the rest, 0 to 1; a whole number may count as the one before it and 1.
pub(super) fn split(number: f64) -> (usize, f64) {
    // Beside this number floats are whole, and the last bits of their mantissa count: faster than rounding without SSE 4.1.
    const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
    let shifted = number - 0.5 + WHOLE;
    (shifted.to_bits() as u32 as usize, number - (shifted - WHOLE))
}

pub(super) fn mix(from: f64, to: f64, share: f64) -> f64 {
    from + share * (to - from)
}

/// Several functions of one number between 0 and 1, kept at evenly spaced places.
pub(super) struct Curve<const N: usize> {
    places: Vec<[f64; N]>,
}

impl<const N: usize> Curve<N> {
    /// Keeps `function` at `count` + 1 places, the first at 0, the last at 1.
    pub fn new(count: usize, function: impl Fn(f64) -> [f64; N]) -> Self {
        Self { places: (0..=count).map(|place| function(place as f64 / count as f64)).collect() }
    }

    /// The functions at `number`, interpolated linearly; before 0 and beyond 1 they stay as they are there.
    pub fn at(&self, number: f64) -> [f64; N] {
        let last = self.places.len() - 1;
        let place = (number * last as f64).clamp(0.0, last as f64);
        let first = (place as usize).min(last - 1);
        let share = place - first as f64;
        std::array::from_fn(|function| mix(self.places[first][function], self.places[first + 1][function], share))
    }
}

/// Azimuth of a level direction in turns, 0 to 1, from +x towards +y; within 1e-5 of the truth in radians.
pub(super) fn turns(level: DVec2) -> f64 {
    let size = level.abs();
    let tangent = size.min_element() / size.max_element().max(1e-300);
    let square = tangent * tangent;
    // Abramowitz and Stegun 4.4.47.
    let series =
        0.999_866_0 + square * (-0.330_299_5 + square * (0.180_141_0 + square * (-0.085_133_0 + square * 0.020_835_1)));
    let eighth = tangent * series / std::f64::consts::TAU;
    let quarter = if size.y > size.x { 0.25 - eighth } else { eighth };
    let half = if level.x < 0.0 { 0.5 - quarter } else { quarter };
    if level.y < 0.0 { 1.0 - half } else { half }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_normal_repeat_and_have_no_steps() {
        let tile = Tile::new(3);
        let places = || (0..2000).map(|i| DVec2::new(random(i, 1), random(i, 2)));
        let mean = places().map(|place| tile.at(place)).sum::<f64>() / 2000.0;
        let variance = places().map(|place| tile.at(place).powi(2)).sum::<f64>() / 2000.0;
        // Noise of some hundred independent cells.
        assert!(mean.abs() < 0.15 && (variance - 1.0).abs() < 0.2, "{mean}, {variance}");
        for place in places() {
            let there = tile.at(place);
            assert!((tile.at(place + DVec2::new(-3.0, 2.0)) - there).abs() < 1e-9);
            assert!((tile.at(place + 1e-6) - there).abs() < 1e-3);
        }
        assert_ne!(Tile::new(4).texels, tile.texels);
        assert_eq!(Tile::new(3).texels, tile.texels);
    }

    #[test]
    fn curves_keep_their_ends() {
        let curve = Curve::new(10, |number| [number, 1.0 - number * number]);
        assert_eq!(curve.at(0.0), [0.0, 1.0]);
        assert_eq!(curve.at(1.0), [1.0, 0.0]);
        assert_eq!((curve.at(-3.0), curve.at(5.0)), (curve.at(0.0), curve.at(1.0)));
        // A parabola's chord over a tenth lies at most 1/400 below it.
        assert!((curve.at(0.55)[1] - (1.0 - 0.55 * 0.55)).abs() <= 1.0 / 400.0 + 1e-12);
    }

    #[test]
    fn turns_are_azimuths() {
        for degree in 0..360 {
            let angle = f64::from(degree).to_radians();
            let found = turns(3.0 * DVec2::from_angle(angle)) * std::f64::consts::TAU;
            assert!((found - angle).abs() < 1.5e-5, "{degree}: {found}");
        }
        assert_eq!(turns(DVec2::ZERO), 0.0);
    }

    #[test]
    fn splitting_rounds_down() {
        assert_eq!(split(2.25), (2, 0.25));
        assert_eq!(split(-0.25), (u32::MAX as usize, 0.75));
        for whole in [-3.0, 0.0, 1.0, 2.0] {
            let (index, rest) = split(whole);
            assert_eq!(f64::from(index as u32 as i32) + rest, whole);
        }
    }
}
