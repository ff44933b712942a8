//! A film is made ready for pictures.

use super::Field;
use crate::gpu::{
    device::GpuError,
    passes::{
        balance_film::BalanceFilm,
        conserve::{Excess, Sum, conserve, parts},
        read_film::read_film,
        reset_map::ResetMap,
        trace_step::Step,
    },
    shown_film::Shown,
    timing::{Recorder, SHOW_FIELD},
};

impl Field {
    /// Makes the thickness ready to be drawn, a part of a step ahead of the state if one is given. The state stays.
    pub fn show(&mut self, recorder: &mut Recorder<'_>, ahead: Option<&Step>) -> Result<(), GpuError> {
        self.shown_map = usize::from(ahead.is_some());
        if let Some(step) = ahead {
            self.trace_and_compose(recorder, SHOW_FIELD, step, self.map_so_far(), 1)?;
        }
        let map = ahead.map_or(self.map_so_far(), |_| Some(&self.map[1]));
        if map.is_none() && self.rules.scheme.keeps_map() {
            // Pictures look through it wherever it leads.
            let grid = self.map_grid();
            let kernel = ResetMap { tangents: &grid.tangents, map: &self.map[0].view };
            kernel.reset_map(recorder, SHOW_FIELD, grid.padded_groups())?;
        }
        self.sample(recorder, SHOW_FIELD, &self.film, map, (&self.tracer, &self.shown), self.all_cells())?;
        let sum = Sum {
            grid: &self.film,
            field: &self.shown,
            partial_sums: &self.control.partial_sums,
            balance: &self.control.shown_balance,
            control: &self.control.block,
        };
        if self.rules.conserved {
            let groups = [[parts(&self.film), 1, 1].into(), [1; 3].into()];
            conserve(recorder, SHOW_FIELD, self.target(0), &sum, groups, Excess::Balanced)?;
        }
        let kernel =
            BalanceFilm { balance: &self.control.shown_balance, sampled: &self.shown, film: &self.texture.view };
        kernel.balance_film(recorder, SHOW_FIELD, self.film.padded_groups())
    }

    /// What was last shown.
    #[must_use]
    pub fn shown(&self) -> Shown<'_> {
        Shown {
            film: &self.texture,
            balance: &self.control.shown_balance,
            map: &self.map[self.shown_map].view,
            map_cells: self.map_grid().cells,
            tracer: &self.tracer.view,
            tracer_cells: self.tracer_grid().cells,
        }
    }

    /// Copies what was last shown into a buffer, in the grid's order of cells.
    pub fn read(&self, recorder: &mut Recorder<'_>) -> Result<wgpu::Buffer, GpuError> {
        read_film(recorder, &self.film, &self.texture.view)
    }
}
