//! A step that moves the liquid: its trace, the film's map after it, and the remap that may be due.

use bytemuck::Zeroable;

use super::Field;
use crate::gpu::{
    control::BalanceBlock,
    device::GpuError,
    panel_texture::PanelTexture,
    passes::{
        balance_film::BalanceFilm,
        compose_map::{Composition, compose_map},
        conserve::parts,
        correct_error::CorrectError,
        trace_step::{Step, trace_step},
    },
    timing::{Recorder, STEP_FIELD},
};
use crate::physics::film::model::{Operation, PRESCRIBED_STEP};

impl Field {
    /// Moves the liquid by one step that lasts some ticks. Steps back, and those whose times are not numbers, are refused.
    pub fn advance(&mut self, recorder: &mut Recorder<'_>, step: &Step, ticks: u32) -> Result<(), GpuError> {
        PRESCRIBED_STEP.into_iter().try_for_each(|operation| self.run(operation, recorder, step, ticks))
    }

    /// Records one operation of a step that moves the liquid; what only the flow of a free film does is not done here.
    pub(super) fn run(
        &mut self,
        operation: Operation,
        recorder: &mut Recorder<'_>,
        step: &Step,
        ticks: u32,
    ) -> Result<(), GpuError> {
        let keeps_map = self.rules.scheme.keeps_map();
        match operation {
            Operation::TraceStep => {
                if !step.is_forward() {
                    let reason = "a step of the film needs finite times, the later one last";
                    return Err(GpuError::Refused(reason.to_owned()));
                }
                recorder.counts.cells_stepped += self.film.sphere.cells() as u64;
                recorder.counts.state_bytes += self.step_bytes();
                if keeps_map {
                    self.trace(recorder, STEP_FIELD, step, self.map_so_far(), 1)
                } else {
                    self.advance_and_remap(recorder, step)
                }
            }
            Operation::ComposeMap if keeps_map => {
                self.compose(recorder, STEP_FIELD, self.map_so_far(), 1)?;
                self.map.swap(0, 1);
                self.map_is_identity = false;
                Ok(())
            }
            Operation::DecideRemap if keeps_map => {
                self.ticks_since_decision += ticks;
                if self.ticks_since_decision >= self.remap_rule().decision_ticks() {
                    self.remap_if_due(recorder)?;
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Bytes that a step must read and write: the tracer, and the map where there is one.
    fn step_bytes(&self) -> u64 {
        let read = self.map_so_far().map_or(0, PanelTexture::bytes) + self.tracer.bytes();
        let written = if self.rules.scheme.keeps_map() { &self.map[1] } else { &self.tracer };
        read + written.bytes()
    }

    /// Whether the trace of a step is its composition with a map: where there is no map, and the grids are the same.
    fn trace_is_map(&self, before: Option<&PanelTexture>) -> bool {
        before.is_none() && self.flow_grid().cells == self.map_grid().cells
    }

    /// Traces a step that is then composed with a map into one of the two.
    fn trace(
        &self,
        recorder: &mut Recorder<'_>,
        name: &'static str,
        step: &Step,
        before: Option<&PanelTexture>,
        into: usize,
    ) -> Result<(), GpuError> {
        let traced = if self.trace_is_map(before) { &self.map[into] } else { &self.step_map };
        trace_step(recorder, name, step, self.flow_grid(), &traced.view)
    }

    /// Composes the step that was traced with a map, into one of the two.
    fn compose(
        &self,
        recorder: &mut Recorder<'_>,
        name: &'static str,
        before: Option<&PanelTexture>,
        into: usize,
    ) -> Result<(), GpuError> {
        if self.trace_is_map(before) {
            return Ok(());
        }
        let composition = Composition {
            grid: self.map_grid(),
            step_cells: self.flow_grid().cells,
            step_map: &self.step_map.view,
            before: before.map(|map| &map.view),
            control: &self.control.block,
            after: &self.map[into].view,
        };
        compose_map(recorder, name, &composition)
    }

    /// Traces a step, and composes it with a map into one of the two.
    pub(super) fn trace_and_compose(
        &self,
        recorder: &mut Recorder<'_>,
        name: &'static str,
        step: &Step,
        before: Option<&PanelTexture>,
        into: usize,
    ) -> Result<(), GpuError> {
        self.trace(recorder, name, step, before, into)?;
        self.compose(recorder, name, before, into)
    }

    /// One step of a scheme that keeps no map.
    fn advance_and_remap(&mut self, recorder: &mut Recorder<'_>, step: &Step) -> Result<(), GpuError> {
        let grid = &self.film;
        let (all, everywhere) = (grid.padded_groups().into(), self.all_cells());
        self.trace_and_compose(recorder, STEP_FIELD, step, None, 0)?;
        let back = Some(&self.map[0]);
        self.sample(recorder, STEP_FIELD, grid, back, (&self.tracer, &self.sampled), everywhere)?;
        if let Some(corrected) = &self.corrected {
            let as_it_is = &recorder.gpu.uniform("no balance", &BalanceBlock::zeroed());
            let kernel = BalanceFilm { balance: as_it_is, sampled: &self.sampled, film: &corrected.view };
            kernel.balance_film(recorder, STEP_FIELD, grid.padded_groups())?;
            self.trace_and_compose(recorder, STEP_FIELD, &step.reversed(), None, 1)?;
            let forth = Some(&self.map[1]);
            self.sample(recorder, STEP_FIELD, grid, forth, (corrected, &self.shown), everywhere)?;
            let kernel = CorrectError { tracer: &self.tracer.view, returned: &self.shown, corrected: &corrected.view };
            kernel.correct_error(recorder, STEP_FIELD, grid.padded_groups())?;
            self.sample(recorder, STEP_FIELD, grid, back, (corrected, &self.sampled), everywhere)?;
        }
        self.settle(recorder, &self.sampled, [[parts(grid), 1, 1].into(), [1; 3].into(), all])
    }
}
