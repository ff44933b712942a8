//! A photograph that stands behind the bubbles, fixed to the frame of the picture.

use crate::parallel;

use std::ops::Range;

/// A photograph, linear BT.709.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Width and height in pixels, at least 1.
    size: [usize; 2],
    /// Row by row from the top left.
    pixels: Vec<[f32; 3]>,
}

/// Pixels of a photograph that a pixel of a picture shows, and their weights, whose sum is 1.
struct Taps {
    first: usize,
    weights: Vec<f32>,
}

impl Plate {
    /// A photograph from its pixels, linear BT.709, row by row from the top left; none if they do not fill width and height.
    #[must_use]
    pub fn new(size: [usize; 2], pixels: Vec<[f32; 3]>) -> Option<Self> {
        (!pixels.is_empty() && size[0].checked_mul(size[1]) == Some(pixels.len())).then_some(Self { size, pixels })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Some columns and rows of a picture that the photograph fills: scaled until it covers the picture, its middle in the middle. Each pixel is
    /// the mean of what it shows, weighted by a tent as wide as two pixels of the photograph or of the picture, whichever is wider.
    #[must_use]
    pub fn fitted(&self, whole: [u32; 2], columns: &Range<u32>, rows: &Range<u32>) -> Vec<[f32; 3]> {
        let [width, height] = whole.map(f64::from);
        let scale = (width / self.size[0] as f64).max(height / self.size[1] as f64);
        let taps = |axis: usize, pixels: &Range<u32>| {
            let place = move |pixel: u32| {
                let from_middle = f64::from(pixel) + 0.5 - 0.5 * f64::from(whole[axis]);
                from_middle / scale + 0.5 * self.size[axis] as f64
            };
            pixels.clone().map(|pixel| Taps::around(place(pixel), scale, self.size[axis])).collect::<Vec<_>>()
        };
        let (across, down) = (taps(0, columns), taps(1, rows));
        let row = |taps: &Taps| {
            let line = |column: usize| taps.mean(|row| self.pixels[row * self.size[0] + column]);
            let used = across.first().map_or(0, |taps| taps.first)..across.last().map_or(0, Taps::end);
            let mixed: Vec<[f32; 3]> = used.clone().map(line).collect();
            across.iter().map(|taps| taps.mean(|column| mixed[column - used.start])).collect::<Vec<_>>()
        };
        parallel::map(down.len(), |k| row(&down[k])).concat()
    }
}

impl Taps {
    /// Around a place in pixels of the photograph, of which one is `scale` pixels of the picture.
    fn around(place: f64, scale: f64, count: usize) -> Self {
        let reach = (1.0 / scale).max(1.0);
        let last = count as f64 - 1.0;
        let [first, end] =
            [(place - 0.5 - reach).ceil(), (place - 0.5 + reach).floor()].map(|x| x.clamp(0.0, last) as usize);
        let weight = |pixel: usize| (1.0 - (pixel as f64 + 0.5 - place).abs() / reach).max(0.0);
        let weights: Vec<f64> = (first..=end).map(weight).collect();
        let sum: f64 = weights.iter().sum();
        if sum <= 0.0 {
            // Beyond the outermost pixel's middle.
            return Self { first, weights: vec![1.0] };
        }
        Self { first, weights: weights.into_iter().map(|weight| (weight / sum) as f32).collect() }
    }

    fn end(&self) -> usize {
        self.first + self.weights.len()
    }

    fn mean(&self, pixel: impl Fn(usize) -> [f32; 3]) -> [f32; 3] {
        let add =
            |sum: [f32; 3], (pixel, weight): ([f32; 3], &f32)| std::array::from_fn(|k| sum[k] + weight * pixel[k]);
        (self.first..).map(pixel).zip(&self.weights).fold([0.0; 3], add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp from left to right in red, from top to bottom in green.
    fn ramp(width: usize, height: usize) -> Plate {
        let pixel = |k: usize| [(k % width) as f32 + 0.5, (k / width) as f32 + 0.5, 1.0];
        Plate::new([width, height], (0..width * height).map(pixel).collect()).unwrap()
    }

    #[test]
    fn a_photograph_of_the_same_size_stays_as_it_is() {
        let plate = ramp(7, 5);
        assert_eq!(plate.fitted([7, 5], &(0..7), &(0..5)), plate.pixels);
    }

    #[test]
    fn the_middle_is_kept_and_the_rest_is_cropped() {
        // Twice as large, and 2 of its 8 columns on each side are cropped.
        let fitted = ramp(8, 4).fitted([8, 8], &(0..8), &(0..8));
        let at = |x: usize, y: usize| fitted[y * 8 + x];
        for (x, y) in [(3, 3), (2, 5), (5, 2)] {
            let expected = [2.0 + 0.5 * (x as f32 + 0.5), 0.5 * (y as f32 + 0.5), 1.0];
            assert!(at(x, y).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{x},{y}: {:?}", at(x, y));
        }
        // Each pixel is the same however the picture is cut.
        let part = ramp(8, 4).fitted([8, 8], &(2..5), &(4..8));
        assert!((4..8).all(|y| (2..5).all(|x| part[(y - 4) * 3 + x - 2] == at(x, y))));
    }

    #[test]
    fn a_larger_photograph_is_averaged() {
        let fitted = ramp(40, 40).fitted([4, 4], &(0..4), &(0..4));
        // A tent around the middle of a ramp has the ramp's value there.
        assert!((fitted[5][0] - 15.0).abs() < 1e-3 && (fitted[5][1] - 15.0).abs() < 1e-3, "{:?}", fitted[5]);
        assert!(fitted.iter().all(|pixel| (pixel[2] - 1.0).abs() < 1e-5));
    }
}
