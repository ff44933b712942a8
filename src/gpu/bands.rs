//! Wavelengths on the device: all of a light's for the table's bake, and the fitted few that shaders sum over.

use bytemuck::Zeroable;
use glam::DMat3;

use super::{
    device::Gpu,
    kernel::{Matrix, overrides, shader_struct},
    uniform_buffer::UniformBuffer,
};
use crate::{
    physics::colour::{Band, BandTask, fit_bands, responses},
    plan::{BandsKey, OpticsKey},
};

shader_struct! {
    /// One wavelength: see `shaders/optics/band.wgsl`.
    #[derive(PartialEq)]
    pub struct BandSample {
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

impl From<&Band> for BandSample {
    fn from(band: &Band) -> Self {
        Self {
            response: band.response.into(),
            wavelength_nm: band.wavelength_nm as f32,
            index: band.index as f32,
            gap_nm: f32::MAX,
            width_nm: 0.0,
        }
    }
}

/// All wavelengths of a light.
pub(super) fn spectrum_samples(key: &OpticsKey) -> Vec<BandSample> {
    let optics = key.spectra();
    let wavelengths_nm = optics.weights().wavelengths_nm();
    let lines = key.illuminant.lines().iter().filter(|line| line.power > 0.0).count();
    let sample = |(k, response): (usize, DMat3)| {
        let band = Band { wavelength_nm: wavelengths_nm[k], index: optics.indices()[k], response };
        // The lines come last; the continuous part has a sample each nanometre.
        let is_line = k + lines >= wavelengths_nm.len();
        BandSample { width_nm: if is_line { 0.0 } else { 1.0 }, ..BandSample::from(&band) }
    };
    responses(&optics).into_iter().enumerate().map(sample).collect()
}

/// Fitted wavelengths on the device.
pub struct Bands {
    /// [`MAX_BANDS`] of [`BandSample`], those beyond the count zero. A uniform, for all lanes of a processor read the same one at once.
    pub buffer: UniformBuffer<[BandSample; MAX_BANDS]>,
    /// How many count.
    pub count: u32,
    /// Whether there are films that they are too few for.
    pub thick: bool,
    task: BandTask,
}

/// Room for bands: what `array<Band, ...>` in the passes that sum over them has.
pub const MAX_BANDS: usize = 256;
const _: () = assert!(BandsKey::MAX <= MAX_BANDS);

/// Part of the thickness that bands resolve that may remain of a gap between thicknesses, see `shaders/optics/walls.wgsl`. With more of it the
/// bands no longer resolve three such steps, with less gaps close that fringes still reach across. With bands for 14 µm, the mean error of two
/// walls to 20 and to 30 µm was 0.16 and 0.18 with a third, 0.14 and 0.18 with this, 0.12 and 0.21 with 0.6.
const GAP: f64 = 0.45;

impl Bands {
    /// Fits and sends them.
    #[must_use]
    pub fn fit(gpu: &Gpu, key: &BandsKey) -> Self {
        let resolved_nm = key.resolved_nm();
        let bands = Self::of_count(gpu, &key.optics, key.task(), key.count(), resolved_nm.min(key.range_nm));
        // A light of few lines is summed exactly, whatever the film.
        let is_fitted = key.optics.spectra().indices().len() > key.count();
        Self { thick: resolved_nm < key.range_nm && is_fitted, ..bands }
    }

    /// So many of them, or the light's own wavelengths where those are fewer, that resolve films up to a thickness.
    #[must_use]
    pub fn of_count(gpu: &Gpu, optics: &OpticsKey, task: BandTask, count: usize, resolved_nm: f64) -> Self {
        let bands = fit_bands(&optics.spectra_to(resolved_nm), task, count.min(MAX_BANDS), resolved_nm);
        let mut samples = [BandSample::zeroed(); MAX_BANDS];
        let gap_nm = (GAP * resolved_nm) as f32;
        let sample = |band: &Band| BandSample { gap_nm, ..band.into() };
        samples.iter_mut().zip(&bands).for_each(|(place, band)| *place = sample(band));
        Self { buffer: gpu.uniform("bands", &samples), count: bands.len() as u32, thick: false, task }
    }

    /// The constants of kernels that sum over them.
    #[must_use]
    pub fn overrides(&self) -> BandOverrides {
        BandOverrides { EVERYTHING: self.task == BandTask::Everything, BANDS: self.count, THICK: self.thick }
    }
}

overrides! {
    /// Constants of all kernels that sum over bands.
    pub struct BandOverrides {
        /// Whether bands stand for all that is seen, and no table is read.
        override EVERYTHING: bool;
        /// How many count.
        override BANDS: u32 in [13];
        /// Whether there are films that they are too few for.
        override THICK: bool;
    }
}
