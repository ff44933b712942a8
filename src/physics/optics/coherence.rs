//! What a film makes of the coherence of s and p light.
//!
//! Light of the fields E_s and E_p has the coherence ⟨E_s E_p*⟩, which is half of Stokes' U + iV. A film that multiplies the fields by j_s and
//! j_p multiplies it by j_s j_p*: this and the reflectances are all that a film does to light of any polarisation.

use glam::DVec2;

use super::Polarised;

/// Factors on the coherence of s and p light at one wavelength: complex numbers, as real and imaginary part, for fields as e^i(kz − ωt).
///
/// The directions of s, of p and of the ray are right-handed, before and after. Light that turns back then has the other sign of p over s, and a
/// film mirrors +45° to −45°, up to Brewster's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coherence {
    /// For light that passes, t_s t_p*.
    pub passed: DVec2,
    /// For light that is reflected, r_s r_p*.
    pub reflected: DVec2,
}

impl Coherence {
    /// A film of one material, from Fresnel's amplitude coefficients of its outer face and from sine and cosine of δ/2, but for a sign that both
    /// have in common.
    ///
    /// Airy's amplitudes are r(1 − e^iδ) / (1 − r²e^iδ) and (1 − r²)e^(iδ/2) / (1 − r²e^iδ), so both products have the denominator
    /// (1 − r_s²)(1 − r_p²) + 2(r_s² + r_p²) sin²(δ/2) − i(r_s² − r_p²) sin δ: nothing cancels in thin films.
    pub(super) fn of_plain(face: Polarised, [sine, cosine]: [f64; 2], thickness_nm: f64) -> Self {
        let [s2, p2] = [face.s * face.s, face.p * face.p];
        let (passed, sin2) = ((1.0 - s2) * (1.0 - p2), sine * sine);
        let conjugate = DVec2::new(passed + 2.0 * (s2 + p2) * sin2, 2.0 * (s2 - p2) * sine * cosine);
        let norm2 = conjugate.length_squared();
        if norm2 > 0.0 {
            let inverse = conjugate / norm2;
            Self { passed: passed * inverse, reflected: 4.0 * face.s * face.p * sin2 * inverse }
        } else {
            // 0/0 at grazing: see `Incidence::reflectance` for what is meant.
            Self::at_grazing(f64::from(thickness_nm != 0.0))
        }
    }

    /// Right at grazing, where both polarisations are reflected by the same part, 1 or 0, in the same phase.
    pub(super) fn at_grazing(reflected: f64) -> Self {
        Self { passed: DVec2::new(1.0 - reflected, 0.0), reflected: DVec2::new(reflected, 0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::{
        FilmIndex, Incidence, REFERENCE_NM, coated_coherence, coated_reflectance, reflectance,
    };

    const INDICES: [f64; 3] = [1.0, 1.33, 2.0];
    const COSINES: [f64; 5] = [0.0, 0.05, 0.4, 0.6, 1.0];
    const THICKNESSES_NM: [f64; 5] = [0.0, 0.5, 120.0, 205.0, 1500.0];

    fn for_all_cases(mut check: impl FnMut(f64, f64, f64)) {
        for n in INDICES {
            for cos_theta in COSINES {
                THICKNESSES_NM.iter().for_each(|&thickness_nm| check(n, cos_theta, thickness_nm));
            }
        }
    }

    /// j_s j_p* is as large as the parts of the light say.
    fn assert_belongs_to(coherence: Coherence, film: Polarised) {
        let passed = film.rest();
        assert!((coherence.passed.length_squared() - passed.s * passed.p).abs() < 1e-12, "{coherence:?} {film:?}");
        assert!((coherence.reflected.length_squared() - film.s * film.p).abs() < 1e-12, "{coherence:?} {film:?}");
    }

    #[test]
    fn no_coherence_is_lost() {
        for_all_cases(|n, cos_theta, thickness_nm| {
            let film = reflectance(n, cos_theta, thickness_nm, 550.0);
            assert_belongs_to(Incidence::new(n, cos_theta).coherence(thickness_nm, 550.0), film);
            let film = coated_reflectance(n, 2.0, cos_theta, thickness_nm, 550.0);
            assert_belongs_to(coated_coherence(n, 2.0, cos_theta, thickness_nm, 550.0), film);
        });
    }

    #[test]
    fn without_skins_a_coated_film_is_the_plain_one() {
        for_all_cases(|n, cos_theta, thickness_nm| {
            // Without a surface even grazing light meets no film, unless it has skins.
            if cos_theta == 0.0 && n == 1.0 {
                return;
            }
            let plain = Incidence::new(n, cos_theta).coherence(thickness_nm, 550.0);
            let coated = coated_coherence(n, 0.0, cos_theta, thickness_nm, 550.0);
            assert!(
                plain.passed.distance(coated.passed) < 1e-12,
                "{n} {cos_theta} {thickness_nm}: {plain:?} {coated:?}"
            );
            assert!(plain.reflected.distance(coated.reflected) < 1e-12, "{n} {cos_theta}: {plain:?} {coated:?}");
        });
    }

    #[test]
    fn what_is_no_film_leaves_light_as_it_is() {
        for (n, thickness_nm) in [(1.0, 300.0), (1.33, 0.0)] {
            let none = Incidence::new(n, 0.4).coherence(thickness_nm, 550.0);
            assert_eq!((none.passed, none.reflected), (DVec2::X, DVec2::ZERO));
        }
    }

    #[test]
    fn reflected_p_light_changes_its_sign_at_brewsters_angle() {
        let n = FilmIndex::Water.n(REFERENCE_NM);
        let cos_brewster = 1.0 / (1.0 + n * n).sqrt();
        let reflected = |cos_theta: f64| Incidence::new(n, cos_theta).coherence(150.0, REFERENCE_NM).reflected;
        assert!(reflected(1.1 * cos_brewster).x < -1e-3 && reflected(0.9 * cos_brewster).x > 1e-3);
        assert!(reflected(cos_brewster).length() < 1e-15);
    }
}
