//! Snell, Fresnel and Airy for air | film | air. The corrections to the printed formulas stand in the module above.
//!
//! Everywhere `n` is the film's index, 1 to 4, `cos_theta` the cosine of the angle of incidence in air, 0 (grazing) to 1 (normal), and
//! `thickness_nm` the thickness along the normal.

use std::f64::consts::PI;

use super::{Coherence, Polarised};

/// Light of one wavelength that meets a film at one angle: all of the film's answer that its thickness has no part in.
///
/// A ray inside a sphere meets the film at the same angle every time, so its walls share one `Incidence`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incidence {
    /// Fresnel's amplitude coefficients of the outer face.
    face: Polarised,
    /// n cos θ_t.
    n_cos_refracted: f64,
}

impl Incidence {
    /// The light that meets a film of index `n` at `cos_theta`.
    pub fn new(n: f64, cos_theta: f64) -> Self {
        Self { face: amplitudes(n, cos_theta), n_cos_refracted: n_cos_refracted(n, cos_theta) }
    }

    /// Reflectance of a film of this thickness, for each polarisation; the film absorbs nothing, so 1 − R goes through.
    ///
    /// Airy's R = 2r²(1 − cos δ) / (1 + r⁴ − 2r² cos δ), written with 1 − cos δ = 2 sin²(δ/2) so that nothing cancels in thin films.
    /// It is even in the thickness, and exactly 0 for thickness 0 or n = 1.
    /// Right at grazing, `cos_theta` = 0, it is 1 for every thickness but 0: the limit, save at the single wavelengths with sin(δ/2) = 0.
    pub fn reflectance(&self, thickness_nm: f64, wavelength_nm: f64) -> Polarised {
        let sin2 = sin2_half_turns(self.order(thickness_nm, wavelength_nm));
        self.face.map(|r| airy(r * r, sin2, thickness_nm))
    }

    /// What a film of this thickness makes of the coherence of s and p light.
    pub fn coherence(&self, thickness_nm: f64, wavelength_nm: f64) -> Coherence {
        let half_phase = half_turns(self.order(thickness_nm, wavelength_nm));
        Coherence::of_plain(self.face, half_phase, thickness_nm)
    }

    /// Order of interference: the path in the film, there and back, in wavelengths, δ / 2π.
    fn order(&self, thickness_nm: f64, wavelength_nm: f64) -> f64 {
        2.0 * self.n_cos_refracted * thickness_nm / wavelength_nm
    }

    /// The mean reflectance where thickness, angle or wavelength are spread, so that only a part of the fringes' contrast is left:
    /// `coherence`, 1 for none of that, 0 for the incoherent limit 2r² / (1 + r²).
    ///
    /// Airy's T is (1 − r²) / (1 + r²) · (1 + 2 Σ r²ᵏ cos kδ). With coherenceᵏ on its k-th harmonic, as a Lorentz distribution of δ has it,
    /// the sum is closed: with q = coherence · r², T = (1 − r²) / (1 + r²) · (1 − q²) / (1 + q² − 2q cos δ).
    pub fn damped_reflectance(&self, thickness_nm: f64, wavelength_nm: f64, coherence: f64) -> Polarised {
        let sin2 = sin2_half_turns(self.order(thickness_nm, wavelength_nm));
        self.face.map(|r| {
            let r2 = r * r;
            let q = coherence * r2;
            let fringes = 4.0 * q * sin2;
            let reflected = 2.0 * r2 * (1.0 - coherence) * (1.0 - q) + (1.0 + r2) * fringes;
            let all = (1.0 + r2) * ((1.0 - q).powi(2) + fringes);
            // As in `airy`.
            if all > 0.0 { reflected / all } else { f64::from(thickness_nm != 0.0) }
        })
    }
}

/// Coefficients of sin(πx) / x in powers of x², (−1)ᵏ π²ᵏ⁺¹ / (2k + 1)!, up to the 23rd power of x: at x = ½ the next term is 2e-20.
const SINE: [f64; 12] = {
    let mut series = [PI; 12];
    let mut k = 1;
    while k < series.len() {
        series[k] = -series[k - 1] * (PI * PI) / (2 * k * (2 * k + 1)) as f64;
        k += 1;
    }
    series
};

/// sin²(πx), for |x| below 2⁵¹. The sine of the standard library took a third of the time of a spectrum.
fn sin2_half_turns(x: f64) -> f64 {
    let sine = sine(to_nearest_integer(x));
    sine * sine
}

