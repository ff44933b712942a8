//! Wavelengths on the device: all of a light's for the table's bake, and the fitted few that shaders sum over.

use bytemuck::{Pod, Zeroable};

use super::{Gpu, draw::matrix};
use crate::{
    physics::colour::{Band, BandTask, FilmOptics, fit_bands, responses},
    plan::BandsKey,
};

/// One wavelength: see `shaders/optics/band.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BandSample {
    /// From light to what is seen of it: columns of a matrix, the fourth number of each is padding.
    pub response: [[f32; 4]; 3],
    /// The wavelength.
    pub wavelength_nm: f32,
    /// Refractive index of the film's liquid there.
    pub index: f32,
    pad: [f32; 2],
}

impl From<&Band> for BandSample {
    fn from(band: &Band) -> Self {
        Self {
            response: matrix(band.response),
            wavelength_nm: band.wavelength_nm as f32,
            index: band.index as f32,
            pad: [0.0; 2],
        }
    }
}

/// All wavelengths of a light.
pub(super) fn spectrum_samples(optics: &FilmOptics) -> Vec<BandSample> {
    let wavelengths = optics.weights().wavelengths_nm().iter().zip(optics.indices());
    let bands = responses(optics).into_iter().zip(wavelengths);
    let band = bands.map(|(response, (nm, n))| Band { wavelength_nm: *nm, index: *n, response });
    band.map(|band| BandSample::from(&band)).collect()
}

/// Fitted wavelengths on the device.
pub struct Bands {
    /// [`MOST_BANDS`] of [`BandSample`], those beyond the count zero. A uniform, for all lanes of a processor read the same one at once.
    pub buffer: wgpu::Buffer,
    /// How many count.
    pub count: u32,
    task: BandTask,
}

/// Room for bands: what `array<Band, ...>` in the passes that sum over them has.
pub const MOST_BANDS: usize = 80;
const _: () = assert!(BandsKey::MOST <= MOST_BANDS);

impl Bands {
    /// Fits and sends them.
    #[must_use]
    pub fn fit(gpu: &Gpu, key: &BandsKey) -> Self {
        let bands = fit_bands(&key.optics.spectra(), key.task(), key.count(), key.range_nm);
        let mut samples = [BandSample::zeroed(); MOST_BANDS];
        samples.iter_mut().zip(&bands).for_each(|(sample, band)| *sample = band.into());
        Self { buffer: gpu.uniform("bands", &samples), count: bands.len() as u32, task: key.task() }
    }
}

/// The constants of all passes that sum over bands.
#[must_use]
pub fn band_constants(bands: &Bands) -> [(&'static str, u32); 2] {
    [("EVERYTHING", u32::from(bands.task == BandTask::Everything)), ("BANDS", bands.count)]
}
