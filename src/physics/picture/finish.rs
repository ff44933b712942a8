//! What a lens and a film do to the linear picture before it is shown: glare, vignetting, grain. See `shaders/pass/finish.wgsl`.
//!
//! Glare is a part of the light that the lens scatters. Its point-spread function is a sum of bells, each twice as wide as the last: the picture
//! is halved again and again, and the halves are added up from the smallest on, each with its share. Both filters keep the light's sum.

use glam::{DVec2, DVec3};

use crate::{
    parallel,
    physics::colour::{hash, uniform},
};

/// Widths of glare: bells of an eighth of the picture's height, and so on down to a 256th.
const WIDTHS: u32 = 6;
/// Luminance of linear BT.2020 (ITU-R BT.2020).
const LUMINANCE: DVec3 = DVec3::new(0.2627, 0.678, 0.0593);

/// What a lens and a film do to the picture before it is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Finish {
    /// Part of light that the lens scatters.
    pub glare: f64,
    /// Stops that the corners lose.
    pub vignetting_ev: f64,
    /// Relative grain of a radiance that is exposed as 1.
    pub grain: f64,
    /// Seed of the grain; 0 without grain.
    pub grain_seed: u32,
}

/// A linear picture: its width and height, and its pixels row by row.
struct Level {
    size: [usize; 2],
    pixels: Vec<DVec3>,
}

impl Finish {
    /// Part of light that goes to each level of glare, the first half as large as the picture. Each bell takes 1.4 times the light of the next
    /// wider one, so the point-spread function falls about as the power −2.5 of the distance, as those of lenses do, of −2 to −3 (McCann and
    /// Rizzi, The Art and Science of HDR Imaging, 2012). Bells narrower than two pixels stay with the sharp picture.
    #[must_use]
    pub fn shares(&self, [width, height]: [u32; 2]) -> Vec<f64> {
        if self.glare == 0.0 {
            return Vec::new();
        }
        let levels = f64::from(width.min(height).max(1)).log2().round() as usize;
        let of_width = |width: u32| 0.5f64.sqrt().powi(WIDTHS as i32 - 1 - width as i32);
        let total: f64 = (0..WIDTHS).map(of_width).sum();
        // Width 0 is an eighth of the height: level log2(height) − 3.
        let share = |level: usize| match levels.saturating_sub(3).checked_sub(level) {
            Some(width) if (width as u32) < WIDTHS => self.glare * of_width(width as u32) / total,
            _ => 0.0,
        };
        (1..=levels.saturating_sub(3)).map(share).collect()
    }

    /// The finished picture of one in linear BT.2020, row by row from the top left. `exposure` is the factor that exposes it.
    #[must_use]
    pub fn applied(&self, size: [u32; 2], exposure: f64, pixels: Vec<DVec3>) -> Vec<DVec3> {
        if *self == Self::default() {
            return pixels;
        }
        let shares = self.shares(size);
        let sharp = Level { size: size.map(|pixels| pixels as usize), pixels };
        let glare = glare(&sharp, &shares);
        let kept = 1.0 - shares.iter().sum::<f64>();
        let middle = 0.5 * DVec2::new(size[0].into(), size[1].into());
        sharp.mapped(sharp.size, |at, pixel| {
            let lit = kept * sharp.at(pixel) + glare.as_ref().map_or(DVec3::ZERO, |glare| glare.doubled(at));
            let out = (at - middle).length_squared() / middle.length_squared();
            let passed = (-self.vignetting_ev * out).exp2() * lit;
            let exposed = (exposure * LUMINANCE.dot(passed)).max(1e-3);
            let noise = if self.grain > 0.0 { normal_noise(pixel, self.grain_seed) } else { 0.0 };
            (1.0 + self.grain * noise / exposed.sqrt()).max(0.0) * passed
        })
    }
}

/// The sum of all levels, each with its share, at half the size of the picture; none without levels.
fn glare(sharp: &Level, shares: &[f64]) -> Option<Level> {
    let mut halves: Vec<Level> = Vec::new();
    for _ in shares {
        halves.push(halves.last().unwrap_or(sharp).halved());
    }
    halves.into_iter().zip(shares).rev().fold(None, |coarser: Option<Level>, (half, share)| {
        let sum = half.mapped(half.size, |at, pixel| {
            share * half.at(pixel) + coarser.as_ref().map_or(DVec3::ZERO, |coarser| coarser.doubled(at))
        });
        Some(Level { size: half.size, pixels: sum })
    })
}

