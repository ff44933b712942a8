//! Wavelengths on the device: all of a light's for the table's bake, and the fitted few that shaders sum over.

use bytemuck::Zeroable;
use glam::DMat3;

use super::{
    device::Gpu,
    kernel::{Matrix, overrides, shader_struct},
    uniform_buffer::UniformBuffer,
};
use crate::{
    physics::{
        colour::{QuadratureTask, QuadratureWavelength, fit_quadrature, responses},
        optics::FilmIndex,
        spectra::{FIRST_NM, SAMPLES},
        sphere::quintic_weights,
    },
    plan::{OpticsKey, QuadratureKey},
};

shader_struct! {
    /// One wavelength: see `shaders/optics/quadrature.wgsl`.
    #[derive(PartialEq)]
    pub struct QuadratureSample {
        /// Matrix from light to its colour.
        pub response: Matrix,
        /// The wavelength.
        pub wavelength_nm: f32,
        /// Refractive index of the film's liquid there.
        pub index: f32,
        /// The widest step from one thickness to the next that is told from wider ones, in nm.
        pub gap_nm: f32,
        /// Width of the part of the spectrum that it is a sample of, in nm; 0 for a line.
        pub width_nm: f32,
    }
}

impl From<&QuadratureWavelength> for QuadratureSample {
    fn from(wavelength: &QuadratureWavelength) -> Self {
        Self {
            response: wavelength.response.into(),
            wavelength_nm: wavelength.wavelength_nm as f32,
            index: wavelength.index as f32,
            gap_nm: f32::MAX,
            width_nm: 0.0,
        }
    }
}

/// Maximum number of wavelengths of a light's whole spectrum: one for each of 471 nanometres, and the lines of built-in lights, which alone have any.
/// The length of `array<QuadratureSample, ...>` in the table's bake.
pub(super) const MAX_SPECTRUM: usize = 512;

/// Distance of the samples of [`every_other`], in nm.
const COARSE_STEP_NM: f64 = 2.0;

/// A continuous spectrum by every other nanometre. What a film reflects between two of them is interpolated between six: that takes smooth
/// reflectances, but no smooth light, of which each nanometre counts with what is reflected there.
fn every_other(continuous: &[QuadratureWavelength], index: &FilmIndex) -> Vec<QuadratureWavelength> {
    const COUNT: usize = SAMPLES.div_ceil(2);
    let mut responses = [DMat3::ZERO; COUNT];
    for QuadratureWavelength { wavelength_nm, response, .. } in continuous {
        let place = (wavelength_nm - FIRST_NM) / COARSE_STEP_NM;
        // The third of six nodes. At the ends all six stay within the spectrum.
        let third = (place as usize).clamp(2, COUNT - 4);
        for (node, weight) in (third - 2..).zip(quintic_weights(place - third as f64)) {
            responses[node] += weight * *response;
        }
    }
    let wavelength = |(k, response): (usize, DMat3)| {
        let wavelength_nm = FIRST_NM + COARSE_STEP_NM * k as f64;
        QuadratureWavelength { wavelength_nm, index: index.n(wavelength_nm), response }
    };
    responses.into_iter().enumerate().map(wavelength).filter(|sample| sample.response != DMat3::ZERO).collect()
}

/// All wavelengths of a light.
pub(super) struct Spectrum<'a> {
    /// One for each nanometre with power.
    continuous: Vec<QuadratureWavelength>,
    lines: Vec<QuadratureWavelength>,
    film: &'a FilmIndex,
}

impl<'a> Spectrum<'a> {
    /// The wavelengths of a film's light.
    pub fn of(key: &'a OpticsKey) -> Self {
        let optics = key.spectra();
        let wavelengths =
            responses(optics.weights()).into_iter().enumerate().map(|(k, response)| QuadratureWavelength {
                wavelength_nm: optics.weights().wavelengths_nm()[k],
                index: optics.indices()[k],
                response,
            });
        let mut continuous: Vec<_> = wavelengths.collect();
        // The lines come last.
        let lines = key.illuminant.lines().iter().filter(|line| line.power > 0.0).count();
        let lines = continuous.split_off(continuous.len() - lines);
        Self { continuous, lines, film: &key.film.index }
    }