/// Sine and cosine of πx, for |x| below 2⁵¹, but for the sign that both have in common.
fn half_turns(x: f64) -> [f64; 2] {
    let x = to_nearest_integer(x);
    [sine(x), sine(0.5 - x.abs())]
}

/// x less the nearest integer: from −½ to ½.
fn to_nearest_integer(x: f64) -> f64 {
    // A sum as large as this has no digits behind the point: adding it rounds.
    const ROUNDER: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²
    x - ((x + ROUNDER) - ROUNDER)
}

/// sin(πx) for |x| ≤ ½.
fn sine(x: f64) -> f64 {
    let x2 = x * x;
    x * SINE.iter().rev().fold(0.0, |sum, coefficient| sum * x2 + coefficient)
}

/// Light of several wavelengths that meets a film at one angle: an [`Incidence`] for each, laid out for loops that compilers turn into
/// vector instructions.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralIncidence {
    /// Fresnel's amplitude coefficients of the outer face.
    faces: Vec<Polarised>,
    /// Order of interference of a film of 1 nm.
    orders_per_nm: Vec<f64>,
}

impl SpectralIncidence {
    /// The light that meets a film at `cos_theta`, from the film's index at each wavelength in nm.
    pub fn new(indices: &[f64], wavelengths_nm: &[f64], cos_theta: f64) -> Self {
        let order = |(n, nm): (&f64, &f64)| 2.0 * n_cos_refracted(*n, cos_theta) / nm;
        Self {
            faces: indices.iter().map(|n| amplitudes(*n, cos_theta)).collect(),
            orders_per_nm: indices.iter().zip(wavelengths_nm).map(order).collect(),
        }
    }

    /// As [`Incidence::reflectance`], at each wavelength.
    #[must_use]
    pub fn reflectances(&self, thickness_nm: f64) -> Vec<Polarised> {
        let sin2: Vec<f64> = self.orders_per_nm.iter().map(|order| sin2_half_turns(order * thickness_nm)).collect();
        self.faces.iter().zip(sin2).map(|(face, sin2)| face.map(|r| airy(r * r, sin2, thickness_nm))).collect()
    }

    /// As [`Incidence::coherence`], at each wavelength.
    #[must_use]
    pub fn coherences(&self, thickness_nm: f64) -> Vec<Coherence> {
        let half_phases: Vec<[f64; 2]> =
            self.orders_per_nm.iter().map(|order| half_turns(order * thickness_nm)).collect();
        let waves = self.faces.iter().zip(half_phases);
        waves.map(|(face, half_phase)| Coherence::of_plain(*face, half_phase, thickness_nm)).collect()
    }
}

fn airy(r2: f64, sin2_half_phase: f64, thickness_nm: f64) -> f64 {
    let reflected = 4.0 * r2 * sin2_half_phase;
    let transmitted = (1.0 - r2).powi(2);
    if reflected + transmitted > 0.0 {
        reflected / (reflected + transmitted)
    } else {
        // Grazing (r² = 1) and sin(δ/2) = 0 at once: 0/0. See `Incidence::reflectance` for what is meant.
        f64::from(thickness_nm != 0.0)
    }
}

/// Cosine of the angle inside the film, by Snell's law: √(1 − (1 − cos²θ) / n²).
pub fn cos_refracted(n: f64, cos_theta: f64) -> f64 {
    n_cos_refracted(n, cos_theta) / n
}

/// n cos θ_t = √(n² − 1 + cos²θ): this form keeps its digits near grazing, and is exactly cos θ for n = 1.
fn n_cos_refracted(n: f64, cos_theta: f64) -> f64 {
    ((n - 1.0) * (n + 1.0) + cos_theta * cos_theta).sqrt()
}

/// Fresnel's amplitude coefficients of the film's outer face,
/// r_s = (cosθ − n cosθ_t) / (cosθ + n cosθ_t) and r_p = (n cosθ − cosθ_t) / (n cosθ + cosθ_t).
///
/// r_p vanishes at Brewster's angle, tan θ = n. Both are −1 at grazing and 0 for n = 1.
pub fn amplitudes(n: f64, cos_theta: f64) -> Polarised {
    let inside = n_cos_refracted(n, cos_theta);
    let outside = n * n * cos_theta;
    Polarised { s: contrast(cos_theta, inside), p: contrast(outside, inside) }
}

/// (a − b) / (a + b) for a, b ≥ 0. Both are 0 only at grazing on n = 1, which is no surface and reflects nothing.
fn contrast(a: f64, b: f64) -> f64 {
    if a == b { 0.0 } else { (a - b) / (a + b) }
}

