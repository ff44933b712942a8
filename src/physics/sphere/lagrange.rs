//! Four-point Lagrange interpolation.

/// Weights of the cubic through the nodes −1, 0, 1, 2 at `t`; they sum to 1. Best for t in [0, 1], valid for any t.
pub fn cubic_weights(t: f64) -> [f64; 4] {
    let [a, b, c] = [t + 1.0, t - 1.0, t - 2.0];
    [-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_reproduced() {
        let cubic = |x: f64| 2.0 - 3.0 * x + 0.5 * x * x - 1.5 * x * x * x;
        for t in [-1.0, -0.4, 0.0, 0.3, 1.0, 1.9] {
            let value: f64 = cubic_weights(t).iter().zip(-1..3).map(|(w, node)| w * cubic(f64::from(node))).sum();
            assert!((value - cubic(t)).abs() < 1e-13);
        }
    }
}