    /// A sample for each nanometre, and for each line.
    pub fn samples(&self) -> Vec<QuadratureSample> {
        samples(&self.continuous, 1.0).chain(samples(&self.lines, 0.0)).collect()
    }

    /// The same light by half as many samples, for films whose fringes they resolve.
    pub fn coarse_samples(&self) -> Vec<QuadratureSample> {
        let coarse = every_other(&self.continuous, self.film);
        samples(&coarse, COARSE_STEP_NM as f32).chain(samples(&self.lines, 0.0)).collect()
    }
}

fn samples(wavelengths: &[QuadratureWavelength], width_nm: f32) -> impl Iterator<Item = QuadratureSample> {
    wavelengths.iter().map(move |wavelength| QuadratureSample { width_nm, ..wavelength.into() })
}

/// Fitted wavelengths on the device.
pub struct Quadrature {
    /// [`MAX_WAVELENGTHS`] samples, zero beyond the count. A uniform, for all lanes of a processor read the same one at once.
    pub buffer: UniformBuffer<[QuadratureSample; MAX_WAVELENGTHS]>,
    /// Number of wavelengths. Where it is 0, the first sample has the response to the whole spectrum.
    pub count: u32,
    /// Whether there are films that they are too few for.
    pub thick: bool,
    task: QuadratureTask,
}

/// Room for wavelengths: the length of `array<QuadratureSample, ...>` in the passes that sum over them.
pub const MAX_WAVELENGTHS: usize = 256;
const _: () = assert!(QuadratureKey::MAX <= MAX_WAVELENGTHS);

/// Part of the thickness that wavelengths resolve that may remain of a gap between thicknesses, see `shaders/optics/walls.wgsl`. With more of it the
/// wavelengths no longer resolve three such steps, with less gaps close that fringes still reach across. With wavelengths for 14 µm, the mean error
/// of two walls to 20 and to 30 µm was 0.16 and 0.18 with a third, 0.14 and 0.18 with this, 0.12 and 0.21 with 0.6.
const GAP: f64 = 0.45;

impl Quadrature {
    /// Fits and sends them.
    #[must_use]
    pub fn fit(gpu: &Gpu, key: &QuadratureKey) -> Self {
        if key.from_table { Self::white(gpu, &key.optics) } else { Self::fitted(gpu, key, &key.wavelengths()) }
    }

    /// Sends those that were fitted for a key.
    #[must_use]
    pub fn fitted(gpu: &Gpu, key: &QuadratureKey, wavelengths: &[QuadratureWavelength]) -> Self {
        let resolved_nm = key.resolved_nm();
        let quadrature = Self::upload(gpu, key.task(), wavelengths, key.fitted_nm());
        // A light of few lines is summed exactly, whatever the film.
        let is_fitted = key.optics.spectra().indices().len() > key.count();
        Self { thick: resolved_nm < key.range_nm && is_fitted, ..quadrature }
    }

    /// No wavelengths, but what a mirror shows of white light, in the place of the first.
    fn white(gpu: &Gpu, optics: &OpticsKey) -> Self {
        let mut samples = [QuadratureSample::zeroed(); MAX_WAVELENGTHS];
        samples[0].response =
            responses(optics.spectra().weights()).into_iter().fold(DMat3::ZERO, |sum, response| sum + response).into();
        let buffer = gpu.uniform("quadrature", &samples);
        Self { buffer, count: 0, thick: false, task: QuadratureTask::CrossTerms }
    }

