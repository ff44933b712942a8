//! What pictures read of a film, and what stands in for it where there is none.

use super::{
    control::{BalanceBlock, Control},
    device::Gpu,
    panel_texture::PanelTexture,
    uniform_buffer::UniformBuffer,
};

/// What pictures read of a film.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// The thickness at the film's cells.
    pub film: &'a PanelTexture,
    /// The correction of what is looked up through the map.
    pub balance: &'a UniformBuffer<BalanceBlock>,
    /// The map that it was sampled through.
    pub map: &'a wgpu::TextureView,
    /// Its cells along a panel's edge.
    pub map_cells: u32,
    /// The tracer that was sampled.
    pub tracer: &'a wgpu::TextureView,
    /// Its cells along a panel's edge.
    pub tracer_cells: u32,
}

/// An empty film for pictures that read none.
pub struct NoFilm {
    film: PanelTexture,
    control: Control,
}

impl NoFilm {
    /// One texel a panel.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            film: PanelTexture::new(gpu, "no film", [1; 2], wgpu::TextureFormat::R32Float),
            control: Control::new(gpu),
        }
    }

    /// What pictures may bind.
    #[must_use]
    pub fn shown(&self) -> Shown<'_> {
        let Self { film, control } = self;
        Shown {
            film,
            balance: &control.shown_balance,
            map: &film.view,
            map_cells: 0,
            tracer: &film.view,
            tracer_cells: 0,
        }
    }
}
