//! The colour of a film: reflectance under an illuminant, integrated over the visible range.

use glam::{DMat3, DVec3};

use super::{ColourWeights, Illuminant, Uplift, Walls, ciede2000, xyz_to_lab};
use crate::physics::optics::{FilmMaterial, SpectralWall, Wall};
use crate::physics::spectra::{SAMPLES, wavelength_nm};

/// The thickest film of water whose fringes samples 1 nm apart resolve at every angle, nm.
const ONE_NM_RESOLVES_NM: f64 = 3000.0;

/// One film under one illuminant, with all that does not change from point to point: what a table of colours is baked from.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmOptics {
    film: FilmMaterial,
    indices: Vec<f64>,
    weights: ColourWeights,
}

impl FilmOptics {
    /// Tabulates the film's index and the illuminant's colour weights.
    pub fn new(film: impl Into<FilmMaterial>, illuminant: &Illuminant) -> Self {
        let (film, weights) = (film.into(), ColourWeights::new(illuminant));
        let indices = weights.wavelengths_nm().iter().map(|nm| film.index.n(*nm)).collect();
        Self { film, indices, weights }
    }

    /// As [`FilmOptics::new`], with as fine a spectrum as the fringes of films up to a thickness need: a sample per nanometre for each 3 µm of
    /// water, or of another liquid with as many fringes.
    ///
    /// Light that grazes a film is resonant in it, and fringes are then much narrower than their distance. With fewer samples some fall between
    /// two: at cos θ from 0.02 to 0.26, CIEDE2000 0.7 for films to 10 µm and 1.6 for films to 30 µm with one sample per nanometre, below 0.03 with
    /// these.
    pub fn resolving(film: impl Into<FilmMaterial>, illuminant: &Illuminant, thickest_nm: f64) -> Self {
        let film = film.into();
        let samples_per_nm = Self::samples_per_nm(&film, thickest_nm);
        Self::sampled(film, illuminant, samples_per_nm)
    }

    /// Samples per nanometre that [`FilmOptics::resolving`] takes.
    pub fn samples_per_nm(film: &FilmMaterial, thickest_nm: f64) -> usize {
        ((thickest_nm * film.fringes_over_water() / ONE_NM_RESOLVES_NM).ceil() as usize).max(1)
    }

    /// As [`FilmOptics::new`], with that many samples per nanometre.
    pub fn sampled(film: impl Into<FilmMaterial>, illuminant: &Illuminant, samples_per_nm: usize) -> Self {
        match samples_per_nm {
            1 => Self::new(film, illuminant),
            _ => Self::new(film, &illuminant.as_lines(samples_per_nm)),
        }
    }

    /// What the film is made of.
    pub fn film(&self) -> &FilmMaterial {
        &self.film
    }

    /// Refractive index of the liquid at each wavelength of the weights.
    pub fn indices(&self) -> &[f64] {
        &self.indices
    }

    /// XYZ weight of each wavelength.
    pub fn weights(&self) -> &ColourWeights {
        &self.weights
    }

    /// How the film meets light at wavelength `i` of the weights.
    pub fn wall(&self, i: usize, cos_theta: f64) -> Wall {
        self.film.wall(self.indices[i], cos_theta, self.weights.wavelengths_nm()[i])
    }

    /// As [`Self::wall`], at all wavelengths of the weights.
    pub fn spectral_wall(&self, cos_theta: f64) -> SpectralWall {
        self.film.spectral_wall(&self.indices, cos_theta, self.weights.wavelengths_nm())
    }

    /// XYZ of white light after reflection, unpolarised; a perfect mirror has Y = 1. `cos_theta` is the cosine of the angle in air, 0 to 1.
    pub fn xyz(&self, cos_theta: f64, walls: Walls) -> DVec3 {
        let reflectances = walls.reflectances(&self.spectral_wall(cos_theta));
        self.weights.integrate(|i| reflectances[i])
    }

    /// As [`FilmOptics::xyz`] of one wall, in light that is all s, and in light that is all p.
    pub fn xyz_of_polarisations(&self, cos_theta: f64, thickness_nm: f64) -> [DVec3; 2] {
        let reflectances = self.spectral_wall(cos_theta).reflectances(thickness_nm);
        [self.weights.integrate(|i| reflectances[i].s), self.weights.integrate(|i| reflectances[i].p)]
    }

    /// The matrix from linear BT.709 light to the XYZ of its reflection; see [`Uplift`].
    pub fn light_matrix(&self, cos_theta: f64, walls: Walls) -> DMat3 {
        Uplift::bt709().light_matrix(&self.weights, &walls.reflectances(&self.spectral_wall(cos_theta)))
    }

