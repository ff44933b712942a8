//! The pattern of a freshly blown film: random patches, marbled.
//!
//! Patches are gradient noise (Perlin 2002, "Improving Noise") at scales of tens of degrees down to a few. Blowing has stirred
//! them: a sequence of twists about random centers, each an area-preserving map of the sphere (after Lu et al. 2012, "Mathematical
//! Marbling", IEEE CG&A 32(6)), draws them out into swirls and filaments without changing how much film has which thickness.
//! All of it is a function of direction and seed in plain IEEE arithmetic, so that it has the same bits everywhere.

use glam::{DMat3, DVec3, IVec3};

use super::random::{Random, pcg3d};

const TWISTS: u32 = 24;
/// Frequencies of the noise in lattice cells per radius, and their weights; the first patches are some 65° wide, the last 15°.
const OCTAVES: [(f64, f64); 3] = [(1.2, 1.0), (2.3, 0.4), (4.4, 0.1)];
/// Spreads the sum of octaves over the range: a standard deviation near 0.55 of (−1, 1).
const CONTRAST: f64 = 4.4;

/// A marbled random pattern on the sphere.
#[derive(Clone, Debug)]
pub struct Marble {
    octaves: [Octave; OCTAVES.len()],
    twists: Vec<Twist>,
}

impl Marble {
    /// The pattern of a seed.
    pub fn new(seed: u32) -> Self {
        let mut random = Random::new(seed, 0);
        Self {
            octaves: std::array::from_fn(|octave| Octave::new(seed, octave)),
            twists: (0..TWISTS).map(|_| Twist::random(&mut random)).collect(),
        }
    }

    /// The pattern in the direction of unit vector `x`: within (−1, 1), about 0, equally often near either end.
    pub fn value(&self, x: DVec3) -> f64 {
        let before = self.twists.iter().fold(x, |x, twist| twist.undo(x));
        let sum: f64 = self.octaves.iter().map(|octave| octave.value(before)).sum();
        let wide = CONTRAST * sum;
        wide / (1.0 + wide * wide).sqrt()
    }
}

/// Noise of one scale, on a lattice turned against the others so that their axes do not show.
#[derive(Clone, Debug)]
struct Octave {
    frequency: f64,
    weight: f64,
    turn: DMat3,
    lattice: Lattice,
}

impl Octave {
    fn new(seed: u32, octave: usize) -> Self {
        let (frequency, weight) = OCTAVES[octave];
        let number = octave as u32 + 1;
        let turn = (0..number).fold(DMat3::IDENTITY, |turn, _| turn * LATTICE_TURN);
        let [key, ..] = pcg3d([seed, number, 0]);
        Self { frequency, weight, turn, lattice: Lattice::new(frequency, key) }
    }

    fn value(&self, x: DVec3) -> f64 {
        self.weight * self.lattice.noise(self.turn * x * self.frequency)
    }
}

/// A rotation in thirds, exactly orthogonal.
const LATTICE_TURN: DMat3 = DMat3::from_cols(
    DVec3::new(2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0),
    DVec3::new(-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0),
    DVec3::new(2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0),
);

/// A turn about a center that fades to nothing at a distance.
#[derive(Clone, Copy, Debug)]
struct Twist {
    center: DVec3,
    /// Squared reach, as a chord.
    reach_squared: f64,
    /// Tangent of half the angle at the center.
    half_turn: f64,
}

impl Twist {
    fn random(random: &mut Random) -> Self {
        // A third power favours small ones: as many as fit beside the large.
        let size = random.between(0.0, 1.0);
        let reach = 0.16 + 0.75 * size * size * size;
        Self {
            center: random.direction(),
            reach_squared: reach * reach,
            half_turn: random.sign() * random.between(0.4, 1.6),
        }
    }

    /// Where `x` was before the twist.
    fn undo(&self, x: DVec3) -> DVec3 {
        let near = 1.0 - x.distance_squared(self.center) / self.reach_squared;
        if near <= 0.0 {
            return x;
        }
        // Rodrigues' rotation by 2 atan(r) about the center, without trigonometry.
        let r = -self.half_turn * near * near;
        let swept = self.center.cross(x) * r;
        x + 2.0 / (1.0 + r * r) * (swept + self.center.cross(swept) * r)
    }
}

/// Gradient noise about the origin. Its gradients are kept: a film has far more cells than its lattice has points.
#[derive(Clone, Debug)]
struct Lattice {
    /// The last point along each axis, in both directions.
    reach: i32,
    /// Gradients at all points, x first.
    gradients: Vec<DVec3>,
}

