//! What leaves the device: the picture, films, flows and rims.

use super::Renderer;
use crate::{
    gpu::{device::GpuError, readback::Readback, timing::Recorder},
    physics::sphere::CubedSphere,
};

impl Renderer {
    /// View of the finished picture, if there is one.
    #[must_use]
    pub fn picture(&self) -> Option<&wgpu::TextureView> {
        self.products.picture.as_ref().map(|target| &target.view)
    }

    /// Starts to read back the finished picture: rows of RGBA, 8 bits, sRGB.
    #[must_use]
    pub fn read_picture(&self) -> Option<Readback> {
        self.products.picture.as_ref().map(|target| Readback::of_texture(&self.gpu, &target.texture))
    }

    /// Starts to read back the linear picture: rows of RGBA in the format of the requested precision, linear BT.2020.
    #[must_use]
    pub fn read_radiance(&self) -> Option<Readback> {
        self.products.radiance.as_ref().map(|target| Readback::of_texture(&self.gpu, &target.texture))
    }

    /// Starts to read back the thickness that a film shows: f32 in nm, in the order of its grid's cells. `None` for a film without a
    /// field. What has evaporated is not taken away.
    pub fn read_film(&self, film: usize) -> Result<Option<(CubedSphere, Readback)>, GpuError> {
        let Some(Some(film)) = self.products.films.get(film) else { return Ok(None) };
        let mut recorder = Recorder::new(&self.gpu);
        let values = film.field.read(&mut recorder)?;
        recorder.submit(&self.times);
        Ok(Some((film.field.sphere(), Readback::of_buffer(&self.gpu, &values, values.size()))))
    }

    /// Starts to read back the velocity of the flow that moves a film by itself: `vec4f` in rad/s, Cartesian in the film's axes, in padded storage.
    /// `None` for a film that no flow of its own has moved yet.
    #[must_use]
    pub fn read_flow(&self, film: usize) -> Option<(CubedSphere, Readback)> {
        let flow = self.products.films.get(film)?.as_ref()?.flow()?;
        let (sphere, velocity) = (flow.sphere(), flow.velocity());
        Some((sphere, Readback::of_buffer(&self.gpu, velocity, sphere.padded_len() as u64 * 16)))
    }

    /// Starts to read back the rim of the hole in a film that bursts: a [`RimValue`](crate::gpu::passes::open_hole::RimValue) for each meridian.
    #[must_use]
    pub fn read_hole(&self, film: usize) -> Option<Readback> {
        let hole = self.products.holes.get(film)?.as_ref()?;
        Some(Readback::of_buffer(&self.gpu, &hole.rim, hole.rim.size()))
    }
}
