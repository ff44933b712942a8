//! A film between two skins: the layers of soap molecules on both faces, about 2 nm of index 1.45 each.

use std::f64::consts::TAU;

use glam::DVec2;

use super::{Coherence, Polarised};

/// Refractive index of a layer of soap molecules.
pub const SKIN_INDEX: f64 = 1.45;

/// Part of the thin film's limit that suits films to 1500 nm best.
const BEST: f64 = 0.98;

/// Reflectance of air | skin | liquid | skin | air, exact: the product of the layers' characteristic matrices (Macleod, *Thin-Film Optical
/// Filters*, ch. 2). `thickness_nm` is total; a film thinner than both skins is skin alone.
pub fn coated_reflectance(n: f64, skin_nm: f64, cos_theta: f64, thickness_nm: f64, wavelength_nm: f64) -> Polarised {
    if cos_theta > 0.0 {
        let [s, p] = coated(n, skin_nm, cos_theta, thickness_nm, wavelength_nm);
        Polarised { s: s.reflectance(), p: p.reflectance() }
    } else {
        Polarised { s: grazing(thickness_nm), p: grazing(thickness_nm) }
    }
}

/// What the same film makes of the coherence of s and p light.
pub fn coated_coherence(n: f64, skin_nm: f64, cos_theta: f64, thickness_nm: f64, wavelength_nm: f64) -> Coherence {
    if cos_theta <= 0.0 {
        return Coherence::at_grazing(grazing(thickness_nm));
    }
    let [s, p] = coated(n, skin_nm, cos_theta, thickness_nm, wavelength_nm);
    let ([r_s, t_s], [r_p, t_p]) = (s.amplitudes(), p.amplitudes());
    // The matrices are for fields along the face, and p light's changes its sign against the ray's when it is reflected.
    Coherence { passed: t_s.rotate(conjugate(t_p)), reflected: -r_s.rotate(conjugate(r_p)) }
}

/// Skin, liquid and skin, for s and for p light.
fn coated(n: f64, skin_nm: f64, cos_theta: f64, thickness_nm: f64, wavelength_nm: f64) -> [Layer; 2] {
    let thickness_nm = thickness_nm.abs();
    let skin_nm = skin_nm.min(0.5 * thickness_nm);
    let [core, skin] = [n, SKIN_INDEX].map(|n| n_cos(n, cos_theta));
    let phase = |n_cos: f64, nm: f64| TAU * n_cos * nm / wavelength_nm;
    let phases = [phase(skin, skin_nm), phase(core, thickness_nm - 2.0 * skin_nm)];
    // Admittances relative to air's.
    [
        Layer::coated([skin / cos_theta, core / cos_theta], phases),
        Layer::coated([SKIN_INDEX.powi(2) * cos_theta / skin, n * n * cos_theta / core], phases),
    ]
}

/// Right at grazing everything that is there reflects everything.
fn grazing(thickness_nm: f64) -> f64 {
    f64::from(thickness_nm != 0.0)
}

/// n cos θ inside a layer, by Snell's law.
fn n_cos(n: f64, cos_theta: f64) -> f64 {
    (n * n - 1.0 + cos_theta * cos_theta).sqrt()
}

/// The characteristic matrix of a layer, or of several: without absorption [[a, i b], [i c, d]] with real a, b, c, d.
struct Layer {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
}

impl Layer {
    fn new(admittance: f64, phase: f64) -> Self {
        let (sin, cos) = phase.sin_cos();
        Self { a: cos, b: sin / admittance, c: sin * admittance, d: cos }
    }

    /// Skin, core, skin.
    fn coated([skin, core]: [f64; 2], [skin_phase, core_phase]: [f64; 2]) -> Self {
        let outer = Self::new(skin, skin_phase);
        outer.then(&Self::new(core, core_phase)).then(&outer)
    }

    fn then(&self, next: &Self) -> Self {
        Self {
            a: self.a * next.a - self.b * next.c,
            b: self.a * next.b + self.b * next.d,
            c: self.c * next.a + self.d * next.c,
            d: self.d * next.d - self.c * next.b,
        }
    }

