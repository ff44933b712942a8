//! What pictures read of a film, and what stands in for it where there is none.

use super::{super::Gpu, Control, FilmTexture};

/// What pictures read of a film.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// The thickness at the film's cells.
    pub film: &'a wgpu::TextureView,
    /// The correction of what is looked up through the map.
    pub balance: &'a wgpu::Buffer,
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
            balance: shown_balance,
            map: partial_sums,
            map_cells: 0,
            tracer: partial_sums,
            tracer_cells: 0,
        }
    }
}
