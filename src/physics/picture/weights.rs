//! What is seen of light that arrives along a ray, by wavelength and polarisation.
//!
//! Of light with the fields E_s and E_p, s|E_s|² + p|E_p|² + 2 Re(c E_s E_p*) is seen: three weights, of which the last, for the coherence, is
//! complex. They are Stokes' parameters as a detector has them, I and Q in s and p, U and V in c. Walls that light passes or is reflected by
//! multiply them, a turn of the directions of s and p mixes them (e.g. E. Collett, *Polarized Light*, 1993, ch. 5).

use glam::DVec2;

use crate::physics::optics::{Polarised, SpectralWall};

/// The weights at each wavelength.
pub(super) struct Weights {
    /// The part that is seen of light which is all s, and of light which is all p.
    apart: Vec<Polarised>,
    /// The weight of the coherence, real and imaginary part; empty where it is 0 at all wavelengths.
    coherent: Vec<DVec2>,
}

impl Weights {
    /// The same at a number of wavelengths, without coherence.
    pub fn new(seen: Polarised, wavelengths: usize) -> Self {
        Self { apart: vec![seen; wavelengths], coherent: Vec::new() }
    }

    /// What is seen of unpolarised light at each wavelength.
    pub fn totals(&self) -> impl Iterator<Item = f64> {
        self.apart.iter().map(|seen| seen.s + seen.p)
    }

    /// Leaves a part of all light.
    pub fn dim(&mut self, part: f64) {
        if part < 1.0 {
            self.apart.iter_mut().for_each(|left| *left = Polarised { s: part * left.s, p: part * left.p });
            self.coherent.iter_mut().for_each(|left| *left *= part);
        }
    }

    /// Sets the weight of the coherence to 0.
    pub fn drop_coherence(&mut self) {
        self.coherent.clear();
    }

    /// Turns to the mirror image of the light. The image of p's direction is opposite to the one that makes s, p and ray right-handed.
    pub fn mirror(&mut self) {
        self.coherent.iter_mut().for_each(|left| *left = -*left);
    }

    /// Turns the directions of s and p, of s towards p, by an angle of that cosine and sine.
    pub fn turn(&mut self, cosine: f64, sine: f64) {
        if self.are_unpolarised() {
            return;
        }
        self.coherent.resize(self.apart.len(), DVec2::ZERO);
        let (turned, mixed) = (sine * sine, cosine * sine);
        let kept = 1.0 - turned;
        for (apart, coherent) in self.apart.iter_mut().zip(&mut self.coherent) {
            let Polarised { s, p } = *apart;
            let exchanged = 2.0 * mixed * coherent.x;
            *apart = Polarised { s: kept * s + turned * p + exchanged, p: kept * p + turned * s - exchanged };
            coherent.x = (kept - turned) * coherent.x + mixed * (p - s);
        }
    }

    fn are_unpolarised(&self) -> bool {
        self.coherent.is_empty() && self.apart.iter().all(|seen| seen.s == seen.p)
    }

    /// Takes away what a wall of film reflects, and returns it.
    pub fn take_reflected(&mut self, wall: &SpectralWall, thickness_nm: f64) -> Self {
        let mut apart = wall.reflectances(thickness_nm);
        for (left, reflected) in self.apart.iter_mut().zip(&mut apart) {
            let reflectance = *reflected;
            *reflected = left.times(reflectance);
            *left = left.times(reflectance.rest());
        }
        Self { apart, coherent: self.take_reflected_coherence(wall, thickness_nm) }
    }

    fn take_reflected_coherence(&mut self, wall: &SpectralWall, thickness_nm: f64) -> Vec<DVec2> {
        if self.coherent.is_empty() {
            return Vec::new();
        }
        let film = wall.coherences(thickness_nm);
        // As complex numbers, a vector that "rotates" another is multiplied by it.
        let reflected = self.coherent.iter().zip(&film).map(|(left, film)| left.rotate(film.reflected)).collect();
        self.coherent.iter_mut().zip(&film).for_each(|(left, film)| *left = left.rotate(film.passed));
        reflected
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{
        colour::{FilmOptics, Illuminant},
        optics::FilmIndex,
    };

    fn seen(s: f64, p: f64, coherent: DVec2) -> Weights {
        Weights { apart: vec![Polarised { s, p }], coherent: vec![coherent] }
    }

    fn assert_close(a: &Weights, b: &Weights) {
        let apart = |w: &Weights| DVec2::new(w.apart[0].s, w.apart[0].p);
        let coherent = |w: &Weights| w.coherent.first().copied().unwrap_or_default();
        assert!(apart(a).distance(apart(b)) < 1e-15, "{:?} {:?}", a.apart, b.apart);
        assert!(coherent(a).distance(coherent(b)) < 1e-15, "{:?} {:?}", a.coherent, b.coherent);
    }

    #[test]
    fn a_turn_there_and_back_changes_nothing() {
        for angle in [0.1_f64, 0.7, 1.5, 3.0] {
            let mut turned = seen(0.7, 0.2, DVec2::new(0.1, -0.3));
            turned.turn(angle.cos(), angle.sin());
            assert!((turned.totals().sum::<f64>() - 0.9).abs() < 1e-15);
            turned.turn(angle.cos(), -angle.sin());
            assert_close(&turned, &seen(0.7, 0.2, DVec2::new(0.1, -0.3)));
        }
    }

    /// A polariser along s, turned by φ, is one at −φ: cos²φ, sin²φ and −cos φ sin φ.
    #[test]
    fn a_turned_polariser_stays_one() {
        let (sin, cos) = 0.4_f64.sin_cos();
        let mut turned = Weights::new(Polarised { s: 1.0, p: 0.0 }, 1);
        turned.turn(cos, sin);
        assert_close(&turned, &seen(cos * cos, sin * sin, DVec2::new(-cos * sin, 0.0)));
        turned.mirror();
        assert_close(&turned, &seen(cos * cos, sin * sin, DVec2::new(cos * sin, 0.0)));
    }

    #[test]
    fn light_of_one_state_stays_in_one_at_a_wall() {
        let optics = FilmOptics::new(FilmIndex::Water, &Illuminant::default());
        let mut left = Weights::new(Polarised { s: 1.0, p: 0.0 }, optics.indices().len());
        left.turn(0.6, 0.8);
        let reflected = left.take_reflected(&optics.spectral_wall(0.3), 400.0);
        let all = left.totals().zip(reflected.totals());
        assert!(all.into_iter().all(|(left, reflected)| (left + reflected - 1.0).abs() < 1e-15));
        for weights in [left, reflected] {
            let mut waves = weights.apart.iter().zip(&weights.coherent);
            assert!(waves.all(|(apart, coherent)| (coherent.length_squared() - apart.s * apart.p).abs() < 1e-14));
        }
    }
}
