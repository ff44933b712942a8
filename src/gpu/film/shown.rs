//! What pictures read of a film, and what stands in for it where there is none.

use super::{
    super::{
        Gpu, GpuError,
        conserve::{Excess, Sum, conserve, parts},
        read_film::read_film,
        reset_map::reset_map,
        show_film::show_film,
        timing::Recorder,
        trace_step::Step,
    },
    Control, Field, FilmTexture, SHOW,
};

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

impl Field {
    /// Makes the thickness ready to be drawn, a part of a step ahead of the state if one is given. The state stays.
    pub fn show(&mut self, recorder: &mut Recorder<'_>, ahead: Option<&Step>) -> Result<(), GpuError> {
        self.shown_map = usize::from(ahead.is_some());
        if let Some(step) = ahead {
            self.compose(recorder, SHOW, step, self.map_so_far(), 1)?;
        }
        let map = ahead.map_or(self.map_so_far(), |_| Some(&self.map[1]));
        if map.is_none() && self.rules.scheme.keeps_map() {
            // Pictures look through it wherever it leads.
            let grid = self.map_grid();
            reset_map(recorder, SHOW, grid, &self.map[0], grid.padded_groups().into())?;
        }
        self.sample(recorder, SHOW, &self.film, map, [&self.tracer, &self.shown], self.all_cells())?;
        let sum = Sum {
            grid: &self.film,
            field: &self.shown,
            partial_sums: &self.control.partial_sums,
            balance: &self.control.shown_balance,
            control: &self.control.block,
        };
        if self.rules.conserved {
            let groups = [[parts(&self.film), 1, 1].into(), [1; 3].into()];
            conserve(recorder, SHOW, self.target(0), &sum, groups, Excess::Balanced)?;
        }
        show_film(recorder, SHOW, &self.film, sum.balance, &self.shown, &self.texture.view)
    }

    /// What was last shown.
    #[must_use]
    pub fn shown(&self) -> Shown<'_> {
        Shown {
            film: &self.texture.view,
            balance: &self.control.shown_balance,
            map: &self.map[self.shown_map],
            map_cells: self.map_grid().cells,
            tracer: &self.tracer,
            tracer_cells: self.tracer_grid().cells,
        }
    }

    /// Brings what was last shown into a buffer, in the grid's order of cells.
    pub fn read(&self, recorder: &mut Recorder<'_>) -> Result<wgpu::Buffer, GpuError> {
        read_film(recorder, &self.film, &self.texture.view)
    }
}
