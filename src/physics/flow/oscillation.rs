//! The frequency and decay of a sampled oscillation.

/// A damped oscillation `e^(−γt) cos(ωt + φ)`, or for an imaginary ω growth and decay without any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// ω in rad/s; 0 if it does not oscillate.
    pub frequency: f64,
    /// The fastest growth in 1/s: −γ for an oscillation.
    pub growth: f64,
}

/// The oscillation in samples `dt` apart, by the least-squares recurrence `c(k+1) = p c(k) − q c(k−1)` that all of them obey (Prony
/// 1795). `None` for fewer than four samples, or if they are constant.
#[must_use]
pub fn fit_oscillation(samples: &[f64], dt: f64) -> Option<Oscillation> {
    if samples.len() < 4 {
        return None;
    }
    let sum = |of: &dyn Fn(&[f64]) -> f64| samples.windows(3).map(of).sum::<f64>();
    let [aa, ab, bb] = [sum(&|c| c[1] * c[1]), sum(&|c| c[0] * c[1]), sum(&|c| c[0] * c[0])];
    let [ac, bc] = [sum(&|c| c[1] * c[2]), sum(&|c| c[0] * c[2])];
    let determinant = aa * bb - ab * ab;
    let p = (ac * bb - bc * ab) / determinant;
    let q = (ac * ab - bc * aa) / determinant;
    let discriminant = 0.25 * p * p - q;
    let found = if discriminant < 0.0 {
        Oscillation { frequency: (-discriminant).sqrt().atan2(0.5 * p) / dt, growth: 0.5 * q.ln() / dt }
    } else {
        Oscillation { frequency: 0.0, growth: (0.5 * p + discriminant.sqrt()).ln() / dt }
    };
    found.growth.is_finite().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(of: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..40).map(|k| of(0.05 * f64::from(k))).collect()
    }

    #[test]
    fn oscillations_and_growth_are_found() {
        let found = fit_oscillation(&samples(|t| (-0.3 * t).exp() * (2.0 * t + 0.4).cos()), 0.05).unwrap();
        assert!((found.frequency - 2.0).abs() < 1e-9 && (found.growth + 0.3).abs() < 1e-9, "{found:?}");
        let found = fit_oscillation(&samples(|t| (0.7 * t).cosh()), 0.05).unwrap();
        assert!(found.frequency == 0.0 && (found.growth - 0.7).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn an_oscillation_needs_samples_that_swing() {
        assert_eq!(fit_oscillation(&[1.0, 2.0, 3.0], 1.0), None);
        assert_eq!(fit_oscillation(&[0.0; 9], 1.0), None);
    }
}