    /// |r|² in air.
    fn reflectance(&self) -> f64 {
        let Self { a, b, c, d } = *self;
        let reflected = (a - d).powi(2) + (b - c).powi(2);
        reflected / ((a + d).powi(2) + (b + c).powi(2))
    }

    /// Complex r and t in air, of the field along the face: the conjugates of (a − d + i (b − c)) / (a + d + i (b + c)) and of
    /// 2 / (a + d + i (b + c)), for the matrix is for fields as e^i(ωt − kz) and a [`Coherence`] for such as e^i(kz − ωt).
    fn amplitudes(&self) -> [DVec2; 2] {
        let Self { a, b, c, d } = *self;
        let incoming = DVec2::new(a + d, b + c);
        // Of the conjugate.
        let inverse = incoming / incoming.length_squared();
        [DVec2::new(a - d, c - b).rotate(inverse), 2.0 * inverse]
    }
}

/// Of a complex number, as [`DVec2::rotate`] multiplies them.
fn conjugate(number: DVec2) -> DVec2 {
    number.with_y(-number.y)
}

/// What two skins add to the thickness of a plain film of the same liquid that looks nearly like the coated one, nm.
///
/// A film much thinner than the light reflects in proportion to ∫ (n² − 1) dz. That would be 1.67 nm for water with skins of 2 nm; over all
/// films to 1500 nm two per cent less is best: CIEDE2000 0.08 in the mean, 0.7 at most for cos θ ≥ 0.26, 1.1 for cos θ ≥ 0.05.
pub fn equivalent_extra_nm(n: f64, skin_nm: f64) -> f64 {
    if n > 1.0 { BEST * 2.0 * skin_nm * (SKIN_INDEX * SKIN_INDEX - n * n) / (n * n - 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::{FilmIndex, REFERENCE_NM, reflectance as plain};

    #[test]
    fn without_skins_it_is_the_plain_film() {
        for cos_theta in [0.05, 0.6, 1.0] {
            for thickness_nm in [0.0, 3.0, 250.0, 1500.0] {
                let (coated, plain) = (
                    coated_reflectance(1.33, 0.0, cos_theta, thickness_nm, 500.0),
                    plain(1.33, cos_theta, thickness_nm, 500.0),
                );
                assert!((coated.s - plain.s).abs() < 1e-12 && (coated.p - plain.p).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn skins_of_the_liquids_own_index_make_no_difference() {
        let coated = coated_reflectance(SKIN_INDEX, 2.0, 0.4, 321.0, 550.0);
        let plain = plain(SKIN_INDEX, 0.4, 321.0, 550.0);
        assert!((coated.s - plain.s).abs() < 1e-12 && (coated.p - plain.p).abs() < 1e-12);
    }

    #[test]
    fn a_film_thinner_than_its_skins_is_skin() {
        let coated = coated_reflectance(1.33, 2.0, 0.8, 3.0, 550.0);
        assert!((coated.s - plain(SKIN_INDEX, 0.8, 3.0, 550.0).s).abs() < 1e-15);
        assert_eq!(coated_reflectance(1.33, 2.0, 0.8, 0.0, 550.0), Polarised { s: 0.0, p: 0.0 });
        assert_eq!(coated_reflectance(1.33, 2.0, 0.0, 300.0, 550.0), Polarised { s: 1.0, p: 1.0 });
    }

    #[test]
    fn the_equivalent_thickness_is_that_of_thin_films() {
        let n = FilmIndex::Water.n(REFERENCE_NM);
        let extra_nm = equivalent_extra_nm(n, 2.0);
        assert!((extra_nm - 1.64).abs() < 0.01, "{extra_nm}");
        let (coated, plain) = (coated_reflectance(n, 2.0, 1.0, 8.0, 589.0), plain(n, 1.0, 8.0 + extra_nm, 589.0));
        // The two per cent, of a part of the thickness.
        assert!((coated.s / plain.s - 1.0).abs() < 0.01, "{coated:?} {plain:?}");
    }
}
