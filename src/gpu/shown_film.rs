//! What pictures read of a film, and what stands in for it where there is none.

use super::{
    control::{BalanceBlock, Control},
    device::Gpu,
    uniform_buffer::UniformBuffer,
};

/// What pictures read of a film: a layer a panel, halo included.
pub struct FilmTexture {
    /// The texture.
    pub texture: wgpu::Texture,
    /// All its layers.
    pub view: wgpu::TextureView,
}

impl FilmTexture {
    pub(in crate::gpu) fn new(gpu: &Gpu, side: u32) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("film"),
            size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: gpu.array_layers(6) },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Float,
            usage: wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self { texture, view }
    }
}

/// What pictures read of a film.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// The thickness at the film's cells.
    pub film: &'a wgpu::TextureView,
    /// The texture that it is a view of.
    pub texture: &'a wgpu::Texture,
    /// The correction of what is looked up through the map.
    pub balance: &'a UniformBuffer<BalanceBlock>,
    /// The map that it was sampled through.
    pub map: &'a wgpu::Buffer,
    /// Its cells along a panel's edge.
    pub map_cells: u32,
    /// The tracer that was sampled.
    pub tracer: &'a wgpu::Buffer,
    /// Its cells along a panel's edge.
    pub tracer_cells: u32,
}

/// An empty film for pictures that read none.
pub struct NoFilm {
    film: FilmTexture,
    control: Control,
}

impl NoFilm {
    /// One texel a panel.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        Self { film: FilmTexture::new(gpu, 1), control: Control::new(gpu) }
    }

    /// What pictures may bind.
    #[must_use]
    pub fn shown(&self) -> Shown<'_> {
        let Control { shown_balance, partial_sums, .. } = &self.control;
        Shown {
            film: &self.film.view,
            texture: &self.film.texture,
            balance: shown_balance,
            map: partial_sums,
            map_cells: 0,
            tracer: partial_sums,
            tracer_cells: 0,
        }
    }
}