    /// What the walls do with unpolarised light, every 5 nm from 360 to 780 nm.
    pub fn spectrum(&self, cos_theta: f64, walls: Walls) -> Vec<SpectrumPoint> {
        let point = |nm: f64| {
            let wall = self.film.wall(self.film.index.n(nm), cos_theta, nm);
            let (reflectance, transmittance) = (walls.reflectance(&wall), walls.transmittance(&wall));
            SpectrumPoint { wavelength_nm: nm, reflectance, transmittance }
        };
        (0..SAMPLES).step_by(5).map(wavelength_nm).map(point).collect()
    }
}

/// One wavelength of a film's spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumPoint {
    /// Wavelength in nm.
    pub wavelength_nm: f64,
    /// Part of unpolarised light that is reflected: see [`Walls::reflectance`].
    pub reflectance: f64,
    /// Part of it that goes straight through: see [`Walls::transmittance`].
    pub transmittance: f64,
}

/// The exposure "M2" at which colour errors are measured: 1 / (walls · Rmax), with Rmax the maximum reflectance of one wall at this angle
/// (n at 589 nm). It brings L* near 100 at most at every angle. 0 for a film of index 1, which shows no colour to expose.
pub fn m2_exposure(film: &FilmMaterial, cos_theta: f64, walls: u32) -> f64 {
    let brightest = f64::from(walls) * film.max_reflectance(cos_theta);
    if brightest > 0.0 { 1.0 / brightest } else { 0.0 }
}