/// Reflectance of the film for each polarisation; see [`Incidence::reflectance`] for formula and limits.
pub fn reflectance(n: f64, cos_theta: f64, thickness_nm: f64, wavelength_nm: f64) -> Polarised {
    Incidence::new(n, cos_theta).reflectance(thickness_nm, wavelength_nm)
}

/// The most that a film of any thickness can reflect at this angle, unpolarised: ½ Σ 4r² / (1 + r²)², which is R at cos δ = −1.
/// 0.0784 for water at normal incidence, 1 at grazing, 0 for n = 1.
pub fn max_reflectance(n: f64, cos_theta: f64) -> f64 {
    amplitudes(n, cos_theta).map(|r| (2.0 * r / (1.0 + r * r)).powi(2)).mean()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::physics::optics::{FilmIndex, REFERENCE_NM};

    #[test]
    fn a_spectrum_is_its_wavelengths() {
        for_all_cases(|n, cos_theta, thickness_nm, nm| {
            let spectral = SpectralIncidence::new(&[1.4, n], &[500.0, nm], cos_theta).reflectances(thickness_nm);
            let single = reflectance(n, cos_theta, thickness_nm, nm);
            // The phase is rounded elsewhere, which resonance near grazing magnifies.
            let tolerance = if cos_theta < 0.01 { 1e-8 } else { 1e-13 };
            assert!((spectral[1].s - single.s).abs() < tolerance && (spectral[1].p - single.p).abs() < tolerance);
        });
    }

    #[test]
    fn the_sine_is_that_of_the_standard_library() {
        for k in -40_000..40_000 {
            let x = 0.001_25 * f64::from(k);
            let expected = (PI * x).sin().powi(2);
            // π x itself is rounded, by up to half an ulp of 50 π.
            assert!((sin2_half_turns(x) - expected).abs() < 3e-14, "{x}");
            assert!((0.0..=1.0).contains(&sin2_half_turns(x)), "{x}");
            let [sine, cosine] = half_turns(x);
            assert!((2.0 * sine * cosine - (2.0 * PI * x).sin()).abs() < 6e-14, "{x}");
        }
        assert_eq!([0.0, 1.0, -7.0, 0.5, 1e9 + 0.5].map(sin2_half_turns), [0.0, 0.0, 0.0, 1.0, 1.0]);
        assert!(sin2_half_turns(f64::NAN).is_nan());
    }

    const INDICES: [f64; 4] = [1.0, 1.33, 1.5, 4.0];
    const COSINES: [f64; 7] = [1e-6, 0.05, 0.2, 0.5, 0.6, 0.9, 1.0];
    const THICKNESSES_NM: [f64; 6] = [0.0, 1e-3, 7.0, 205.0, 1500.0, 3000.0];
    const WAVELENGTHS_NM: [f64; 3] = [360.0, 589.0, 780.0];

    fn for_all_cases(mut check: impl FnMut(f64, f64, f64, f64)) {
        for n in INDICES {
            for cos_theta in COSINES {
                for thickness_nm in THICKNESSES_NM {
                    WAVELENGTHS_NM.iter().for_each(|&nm| check(n, cos_theta, thickness_nm, nm));
                }
            }
        }
    }

    #[test]
    fn damped_fringes_are_means_over_a_lorentz_distribution() {
        for_all_cases(|n, cos_theta, thickness_nm, nm| {
            let incidence = Incidence::new(n, cos_theta);
            let whole = incidence.damped_reflectance(thickness_nm, nm, 1.0);
            let plain = incidence.reflectance(thickness_nm, nm);
            assert!((whole.s - plain.s).abs() < 1e-12 && (whole.p - plain.p).abs() < 1e-12, "{n} {cos_theta}");
            let none = incidence.damped_reflectance(thickness_nm, nm, 0.0);
            let limit = incidence.face.map(|r| 2.0 * r * r / (1.0 + r * r));
            assert!((none.s - limit.s).abs() < 1e-12 && (none.p - limit.p).abs() < 1e-12, "{n} {cos_theta}");
        });
        // By quadrature: phases δ + γ tan(π (u − ½)), u uniform, with γ = −ln coherence.
        let (incidence, nm, coherence) = (Incidence::new(1.33, 0.4), 550.0, 0.6_f64);
        let nm_per_radian = nm / (2.0 * TAU * incidence.n_cos_refracted);
        let count = 400_000;
        let sample = |k: u32| {
            let u = (f64::from(k) + 0.5) / f64::from(count);
            let phase = -coherence.ln() * (std::f64::consts::PI * (u - 0.5)).tan();
            incidence.reflectance(300.0 + nm_per_radian * phase, nm).s
        };
        let mean = (0..count).map(sample).sum::<f64>() / f64::from(count);
        let closed = incidence.damped_reflectance(300.0, nm, coherence).s;
        assert!((mean - closed).abs() < 1e-4, "{mean} {closed}");
    }

    /// R and T of one polarisation by the characteristic matrix (Macleod, *Thin-Film Optical Filters*, ch. 2), η the tilted admittances:
    /// another road to the same physics, with T not taken from R.
    fn characteristic_matrix(eta_air: f64, eta_film: f64, phase: f64) -> (f64, f64) {
        let (sin, cos) = phase.sin_cos();
        let (b_re, b_im) = (cos, sin * eta_air / eta_film);
        let (c_re, c_im) = (eta_air * cos, eta_film * sin);
        let norm2 = |re: f64, im: f64| re * re + im * im;
        let incoming = norm2(eta_air * b_re + c_re, eta_air * b_im + c_im);
        (norm2(eta_air * b_re - c_re, eta_air * b_im - c_im) / incoming, 4.0 * eta_air * eta_air / incoming)
    }

    #[test]
    fn equals_the_characteristic_matrix_and_conserves_energy() {
        for_all_cases(|n, cos_theta, thickness_nm, nm| {
            let cos_t = cos_refracted(n, cos_theta);
            let phase = TAU * n * thickness_nm * cos_t / nm;
            let film = reflectance(n, cos_theta, thickness_nm, nm);
            let matrices = [(film.s, cos_theta, n * cos_t), (film.p, 1.0 / cos_theta, n / cos_t)];
            for (r, eta_air, eta_film) in matrices {
                let (r_matrix, t_matrix) = characteristic_matrix(eta_air, eta_film, phase);
                // Near resonance at grazing incidence rounding of the phase is magnified; elsewhere 1e-14 holds.
                let tolerance = if cos_theta < 0.01 { 1e-8 } else { 1e-13 };
                assert!((r - r_matrix).abs() < tolerance, "R {r} {r_matrix} n={n} cos={cos_theta} d={thickness_nm}");
                assert!((r + t_matrix - 1.0).abs() < tolerance, "R+T {r} {t_matrix} n={n} cos={cos_theta}");
                assert!((0.0..=1.0).contains(&r));
            }
        });
    }

    #[test]
    fn equals_the_formula_as_printed_but_for_the_missing_half() {
        let (n, cos_theta, d, nm) = (1.333, 0.7, 410.0, 550.0);
        let r = amplitudes(n, cos_theta);
        let cos_delta = (2.0 * TAU * n * d * cos_refracted(n, cos_theta) / nm).cos();
        let term = |r: f64| 2.0 * r.powi(2) * (1.0 - cos_delta) / (1.0 + r.powi(4) - 2.0 * r.powi(2) * cos_delta);
        let printed = term(r.s) + term(r.p);
        // The printed form loses digits in 1 − cos δ; for this δ of order 10 that is a few parts in 1e15.
        assert!((printed - 2.0 * reflectance(n, cos_theta, d, nm).mean()).abs() < 1e-14);
    }

    #[test]
    fn is_even_in_thickness_and_exactly_dark_without_a_film() {
        for_all_cases(|n, cos_theta, thickness_nm, nm| {
            let film = reflectance(n, cos_theta, thickness_nm, nm);
            assert_eq!(film, reflectance(n, cos_theta, -thickness_nm, nm));
            if thickness_nm == 0.0 || n == 1.0 {
                assert_eq!(film, Polarised { s: 0.0, p: 0.0 }, "n={n} cos={cos_theta}");
            }
        });
    }

    #[test]
    fn reflects_everything_right_at_grazing() {
        // At n = √(5/4) and λ = 2 n d = 500 nm the phase is exactly 2π k: the 0/0 that the definition settles.
        for thickness_nm in [1e-3, 250.0, 500.0, 3000.0] {
            for n in [1.33, 1.25_f64.sqrt(), 4.0] {
                assert_eq!(reflectance(n, 0.0, thickness_nm, 500.0), Polarised { s: 1.0, p: 1.0 });
            }
        }
        assert_eq!(reflectance(1.33, 0.0, 0.0, 500.0).mean(), 0.0);
        assert_eq!(reflectance(1.0, 0.0, 300.0, 500.0).mean(), 0.0);
        assert_eq!(airy(1.0, 0.0, 500.0), 1.0);
        assert_eq!((max_reflectance(1.33, 0.0), max_reflectance(1.0, 0.0)), (1.0, 0.0));
    }

    #[test]
    fn p_light_is_not_reflected_at_brewsters_angle() {
        let n = FilmIndex::Water.n(REFERENCE_NM);
        let cos_brewster = 1.0 / (1.0 + n * n).sqrt();
        assert!((cos_brewster - 0.600).abs() < 5e-4, "{cos_brewster}");
        let film = reflectance(n, cos_brewster, 150.0, REFERENCE_NM);
        assert!(film.p < 1e-30 && film.s > 0.1, "{film:?}");
    }

    #[test]
    fn no_thickness_reflects_more_than_the_maximum() {
        for n in INDICES {
            for cos_theta in COSINES {
                let quarter_wave_nm = 500.0 / 4.0 / n_cos_refracted(n, cos_theta);
                let (max, quarter) = (max_reflectance(n, cos_theta), reflectance(n, cos_theta, quarter_wave_nm, 500.0));
                assert!((max - quarter.mean()).abs() < 1e-14, "n={n} cos={cos_theta}: {max} {quarter:?}");
                for thickness_nm in THICKNESSES_NM {
                    assert!(reflectance(n, cos_theta, thickness_nm, 500.0).mean() <= max + 1e-15);
                }
            }
        }
        assert!((max_reflectance(FilmIndex::Water.n(REFERENCE_NM), 1.0) - 0.0784).abs() < 5e-5);
    }

    proptest! {
        #[test]
        fn reflectance_is_a_share_below_its_maximum(
            n in 1.0..=4.0, cos_theta in 0.0..=1.0, thickness_nm in 0.0..30_000.0, nm in 360.0..780.0
        ) {
            let incidence = Incidence::new(n, cos_theta);
            let film = incidence.reflectance(thickness_nm, nm);
            let max = amplitudes(n, cos_theta).map(|r| (2.0 * r / (1.0 + r * r)).powi(2));
            prop_assert!((0.0..=max.s + 1e-14).contains(&film.s), "{:?} above {:?}", film, max);
            prop_assert!((0.0..=max.p + 1e-14).contains(&film.p), "{:?} above {:?}", film, max);
        }

        #[test]
        fn reflectance_repeats_with_each_half_wavelength_of_path(
            n in 1.01..=4.0, cos_theta in 0.01..=1.0, thickness_nm in 0.0..1500.0, nm in 360.0..780.0
        ) {
            let period_nm = nm / (2.0 * n_cos_refracted(n, cos_theta));
            let [thin, thick] = [0.0, period_nm].map(|more_nm| reflectance(n, cos_theta, thickness_nm + more_nm, nm));
            // Rounding of the phase, magnified by the finesse of a film that mirrors.
            prop_assert!((thin.s - thick.s).abs() + (thin.p - thick.p).abs() < 1e-9, "{:?} {:?}", thin, thick);
        }

        #[test]
        fn less_coherence_never_leaves_more_contrast(
            n in 1.01..=4.0, cos_theta in 0.01..=1.0, nm in 360.0..780.0, part in 0.0..=1.0, coherence in 0.0..=1.0
        ) {
            let incidence = Incidence::new(n, cos_theta);
            let quarter_nm = nm / (4.0 * incidence.n_cos_refracted);
            let contrast = |coherence| {
                let [bright, dark] = [quarter_nm, 0.0].map(|d| incidence.damped_reflectance(d, nm, coherence).s);
                bright - dark
            };
            prop_assert!(contrast(part * coherence) <= contrast(coherence) + 1e-14);
        }

        #[test]
        fn the_characteristic_matrix_gives_the_same(
            n in 1.0..=4.0, cos_theta in 0.02..=1.0, thickness_nm in 0.0..3000.0, nm in 360.0..780.0
        ) {
            let cos_t = cos_refracted(n, cos_theta);
            let film = reflectance(n, cos_theta, thickness_nm, nm);
            let phase = TAU * n * thickness_nm * cos_t / nm;
            for (r, eta_air, eta_film) in [(film.s, cos_theta, n * cos_t), (film.p, 1.0 / cos_theta, n / cos_t)] {
                let (r_matrix, t_matrix) = characteristic_matrix(eta_air, eta_film, phase);
                prop_assert!((r - r_matrix).abs() < 1e-10, "R {} {}", r, r_matrix);
                prop_assert!((r + t_matrix - 1.0).abs() < 1e-10, "R + T {} {}", r, t_matrix);
            }
        }
    }
}
