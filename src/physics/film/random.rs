//! Random numbers that are the same on every platform, by integer hashing alone.

use glam::DVec3;

/// The hash `pcg3d` of Jarzynski & Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3): three words in, three out.
pub fn pcg3d(words: [u32; 3]) -> [u32; 3] {
    let mix = |[x, y, z]: [u32; 3]| {
        let x = x.wrapping_add(y.wrapping_mul(z));
        let y = y.wrapping_add(z.wrapping_mul(x));
        [x, y, z.wrapping_add(x.wrapping_mul(y))]
    };
    let v = mix(words.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223)));
    mix(v.map(|word| word ^ (word >> 16)))
}

/// A seed of 64 bits as the generators take it: seeds below 2³² are themselves.
#[must_use]
pub fn fold_seed(seed: u64) -> u32 {
    (seed ^ (seed >> 32)) as u32
}

/// A sequence of random numbers that depends on a seed and on what it is for.
#[derive(Clone, Debug)]
pub struct Random {
    seed: u32,
    stream: u32,
    count: u32,
}

impl Random {
    /// The sequence of a seed; streams of one seed are independent of each other.
    pub fn new(seed: u32, stream: u32) -> Self {
        Self { seed, stream, count: 0 }
    }

    /// The next number, uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.count += 1;
        let [word, ..] = pcg3d([self.seed, self.stream, self.count]);
        low + (high - low) * f64::from(word) / (f64::from(u32::MAX) + 1.0)
    }

    /// The next number, uniform in its logarithm in [low, high), both positive.
    pub fn between_log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// −1 or +1.
    pub fn sign(&mut self) -> f64 {
        if self.between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 }
    }

    /// A direction, uniform on the sphere: by rejection from the cube, which needs no trigonometry.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from_array([(); 3].map(|()| self.between(-1.0, 1.0)));
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_never_changes() {
        // Films and flows of a seed would change with it.
        assert_eq!(pcg3d([1, 2, 3]), HASH_OF_1_2_3);
    }

    /// Computed from the paper's listing with Python integers.
    const HASH_OF_1_2_3: [u32; 3] = [4_204_755_366, 1_223_881_804, 1_500_469_937];

    #[test]
    fn numbers_are_uniform_and_directions_isotropic() {
        let mut random = Random::new(7, 0);
        let numbers: Vec<f64> = (0..10_000).map(|_| random.between(2.0, 4.0)).collect();
        assert!(numbers.iter().all(|x| (2.0..4.0).contains(x)));
        // Standard error of the mean: 2/sqrt(12 * 10000) = 0.006.
        assert!((numbers.iter().sum::<f64>() / 1e4 - 3.0).abs() < 0.02);
        let mean = (0..10_000).map(|_| random.direction()).sum::<DVec3>() / 1e4;
        assert!(mean.length() < 0.04, "four standard errors: {mean}");
    }

    #[test]
    fn seeds_and_streams_differ() {
        let first = |seed, stream| Random::new(seed, stream).between(0.0, 1.0);
        assert!(first(1, 0) != first(2, 0) && first(1, 0) != first(1, 1));
    }
}