impl Level {
    /// A pixel; beyond the edge, the nearest.
    fn at(&self, [column, row]: [i64; 2]) -> DVec3 {
        let [column, row] =
            [(column, self.size[0]), (row, self.size[1])].map(|(k, n)| k.clamp(0, n as i64 - 1) as usize);
        self.pixels[row * self.size[0] + column]
    }

    /// Pixels of another picture, from the middle and the column and row of each.
    fn mapped(&self, size: [usize; 2], pixel: impl Fn(DVec2, [i64; 2]) -> DVec3 + Sync) -> Vec<DVec3> {
        parallel::map(size[0] * size[1], |k| {
            let place = [k % size[0], k / size[0]];
            pixel(DVec2::from(place.map(|k| k as f64 + 0.5)), place.map(|k| k as i64))
        })
    }

    /// The picture at half its size: weights 1, 3, 3, 1 along each axis.
    fn halved(&self) -> Self {
        const WEIGHTS: [f64; 4] = [0.125, 0.375, 0.375, 0.125];
        let size = self.size.map(|pixels| pixels.div_ceil(2));
        let mean = |_, [column, row]: [i64; 2]| {
            let taps = (0..16).map(|k| (k % 4, k / 4));
            let tap = |(x, y): (usize, usize)| {
                WEIGHTS[x] * WEIGHTS[y] * self.at([2 * column - 1 + x as i64, 2 * row - 1 + y as i64])
            };
            taps.map(tap).sum()
        };
        Self { size, pixels: self.mapped(size, mean) }
    }

    /// The picture at twice its size, interpolated.
    fn doubled(&self, position: DVec2) -> DVec3 {
        let place = 0.5 * position - 0.5;
        let (corner, weight) = (place.floor(), place.fract_gl());
        let [x, y] = [corner.x as i64, corner.y as i64];
        let row = |y: i64| self.at([x, y]).lerp(self.at([x + 1, y]), weight.x);
        row(y).lerp(row(y + 1), weight.y)
    }
}

/// About normal, of variance 1.
fn normal_noise([column, row]: [i64; 2], seed: u32) -> f64 {
    let first = hash((column as u32).wrapping_add(hash((row as u32).wrapping_add(hash(seed)))));
    let bits = std::iter::successors(Some(first), |bits| Some(hash(*bits)));
    12f64.sqrt() / 2.0 * bits.take(4).map(|bits| uniform(bits) - 0.5).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glare_has_the_same_widths_in_pictures_of_all_sizes() {
        let finish = Finish { glare: 1.0, ..Finish::default() };
        let (small, large) = (finish.shares([256, 512]), finish.shares([4096, 2048]));
        assert_eq!((small.len(), large.len()), (5, 8));
        // From the widest on; the narrowest of the small picture is less than two pixels wide.
        let widest = |shares: &[f64]| shares.iter().rev().copied().take(5).collect::<Vec<_>>();
        assert_eq!(widest(&small), widest(&large));
        assert!((large.iter().sum::<f64>() - 1.0).abs() < 1e-12 && small.iter().sum::<f64>() < 1.0);
        assert!(finish.shares([4, 4]).is_empty());
    }

    #[test]
    fn glare_of_a_point_keeps_its_light_and_falls_with_distance() {
        let size = [129, 129];
        let mut pixels = vec![DVec3::ZERO; 129 * 129];
        pixels[64 * 129 + 64] = DVec3::new(1.0, 2.0, 3.0);
        let finish = Finish { glare: 0.3, ..Finish::default() };
        let seen = finish.applied(size, 1.0, pixels);
        let sum: DVec3 = seen.iter().sum();
        assert!((sum / DVec3::new(1.0, 2.0, 3.0) - 1.0).abs().max_element() < 0.01, "{sum}");
        let along = [1, 4, 8, 16, 24].map(|right| seen[64 * 129 + 64 + right].x);
        assert!(along.is_sorted_by(|a, b| a > b) && along[4] > 0.0, "{along:?}");
    }

    #[test]
    fn even_light_has_no_glare_and_darker_corners() {
        let size = [40, 30];
        let even = vec![DVec3::splat(0.25); 1200];
        let glare = Finish { glare: 0.5, ..Finish::default() }.applied(size, 1.0, even.clone());
        assert!(glare.iter().all(|pixel| (*pixel - 0.25).abs().max_element() < 1e-12));
        let corner =
            Finish { vignetting_ev: 1.0, ..Finish::default() }.applied([401, 301], 1.0, vec![DVec3::ONE; 401 * 301]);
        assert!((corner[0].x - 0.5).abs() < 0.01 && (corner[150 * 401 + 200].x - 1.0).abs() < 1e-4);
    }
}
