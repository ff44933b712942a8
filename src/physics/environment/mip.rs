//! Smaller versions of a square picture, each half the size of the last, with the same mean.

use crate::parallel;

/// The level below a square picture of `size` texels: each texel is the mean of the area it covers, and the mean of all is
/// kept.
///
/// An even size gives the usual 2 × 2 box. The GPU rounds odd sizes down, so a texel then covers between 2 and 3 of its
/// parents, some of them in part.
pub(super) fn halve(texels: &[[f32; 3]], size: usize) -> Vec<[f32; 3]> {
    let half = (size / 2).max(1);
    if 2 * half == size {
        return halve_even(texels, size);
    }
    let coverage: Vec<_> = (0..half).map(|i| Coverage::new(i, size, half)).collect();
    let mut smaller = vec![[0.0; 3]; half * half];
    parallel::change(&mut smaller, half, |k, row| {
        for (texel, horizontal) in row.iter_mut().zip(&coverage) {
            *texel = mean(texels, size, horizontal, &coverage[k]);
        }
    });
    smaller
}

/// Means of two by two texels.
fn halve_even(texels: &[[f32; 3]], size: usize) -> Vec<[f32; 3]> {
    let mut smaller = vec![[0.0; 3]; texels.len() / 4];
    parallel::change(&mut smaller, size / 2, |k, row| {
        let (upper, lower) = texels[2 * size * k..][..2 * size].split_at(size);
        for ((texel, upper), lower) in row.iter_mut().zip(upper.chunks_exact(2)).zip(lower.chunks_exact(2)) {
            let sum =
                |i: usize| [upper[0][i], upper[1][i], lower[0][i], lower[1][i]].map(f64::from).iter().sum::<f64>();
            *texel = std::array::from_fn(|i| (0.25 * sum(i)) as f32);
        }
    });
    smaller
}

/// The parents of one texel along one axis: three weights, summing to 1, from the parent `first` on.
struct Coverage {
    first: usize,
    weights: [f64; 3],
}

impl Coverage {
    /// Of texel `index` among `half`, over `size` parents.
    fn new(index: usize, size: usize, half: usize) -> Self {
        let scale = size as f64 / half as f64;
        let (start, end) = (index as f64 * scale, (index + 1) as f64 * scale);
        let first = start.floor() as usize;
        let overlap = |parent: usize| ((parent + 1) as f64).min(end) - (parent as f64).max(start);
        Self { first, weights: [0, 1, 2].map(|i| overlap(first + i).max(0.0) / scale) }
    }

    /// The parents that are covered at all, with their weights.
    fn parents(&self) -> impl Iterator<Item = (usize, f64)> {
        (self.first..).zip(self.weights).filter(|&(_, weight)| weight > 0.0)
    }
}

fn mean(texels: &[[f32; 3]], size: usize, horizontal: &Coverage, vertical: &Coverage) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for (row, row_weight) in vertical.parents() {
        for (column, column_weight) in horizontal.parents() {
            // Rounding in the overlap may leave the last texel a sliver of a parent beyond the edge.
            let texel = texels[row.min(size - 1) * size + column.min(size - 1)];
            sum = std::array::from_fn(|i| sum[i] + row_weight * column_weight * f64::from(texel[i]));
        }
    }
    sum.map(|component| component as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize) -> Vec<[f32; 3]> {
        (0..count).map(|i| [0.1, 0.7, 1.3].map(|phase| 1.0 + (i as f32 * 12.9898 + phase).sin())).collect()
    }

    fn mean_of(texels: &[[f32; 3]]) -> f64 {
        texels.iter().flatten().map(|&component| f64::from(component)).sum::<f64>() / (3 * texels.len()) as f64
    }

    #[test]
    fn even_sizes_are_a_two_by_two_box() {
        let texels: Vec<[f32; 3]> = (0..16).map(|i| [i as f32; 3]).collect();
        assert_eq!(halve(&texels, 4), [2.5, 4.5, 10.5, 12.5].map(|value| [value; 3]));
    }

    #[test]
    fn every_size_keeps_the_mean() {
        for size in [1, 2, 3, 5, 7, 11, 16, 22, 23, 33] {
            let texels = noise(size * size);
            let smaller = halve(&texels, size);
            assert_eq!(smaller.len(), (size / 2).max(1).pow(2));
            // f32 rounding of texels near 1, averaged.
            assert!((mean_of(&smaller) - mean_of(&texels)).abs() < 1e-6, "size {size}");
        }
    }

    #[test]
    fn odd_sizes_share_the_middle_parent() {
        let texels = [0.0, 1.0, 0.0].repeat(3).into_iter().map(|value| [value; 3]).collect::<Vec<_>>();
        assert_eq!(halve(&texels, 3), [[1.0f32 / 3.0; 3]]);
    }
}
