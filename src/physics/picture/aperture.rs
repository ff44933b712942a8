//! Where light passes through a lens, and when: evenly spread places in an aperture and in a pixel.

use std::f64::consts::{GOLDEN_RATIO, TAU};

use glam::DVec2;

/// Blades that make a polygon; with fewer, an aperture is round.
const FEWEST_BLADES: u32 = 3;

/// The place in an aperture of radius 1, about its middle, that two numbers of [0, 1) stand for: evenly spread numbers give evenly spread places. A
/// polygon of blades stands on a corner, at radius 1 like all others.
#[must_use]
pub fn aperture_place(blades: u32, [u, v]: [f64; 2]) -> DVec2 {
    let corner = |angle: f64| DVec2::new(angle.sin(), -angle.cos());
    if blades < FEWEST_BLADES {
        return u.sqrt() * corner(TAU * v);
    }
    // In one of the triangles from the middle to a side.
    let side = (v * f64::from(blades)).floor();
    let along = v * f64::from(blades) - side;
    let [from, to] = [side, side + 1.0].map(|blade| corner(TAU * blade / f64::from(blades)));
    u.sqrt() * from.lerp(to, along)
}

/// The k-th of `count` evenly spread points of [0, 1)⁴: two numbers for [`aperture_place`], and two for a place in a pixel.
///
/// Places in the aperture are those of a sunflower's seeds (H. Vogel, "A better way to construct the sunflower head", 1979), which leave no gaps
/// whatever their number. They are taken in an order in which each few in a row lie all over the aperture, for samples follow one another in time.
/// Places in the pixel are an additive recurrence with the powers of the root of x³ = x + 1 (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018).
#[must_use]
pub fn spread(k: u32, count: u32) -> [f64; 4] {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let seed = u64::from(k) * u64::from(stride(count)) % u64::from(count.max(1));
    let place = |powers: i32| (0.5 + f64::from(k) / PLASTIC.powi(powers)).fract();
    [(seed as f64 + 0.5) / f64::from(count.max(1)), (seed as f64 / GOLDEN_RATIO).fract(), place(1), place(2)]
}

/// Seeds from each sample to the next: a number without a common factor with their number, so that all are reached, from this part of it on. Of parts from
/// 0.17 to 0.88 it is the one by which halves, thirds, quarters and eighths of 4 to 1024 samples in a row have their middle nearest to the aperture's.
fn stride(count: u32) -> u32 {
    let first = (0.77 * f64::from(count)).round() as u32;
    (first.max(1)..).find(|stride| gcd(*stride, count) == 1).unwrap_or(1)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: u32 = 4096;

    fn places(blades: u32) -> Vec<DVec2> {
        (0..COUNT).map(|k| spread(k, COUNT)).map(|[u, v, ..]| aperture_place(blades, [u, v])).collect()
    }

    /// Mean and mean square of the distance from the middle against those of a polygon of circumradius 1: ∫ r² dA / A = (2 + cos 2π/n) / 6.
    #[test]
    fn places_fill_the_aperture_evenly() {
        for blades in [0, 3, 5, 6, 9] {
            let places = places(blades);
            let mean = places.iter().sum::<DVec2>() / f64::from(COUNT);
            let square = places.iter().map(|place| place.length_squared()).sum::<f64>() / f64::from(COUNT);
            let expected = if blades == 0 { 0.5 } else { (2.0 + (TAU / f64::from(blades)).cos()) / 6.0 };
            assert!(mean.length() < 3e-3, "{blades}: {mean}");
            assert!((square - expected).abs() < 3e-3, "{blades}: {square}, {expected}");
            assert!(places.iter().all(|place| place.length() <= 1.0));
        }
    }

    #[test]
    fn a_triangle_has_nothing_outside_its_sides() {
        // It stands on its corner at (0, -1), and its upper side is at 1/2.
        assert!(places(3).iter().all(|place| place.y <= 0.5 + 1e-12));
        assert!(places(3).iter().any(|place| place.y < -0.9));
        // Fewer blades are none.
        assert_eq!(aperture_place(2, [0.3, 0.7]), aperture_place(0, [0.3, 0.7]));
    }

    #[test]
    fn every_part_of_a_pixel_has_its_share() {
        for axis in 0..4 {
            let count = (0..COUNT).filter(|k| spread(*k, COUNT)[axis] < 0.25).count();
            assert!((count as f64 / f64::from(COUNT) - 0.25).abs() < 2e-3, "{axis}: {count}");
        }
    }

    /// However few they are; and in time too: of each quarter of the samples, some lie on every side.
    #[test]
    fn places_are_all_over_the_aperture_at_any_time() {
        for count in [4, 9, 16, 25, 64, 100, 256] {
            let places: Vec<DVec2> =
                (0..count).map(|k| spread(k, count)).map(|[u, v, ..]| aperture_place(0, [u, v])).collect();
            let distinct =
                |k: usize| (0..k).all(|other| places[k].distance(places[other]) > 1.2 / f64::from(count).sqrt());
            assert!((1..places.len()).all(distinct), "{count}");
            for part in places.chunks(places.len().div_ceil(4)) {
                let mean = part.iter().sum::<DVec2>() / part.len() as f64;
                assert!(mean.length() < 1.5 / (part.len() as f64).sqrt(), "{count}: {mean}");
            }
        }
    }
}
