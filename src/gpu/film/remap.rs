//! Remaps: the tracer is looked up through the map and stored, with the operations that are only possible then.

use super::Field;
use crate::gpu::{
    control::Control,
    device::{Gpu, GpuError},
    passes::{
        balance_film::BalanceFilm,
        blacken::BlackFilm,
        conserve::{Excess, Sum, conserve},
        decide_remap::{RemapRule, decide_remap},
        diffuse::Diffusion,
        reset_map::ResetMap,
    },
    timing::{Groups, Recorder, STEP_FIELD},
};
use crate::physics::film::model::{BlackeningLaw, DrainLaw, REMAP, RemapOperation};

impl Field {
    /// Sets the diffusivity of the thickness from now on, rad²/s, for ticks of a length in seconds. Schemes without a map do not spread it.
    pub fn diffuse(&mut self, gpu: &Gpu, rad2_s: f64, tick_s: f64) {
        if self.diffusion.as_ref().is_none_or(|diffusion| diffusion.law() != (rad2_s, tick_s)) {
            self.diffusion = Diffusion::new(gpu, self.tracer_grid(), rad2_s, tick_s);
        }
    }

    /// From now on the film collapses to black film by a law, or not at all. Schemes without a map do not.
    pub fn collapse(&mut self, gpu: &Gpu, law: Option<BlackeningLaw>) {
        match (law, &mut self.black) {
            (None, black) => *black = None,
            (Some(law), Some(black)) => black.law = law,
            (Some(law), None) => self.black = Some(BlackFilm::new(gpu, self.tracer_grid(), law, self.level)),
        }
    }

    /// Sets the law by which film leaves from now on, at remaps which are at most a number of ticks apart; or none. Schemes without a map lose none.
    pub fn drain(&mut self, law: Option<(DrainLaw, u32)>) {
        self.has_drained |= law.is_some();
        self.drain = law;
    }

    /// When the map is remapped.
    pub(super) fn remap_rule(&self) -> RemapRule {
        let diffusing = self.diffusion.as_ref().map(Diffusion::latest_ticks);
        let draining = self.drain.as_ref().map(|(_, max_ticks)| *max_ticks);
        let rule = self.rules.remap.no_later_than([diffusing, draining]);
        // Errors count in cells of the film, whatever the cells of the map.
        RemapRule { error_limit_cells: rule.error_limit_cells / self.rules.map_coarsening.max(1) as f32, ..rule }
    }

    /// Decides on a remap, and lets what it is due for happen: diffusion, drainage, black film.
    pub(super) fn remap_if_due(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        let (ticks, rule) = (std::mem::take(&mut self.ticks_since_decision), self.remap_rule());
        let grids = (self.map_grid(), self.tracer_grid());
        decide_remap(recorder, STEP_FIELD, grids, &self.map[0].view, &self.control, (ticks, rule))?;
        let due = &self.control;
        REMAP.into_iter().try_for_each(|operation| match operation {
            RemapOperation::SampleTracer => {
                let tracers = (&self.tracer, &self.sampled);
                let groups = [due.tracer_groups(), due.quad_groups()];
                self.sample(recorder, STEP_FIELD, self.tracer_grid(), self.kept_map(), tracers, groups)
            }
            RemapOperation::Diffuse => self
                .diffusion
                .iter()
                .try_for_each(|diffusion| diffusion.record(recorder, self.tracer_grid(), due, &self.sampled)),
            RemapOperation::Settle => self.settle(recorder, &self.sampled, self.groups_due()),
            RemapOperation::Drain => self.drain.iter().try_for_each(|(law, _)| self.lose(recorder, law)),
            RemapOperation::Blacken => self.black.iter().try_for_each(|black| self.blacken(recorder, black)),
            // A map that is known to be the identity is not read.
            RemapOperation::ResetMap if rule.is_due_after(ticks) => Ok(()),
            RemapOperation::ResetMap => {
                let kernel = ResetMap { tangents: &self.map_grid().tangents, map: &self.map[0].view };
                kernel.reset_map(recorder, STEP_FIELD, due.map_groups())
            }
        })?;
        self.map_is_identity = rule.is_due_after(ticks);
        Ok(())
    }

    /// Workgroups, if a remap is due, of the sum over the tracer, of its end, and of a pass over the tracer.
    fn groups_due(&self) -> [Groups<'_>; 3] {
        let due = &self.control;
        [due.sum_groups(), due.one_group(), due.tracer_groups()]
    }

    /// Lets film leave at the rim, and counts it.
    fn lose(&self, recorder: &mut Recorder<'_>, law: &DrainLaw) -> Result<(), GpuError> {
        law.record(recorder, self.tracer_grid(), self.level, &self.control, (&self.tracer.view, &self.sampled))?;
        self.account(recorder, &self.sampled, self.groups_due(), Excess::Drained)?;
        self.settle(recorder, &self.sampled, self.groups_due())
    }

    /// Lets thin film collapse to black film: evaporation has ended where it is black, and what collapsing film loses goes to the film
    /// as a whole.
    fn blacken(&self, recorder: &mut Recorder<'_>, black: &BlackFilm) -> Result<(), GpuError> {
        let (grid, due) = (self.tracer_grid(), &self.control);
        black.stop_evaporation(recorder, grid, due, (&self.tracer.view, &self.sampled))?;
        // Each account rounds: it is not taken where nothing can have changed.
        if black.law.evaporated_nm > 0.0 {
            self.account(recorder, &self.sampled, self.groups_due(), Excess::Spared)?;
        }
        let collapsed = black.collapse(recorder, grid, due, &self.sampled)?;
        self.settle(recorder, collapsed, self.groups_due())
    }

    /// Makes a field the tracer, with its liquid restored.
    pub(super) fn settle(
        &self,
        recorder: &mut Recorder<'_>,
        sampled: &wgpu::Buffer,
        groups: [Groups<'_>; 3],
    ) -> Result<(), GpuError> {
        if self.rules.conserved {
            self.account(recorder, sampled, groups, Excess::Balanced)?;
        }
        let kernel = BalanceFilm { balance: &self.control.tracer_balance, sampled, film: &self.tracer.view };
        kernel.balance_film(recorder, STEP_FIELD, groups[2])
    }

    /// Sums the excess of a field on the tracer's grid, and corrects it as told.
    fn account(
        &self,
        recorder: &mut Recorder<'_>,
        field: &wgpu::Buffer,
        [sum_groups, one_group, _]: [Groups<'_>; 3],
        excess: Excess,
    ) -> Result<(), GpuError> {
        let Control { partial_sums, tracer_balance: balance, block: control, .. } = &self.control;
        let sum = Sum { grid: self.tracer_grid(), field, partial_sums, balance, control };
        conserve(recorder, STEP_FIELD, self.target(1), &sum, [sum_groups, one_group], excess)
    }
}