/// CIEDE2000 between two colours of the same film at the same angle, at exposure [`m2_exposure`], without clamping; `white` is the
/// integrated white of the illuminant ([`ColourWeights::white`]) and `walls` the number of walls.
pub fn m2_delta_e(xyz_a: DVec3, xyz_b: DVec3, film: &FilmMaterial, cos_theta: f64, walls: u32, white: DVec3) -> f64 {
    let exposure = m2_exposure(film, cos_theta, walls);
    let lab = |xyz: DVec3| xyz_to_lab(exposure * xyz, white);
    ciede2000(lab(xyz_a), lab(xyz_b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::colour::{BT709, BT2020, srgb_encode};
    use crate::physics::optics::{FilmIndex, Incidence};

    fn water() -> FilmOptics {
        FilmOptics::new(FilmIndex::Water, &Illuminant::default())
    }

    fn one(thickness_nm: f64) -> Walls {
        Walls::One { thickness_nm }
    }

    /// Points as errors are measured: uniform on the projected disk with cosθ ≥ 0.05, thickness uniform to 1500 nm. A rank-1 lattice
    /// (Roberts' R2), so the same on every machine.
    fn points(count: u32) -> impl Iterator<Item = (f64, f64)> {
        let unit = |k: u32, step: f64| (0.5 + f64::from(k) * step).fract();
        let cos_theta = move |k| (0.0025 + 0.9975 * unit(k, 0.7548776662466927)).sqrt();
        (0..count).map(move |k| (cos_theta(k), 1500.0 * unit(k, 0.5698402909980532)))
    }

    fn mean_delta_e(count: u32, other: impl Fn(f64, f64) -> DVec3) -> f64 {
        let (optics, white) = (water(), water().weights().white());
        let error = |(c, d)| m2_delta_e(optics.xyz(c, one(d)), other(c, d), &FilmMaterial::default(), c, 1, white);
        points(count).map(error).sum::<f64>() / f64::from(count)
    }

    /// Beyond the last visible fringe a film shows the mean over a fringe, 2R₁ / (1 + R₁) for each polarisation, near grazing too, where its
    /// fringes are as sharp as a resonator's.
    #[test]
    fn thick_films_tend_to_the_incoherent_limit() {
        let optics = FilmOptics::resolving(FilmIndex::Water, &Illuminant::default(), 30_000.0);
        for cos_theta in [0.02, 0.05, 0.2, 0.5, 1.0] {
            let incidence = |i: usize| Incidence::new(optics.indices()[i], cos_theta);
            let limit = optics.weights().integrate(|i| incidence(i).damped_reflectance(0.0, 500.0, 0.0).mean());
            let error = |nm: u32| (optics.xyz(cos_theta, one(nm.into())) - limit).abs().max_element() / limit.y;
            let worst = |nm: std::ops::Range<u32>| nm.step_by(97).map(error).fold(0.0, f64::max);
            let [visible, thick] = [worst(300..2000), worst(10_000..30_000)];
            eprintln!("measured: cos {cos_theta}: thick films are within {thick:.4} of the incoherent limit");
            assert!(thick <= 0.01 && thick < 0.5 * visible, "{cos_theta}: {visible} {thick}");
        }
    }

    /// Against a spectrum four times as fine; what is left to 3 µm is what sums over whole nanometres are defined with.
    #[test]
    fn spectra_resolve_the_fringes_of_thick_films_near_grazing() {
        let light = Illuminant::default();
        for (thickest_nm, samples_per_nm) in [(3000.0, 4), (10_000.0, 16), (30_000.0, 40)] {
            let [optics, finer] = [
                FilmOptics::resolving(FilmIndex::Water, &light, thickest_nm),
                FilmOptics::new(FilmIndex::Water, &light.as_lines(samples_per_nm)),
            ];
            let white = finer.weights().white();
            // The cosines of the points at large, squeezed towards grazing.
            let error = |(c, d): (f64, f64)| {
                let (cos_theta, walls) = (0.02 + 0.24 * c, one(d / 1500.0 * thickest_nm));
                let colours = [&optics, &finer].map(|optics| optics.xyz(cos_theta, walls));
                m2_delta_e(colours[0], colours[1], optics.film(), cos_theta, 1, white)
            };
            let worst = points(200).map(error).fold(0.0, f64::max);
            eprintln!("measured: grazing films to {thickest_nm} nm are within {worst:.4} of a finer spectrum");
            assert!(worst <= 0.03, "{thickest_nm}: {worst}");
        }
    }

    #[test]
    fn colours_to_check_by_eye() {
        let table: [(f64, [u8; 3]); 12] = [
            (10.0, [0x24, 0x2c, 0x38]),
            (30.0, [0x6c, 0x80, 0x99]),
            (100.0, [0xf8, 0xff, 0xf8]),
            (150.0, [0xf4, 0xc6, 0x54]),
            (180.0, [0xc3, 0x61, 0x42]),
            (205.0, [0x73, 0x00, 0xb7]),
            (240.0, [0x00, 0x98, 0xff]),
            (320.0, [0xf3, 0xfa, 0x54]),
            (410.0, [0xba, 0x2d, 0xfc]),
            (500.0, [0x66, 0xfb, 0x5f]),
            (600.0, [0xff, 0x67, 0xf0]),
            (700.0, [0x00, 0xe8, 0x9d]),
        ];
        for (thickness_nm, expected) in table {
            let linear = BT709.from_xyz() * water().xyz(1.0, one(thickness_nm)) / 0.0783;
            let shown = linear.to_array().map(|c| (255.0 * srgb_encode(c.clamp(0.0, 1.0))).round() as u8);
            // The exposure has three digits, which is half a code value.
            let close = shown.iter().zip(expected).all(|(&shown, expected)| shown.abs_diff(expected) <= 1);
            assert!(close, "{thickness_nm} nm: {shown:02x?} instead of {expected:02x?}");
        }
    }

    #[test]
    fn black_film_comes_out_of_the_formula() {
        assert_eq!(water().xyz(0.7, one(0.0)), DVec3::ZERO);
        assert!(water().xyz(1.0, one(5.0)).y < 5e-4);
        assert_eq!(FilmOptics::new(FilmIndex::Constant(1.0), &Illuminant::default()).xyz(0.3, one(500.0)), DVec3::ZERO);
    }

    #[test]
    fn grazing_light_sees_a_perfect_mirror() {
        let optics = water();
        assert!((optics.xyz(0.0, one(400.0)) - optics.weights().white()).abs().max_element() < 1e-14);
    }

    #[test]
    fn two_walls_reduce_to_one_where_the_other_is_missing() {
        let optics = water();
        let (c, d) = (0.4, 420.0);
        let single = optics.xyz(c, one(d));
        let front_only = Walls::Two { front_nm: d, back_nm: 0.0, exit_nm: 77.0 };
        let back_only = Walls::Two { front_nm: 0.0, back_nm: d, exit_nm: 0.0 };
        for walls in [front_only, back_only] {
            assert!((optics.xyz(c, walls) - single).abs().max_element() < 1e-15);
        }
    }

    #[test]
    fn polarisations_stay_apart_between_the_walls() {
        // At Brewster's angle only s is reflected: R = ½(s + (1 − s)² s), which a product of means would miss.
        let n = 4.0 / 3.0;
        let (cos_theta, nm) = (0.6, 550.0);
        let s = Incidence::new(n, cos_theta).reflectance(300.0, nm).s;
        let walls = Walls::Two { front_nm: 300.0, back_nm: 300.0, exit_nm: 300.0 };
        assert!(
            (walls.reflectance(&FilmMaterial::default().wall(n, cos_theta, nm)) - 0.5 * (s + (1.0 - s).powi(2) * s))
                .abs()
                < 1e-15
        );
    }

    #[test]
    fn white_light_through_the_matrix_is_the_films_colour() {
        let optics = water();
        let walls = Walls::Two { front_nm: 320.0, back_nm: 610.0, exit_nm: 290.0 };
        let through_matrix = optics.light_matrix(0.6, walls) * DVec3::ONE;
        assert!((through_matrix - optics.xyz(0.6, walls)).abs().max_element() < 1e-14);
    }

    #[test]
    fn spectrum_runs_from_360_to_780_every_5_nm() {
        let spectrum = water().spectrum(0.8, one(333.0));
        assert_eq!((spectrum.len(), spectrum[0].wavelength_nm, spectrum[84].wavelength_nm), (85, 360.0, 780.0));
        assert_eq!(
            spectrum[38].reflectance,
            one(333.0).reflectance(&FilmMaterial::default().wall(FilmIndex::Water.n(550.0), 0.8, 550.0))
        );
    }

    #[test]
    fn reflectance_and_transmittance_are_consistent() {
        let optics = water();
        for point in optics.spectrum(0.5, one(333.0)) {
            assert!((point.reflectance + point.transmittance - 1.0).abs() < 1e-15, "{point:?}");
        }
        // Two walls of nearly no back wall are one wall.
        let two = Walls::Two { front_nm: 333.0, back_nm: 0.0, exit_nm: 333.0 };
        assert_eq!(optics.spectrum(0.5, two)[7].transmittance, optics.spectrum(0.5, one(333.0))[7].transmittance);
        // Of what enters, the walls reflect a part to and fro, and some of it leaves by neither way that is counted.
        let equal = Walls::Two { front_nm: 333.0, back_nm: 333.0, exit_nm: 333.0 };
        for point in optics.spectrum(0.2, equal) {
            let lost = 1.0 - point.reflectance - point.transmittance;
            assert!((0.0..=point.reflectance).contains(&lost), "{point:?}");
        }
    }

    #[test]
    fn polarisations_add_up_to_unpolarised_light() {
        let optics = water();
        let [s, p] = optics.xyz_of_polarisations(0.4, 420.0);
        assert!((0.5 * (s + p) - optics.xyz(0.4, one(420.0))).abs().max_element() < 1e-15);
    }

    #[test]
    fn film_colours_stay_inside_bt2020() {
        let (optics, to_bt2020) = (water(), BT2020.from_xyz());
        let lowest = points(4000).map(|(c, d)| (to_bt2020 * optics.xyz(c, one(d))).min_element()).fold(1.0, f64::min);
        assert!(lowest >= 0.0, "{lowest}");
    }

    #[test]
    fn skins_are_nearly_a_thicker_film() {
        let coated = FilmMaterial { skin_nm: 2.0, ..FilmMaterial::default() };
        let (optics, plain) = (FilmOptics::new(coated.clone(), &Illuminant::default()), water());
        let (mut ignored, mut replaced) = (0.0_f64, 0.0_f64);
        let white = plain.weights().white();
        for (c, d) in points(2000) {
            let truth = optics.xyz(c, one(d));
            let error = |nm: f64| m2_delta_e(truth, plain.xyz(c, one(nm)), &coated, c, 1, white);
            (ignored, replaced) = (ignored.max(error(d)), replaced.max(error(coated.equivalent_nm(d))));
        }
        eprintln!("measured: soap skins ignored {ignored:.2}, as an equivalent thickness {replaced:.2}");
        assert!(ignored > 3.0 && replaced < 1.2, "{ignored} {replaced}");
    }

    #[test]
    fn uncertain_physics_costs_what_the_documents_say() {
        // Means 0.44 and 0.64; a mean of 2000 points of this wide distribution is good to a few per cent.
        let mut denser = water();
        denser.indices.iter_mut().for_each(|n| *n += 0.001);
        let index = mean_delta_e(2000, |c, d| denser.xyz(c, one(d)));
        let optics = water();
        let thickness = mean_delta_e(2000, |c, d| optics.xyz(c, one(d + 1.0)));
        assert!((index - 0.44).abs() < 0.03 && (thickness - 0.64).abs() < 0.03, "{index} {thickness}");
    }

    #[test]
    fn m2_exposure_holds_lightness_near_100() {
        assert!((m2_exposure(&FilmMaterial::default(), 1.0, 1) * 0.0784 - 1.0).abs() < 1e-3);
        assert_eq!(m2_exposure(&FilmMaterial::default(), 0.0, 2), 0.5);
        assert_eq!(m2_exposure(&FilmIndex::Constant(1.0).into(), 0.5, 1), 0.0);
        let (optics, white) = (water(), water().weights().white());
        for (c, d) in points(500) {
            let exposed = m2_exposure(&FilmMaterial::default(), c, 1) * optics.xyz(c, one(d));
            assert!(xyz_to_lab(exposed, white).l < 101.0, "cos={c} d={d}");
        }
    }
}