    /// `count` wavelengths, or all wavelengths of the light if they are fewer, that resolve films up to a thickness.
    #[must_use]
    pub fn of_count(gpu: &Gpu, optics: &OpticsKey, task: QuadratureTask, count: usize, resolved_nm: f64) -> Self {
        let count = count.min(MAX_WAVELENGTHS);
        Self::upload(gpu, task, &fit_quadrature(&optics.spectra_to(resolved_nm), task, count, resolved_nm), resolved_nm)
    }

    fn upload(gpu: &Gpu, task: QuadratureTask, quadrature: &[QuadratureWavelength], resolved_nm: f64) -> Self {
        let mut samples = [QuadratureSample::zeroed(); MAX_WAVELENGTHS];
        let gap_nm = (GAP * resolved_nm) as f32;
        let sample = |wavelength: &QuadratureWavelength| QuadratureSample { gap_nm, ..wavelength.into() };
        samples.iter_mut().zip(quadrature).for_each(|(place, wavelength)| *place = sample(wavelength));
        Self { buffer: gpu.uniform("quadrature", &samples), count: quadrature.len() as u32, thick: false, task }
    }

    /// The constants of kernels that sum over them.
    #[must_use]
    pub fn overrides(&self) -> QuadratureOverrides {
        QuadratureOverrides {
            EVERYTHING: self.task == QuadratureTask::Everything,
            WAVELENGTHS: self.count,
            THICK: self.thick,
        }
    }
}

overrides! {
    /// Constants of all kernels that quadrature.
    pub struct QuadratureOverrides {
        /// Whether wavelengths stand for all that is seen, and no table is read.
        override EVERYTHING: bool;
        /// How many count: none where products come from the table's colours.
        override WAVELENGTHS: u32 in [0, 13];
        /// Whether there are films that they are too few for.
        override THICK: bool;
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use glam::DVec3;

    use crate::physics::{
        colour::{BT2020, BUILT_IN, Illuminant, m2_delta_e},
        optics::{FilmMaterial, Incidence},
    };

    #[test]
    fn every_light_has_room() {
        for light in BUILT_IN {
            let illuminant = Arc::new(Illuminant::from(light));
            let samples = Spectrum::of(&OpticsKey { illuminant, film: FilmIndex::Water.into() }).samples();
            assert!((1..=MAX_SPECTRUM).contains(&samples.len()), "{}: {}", light.name, samples.len());
        }
    }

    /// Against each nanometre, for films as thick as every other one is used for.
    #[test]
    fn every_other_nanometre_shows_the_same_films() {
        let film = FilmMaterial::default();
        for light in BUILT_IN {
            let key = OpticsKey { illuminant: Arc::new(Illuminant::from(light)), film: film.clone() };
            let Spectrum { continuous, .. } = Spectrum::of(&key);
            let coarse = every_other(&continuous, &key.film.index);
            let seen = |spectrum: &[QuadratureWavelength], cos_theta: f64, thickness_nm: f64| {
                let reflected = |sample: &QuadratureWavelength| {
                    let incidence = Incidence::new(sample.index, cos_theta);
                    sample.response * incidence.reflectance(thickness_nm, sample.wavelength_nm).mean()
                };
                BT2020.to_xyz() * spectrum.iter().map(reflected).sum::<DMat3>() * DVec3::ONE
            };
            let white = BT2020.to_xyz() * continuous.iter().map(|sample| sample.response).sum::<DMat3>() * DVec3::ONE;
            let mut worst = 0.0_f64;
            for k in 0..400 {
                let (cos_theta, thickness_nm) = (f64::from(k % 20 + 1) / 20.0, 75.0 * (f64::from(k) / 20.0).ceil());
                let [fine, coarse] = [&continuous, &coarse].map(|spectrum| seen(spectrum, cos_theta, thickness_nm));
                worst = worst.max(m2_delta_e(fine, coarse, &film, cos_theta, 1, white));
            }
            eprintln!("measured: {} by every other nanometre: worst CIEDE2000 {worst:.5}", light.name);
            assert!(continuous.is_empty() || worst < 0.005, "{}: {worst}", light.name);
        }
    }
}