impl Lattice {
    /// For places up to a distance from the origin.
    fn new(distance: f64, key: u32) -> Self {
        let reach = distance.ceil() as i32;
        let axis = || -reach..=reach;
        let points = axis().flat_map(|z| axis().flat_map(move |y| axis().map(move |x| IVec3::new(x, y, z))));
        Self { reach, gradients: points.map(|point| gradient(point, key)).collect() }
    }

    fn gradient(&self, point: IVec3) -> DVec3 {
        let from_first = (point + self.reach).as_uvec3();
        let side = 2 * self.reach as u32 + 1;
        self.gradients[((from_first.z * side + from_first.y) * side + from_first.x) as usize]
    }

    /// Zero at the points of the lattice, smooth between them, mostly within ±0.5.
    fn noise(&self, p: DVec3) -> f64 {
        // A length that rounding has made a little greater must not lead beyond the last cell.
        let cell = p.floor().as_ivec3().clamp(IVec3::splat(-self.reach), IVec3::splat(self.reach - 1));
        let t = p - cell.as_dvec3();
        let fade = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
        let slope = |corner: IVec3| self.gradient(cell + corner).dot(t - corner.as_dvec3());
        let edge = |y, z| lerp(slope(IVec3::new(0, y, z)), slope(IVec3::new(1, y, z)), fade.x);
        let face = |z| lerp(edge(0, z), edge(1, z), fade.y);
        lerp(face(0), face(1), fade.z)
    }
}

/// The random gradient at a lattice point, uniform in the cube [−1, 1]³.
fn gradient(lattice: IVec3, key: u32) -> DVec3 {
    let [x, y, z] = lattice.as_uvec3().to_array();
    let words = pcg3d([x ^ key, y, z]);
    DVec3::from_array(words.map(|word| f64::from(word) * 2.0_f64.powi(-31) - 1.0))
}

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;

    fn samples(seed: u32, n: usize) -> Vec<f64> {
        let grid = CubedSphere::new(n).unwrap();
        let marble = Marble::new(seed);
        (0..grid.cells()).map(|cell| marble.value(grid.cell_direction(cell))).collect()
    }

    #[test]
    fn values_fill_the_range_evenly() {
        for seed in [0, 1, 42] {
            let values = samples(seed, 24);
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let spread = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
            assert!(values.iter().all(|v| v.abs() < 1.0));
            assert!(mean.abs() < 0.2 && (0.4..0.7).contains(&spread), "seed {seed}: {mean} ± {spread}");
        }
    }

    #[test]
    fn twists_preserve_length_area_and_continuity() {
        let twist = Twist { center: DVec3::Z, reach_squared: 0.25, half_turn: 1.5 };
        let d = 1e-6;
        for x in
            [DVec3::new(0.1, 0.2, 1.0), DVec3::new(-0.3, 0.1, 1.0), DVec3::new(0.5, 0.0, 0.9)].map(DVec3::normalize)
        {
            let (e1, e2) = x.any_orthonormal_pair();
            let slope =
                |e: DVec3| (twist.undo((x + d * e).normalize()) - twist.undo((x - d * e).normalize())) / (2.0 * d);
            assert!((twist.undo(x).length() - 1.0).abs() < 1e-15);
            assert!((slope(e1).cross(slope(e2)).length() - 1.0).abs() < 1e-8);
        }
        assert_eq!(twist.undo(DVec3::X), DVec3::X);
    }

    /// Fraction of the variance that a difference over `angle` radians holds.
    fn roughness(seed: u32, angle: f64) -> f64 {
        let marble = Marble::new(seed);
        let mut random = Random::new(99, 0);
        let (mut differences, mut squares) = (0.0, 0.0);
        for _ in 0..4000 {
            let x = random.direction();
            let (e, _) = x.any_orthonormal_pair();
            let step = |s: f64| marble.value((x + s * angle * e).normalize());
            differences += (step(1.0) - 2.0 * step(0.0) + step(-1.0)).powi(2);
            squares += step(0.0).powi(2);
        }
        differences / (16.0 * squares)
    }

    #[test]
    fn the_spectrum_falls_off_well_before_two_degrees() {
        // The second difference over 1° weighs a wave of length 2° by 1, one of 8° by 0.02, one of 20° by 0.0006.
        for seed in [0, 5] {
            let rough = roughness(seed, 1.0_f64.to_radians());
            assert!(rough < 0.01, "seed {seed}: {rough}");
        }
    }

    #[test]
    fn seeds_differ_and_equal_seeds_do_not() {
        assert_eq!(samples(3, 8), samples(3, 8));
        assert_ne!(samples(3, 8), samples(4, 8));
    }
}
