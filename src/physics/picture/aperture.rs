//! Where light passes through a lens, and when: evenly spread places in an aperture and in a pixel.

use std::f64::consts::TAU;

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

/// The k-th of evenly spread points of [0, 1)⁴: an additive recurrence with the powers of the root of x⁵ = x + 1 (M. Roberts, "The unreasonable
/// effectiveness of quasirandom sequences", 2018).
#[must_use]
pub fn spread(k: u32) -> [f64; 4] {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    std::array::from_fn(|axis| (0.5 + f64::from(k) / ROOT.powi(axis as i32 + 1)).fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: u32 = 4096;

    fn places(blades: u32) -> Vec<DVec2> {
        (0..COUNT).map(spread).map(|[u, v, ..]| aperture_place(blades, [u, v])).collect()
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
            let count = (0..COUNT).filter(|k| spread(*k)[axis] < 0.25).count();
            assert!((count as f64 / f64::from(COUNT) - 0.25).abs() < 2e-3, "{axis}: {count}");
        }
    }
}
