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
    /// Thickness from which on the bands are too few to resolve fringes, in nm.
    pub coherent_nm: f32,
    pad: f32,
}

impl From<&Band> for BandSample {
    fn from(band: &Band) -> Self {
        Self {
            response: matrix(band.response),
            wavelength_nm: band.wavelength_nm as f32,
            index: band.index as f32,
            coherent_nm: f32::MAX,
            pad: 0.0,
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
    /// Whether there are films that they are too few for.
    pub thick: bool,
    task: BandTask,
}

/// Room for bands: what `array<Band, ...>` in the passes that sum over them has.
pub const MOST_BANDS: usize = 80;
const _: () = assert!(BandsKey::MOST <= MOST_BANDS);

impl Bands {
    /// Fits and sends them.
    #[must_use]
    pub fn fit(gpu: &Gpu, key: &BandsKey) -> Self {
        let coherent_nm = key.coherent_nm();
        let optics = key.optics.spectra();
        // A light of few lines is summed exactly, whatever the film.
        let thick = coherent_nm < key.range_nm && optics.indices().len() > key.count();
        let bands = fit_bands(&optics, key.task(), key.count(), coherent_nm.min(key.range_nm));
        let mut samples = [BandSample::zeroed(); MOST_BANDS];
        let sample = |band: &Band| BandSample { coherent_nm: coherent_nm as f32, ..band.into() };
        samples.iter_mut().zip(&bands).for_each(|(place, band)| *place = sample(band));
        Self { buffer: gpu.uniform("bands", &samples), count: bands.len() as u32, thick, task: key.task() }
    }
}

/// The constants of all passes that sum over bands.
#[must_use]
pub fn band_constants(bands: &Bands) -> [(&'static str, u32); 3] {
    let everything = u32::from(bands.task == BandTask::Everything);
    [("EVERYTHING", everything), ("BANDS", bands.count), ("THICK", bands.thick.into())]
}
