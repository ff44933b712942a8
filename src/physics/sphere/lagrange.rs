//! Lagrange interpolation through four and six points.

/// Weights of the cubic through the nodes −1, 0, 1, 2 at `t`; they sum to 1. Best for t in [0, 1], valid for any t.
pub fn cubic_weights(t: f64) -> [f64; 4] {
    let [a, b, c] = [t + 1.0, t - 1.0, t - 2.0];
    [-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0]
}

/// Weights of the quintic through the nodes −2 to 3 at `t`; they sum to 1. Best for t in [0, 1], valid for any t.
pub fn quintic_weights(t: f64) -> [f64; 6] {
    let [near, middle, far] = [t * (t - 1.0), (t + 1.0) * (t - 2.0), (t + 2.0) * (t - 3.0)];
    [
        -near * middle * (t - 3.0) / 120.0,
        near * far * (t - 2.0) / 24.0,
        -(t - 1.0) * middle * far / 12.0,
        t * middle * far / 12.0,
        -near * far * (t + 1.0) / 24.0,
        near * middle * (t + 2.0) / 120.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quintics_are_reproduced() {
        let quintic = |x: f64| 1.0 + x - 0.5 * x.powi(2) + 0.25 * x.powi(3) - 0.1 * x.powi(4) + 0.05 * x.powi(5);
        for t in [-2.0, -0.4, 0.0, 0.3, 1.0, 2.9] {
            let value: f64 = quintic_weights(t).iter().zip(-2..4).map(|(w, node)| w * quintic(f64::from(node))).sum();
            assert!((value - quintic(t)).abs() < 1e-12);
        }
    }

    #[test]
    fn cubics_are_reproduced() {
        let cubic = |x: f64| 2.0 - 3.0 * x + 0.5 * x * x - 1.5 * x * x * x;
        for t in [-1.0, -0.4, 0.0, 0.3, 1.0, 1.9] {
            let value: f64 = cubic_weights(t).iter().zip(-1..3).map(|(w, node)| w * cubic(f64::from(node))).sum();
            assert!((value - cubic(t)).abs() < 1e-13);
        }
    }
}
