//! A flow with a known answer, run on the device by the passes that move films.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;

use super::{
    device::{Gpu, GpuError},
    flow::{Cycles, FlowSolver},
    passes::flow_measure::FlowMeasures,
    readback::Readback,
    timing::Recorder,
};
use crate::{
    parallel,
    physics::{
        flow::{FlowCase, FlowCaseKind, Invariants, Oscillation, fit_oscillation, invariants, relative_l2},
        sphere::CubedSphere,
    },
};

/// How a run compares with the exact flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowOutcome {
    /// Relative error of vorticity; of the stream function for Poisson's equation. For sloshing relative to the largest vorticity of
    /// the swing, for it passes through zero.
    pub l2: f64,
    /// Relative change of kinetic energy since the start; NaN in sloshing, which starts at rest, as are the next two.
    pub energy_drift: f64,
    /// The relative drift of enstrophy.
    pub enstrophy_drift: f64,
    /// The length of the change of angular momentum over its length at the start; NaN where the start is zero but for rounding.
    pub angular_momentum_drift: f64,
    /// The oscillation of the mode, in sloshing.
    pub oscillation: Option<Oscillation>,
    /// Wall time of a step.
    pub wall: Duration,
    /// Process time of a step, all threads.
    pub cpu: Duration,
    /// Dispatches of a step.
    pub dispatches: u64,
}

/// One run of a case.
#[derive(Clone, Copy, Debug)]
pub struct FlowRun {
    /// The case.
    pub case: FlowCase,
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Steps that make the case's span.
    pub steps_per_span: u32,
    /// Spans.
    pub spans: u32,
    /// Multigrid cycles of a step.
    pub cycles: Cycles,
}

/// Vorticity and stream function at one moment, in the grid's order.
struct State {
    zeta: Vec<f64>,
    psi: Vec<f64>,
}

/// Steps in one submission, so that none runs long.
const STEPS_PER_SUBMISSION: u32 = 8;

impl FlowRun {
    /// Runs it.
    pub fn measure(&self, gpu: &Gpu) -> Result<FlowOutcome, GpuError> {
        self.measure_watched(gpu, &|_| ())
    }

    /// Runs it; `watcher` hears how many more steps are done.
    pub fn measure_watched(&self, gpu: &Gpu, watcher: &dyn Fn(u64)) -> Result<FlowOutcome, GpuError> {
        let mut solver = FlowSolver::new(gpu, self.cells);
        solver.cycles = self.cycles;
        self.seed(gpu, &mut solver)?;
        let first = State::read(gpu, &solver)?;
        let mode = self.sample(solver.sphere(), |x| self.case.mode_at(x));
        let (cpu, wall) = (ProcessTime::now(), Instant::now());
        let (samples, dispatches) = self.steps(gpu, &mut solver, &mode, watcher)?;
        let [cpu, wall] = [cpu.elapsed(), wall.elapsed()].map(|time| time / self.all_steps().max(1));
        let last = State::read(gpu, &solver)?;
        let grid = solver.sphere();
        let [before, after] = [&first, &last].map(|state| invariants(grid, &state.zeta, &state.psi));
        let drift = |of: &dyn Fn(&Invariants) -> f64| {
            if self.is_sloshing() { f64::NAN } else { of(&after) / of(&before) - 1.0 }
        };
        Ok(FlowOutcome {
            l2: self.error(grid, &last),
            energy_drift: drift(&|sum| sum.energy),
            enstrophy_drift: drift(&|sum| sum.enstrophy),
            angular_momentum_drift: momentum_drift(&before, &after),
            oscillation: fit_oscillation(&samples, self.dt_s()),
            wall,
            cpu,
            dispatches,
        })
    }

    /// Length of a step, seconds; 1 where the case takes no time.
    fn dt_s(&self) -> f64 {
        let span = self.case.span_s();
        if span > 0.0 { span / f64::from(self.steps_per_span) } else { 1.0 }
    }

    /// Steps in all: none for Poisson's equation.
    #[must_use]
    pub fn all_steps(&self) -> u32 {
        if self.case.kind() == FlowCaseKind::Poisson { 0 } else { self.steps_per_span * self.spans }
    }

    /// How long before the thickness vorticity is given: half a step in sloshing, for the two leapfrog.
    fn lead_s(&self) -> f64 {
        if self.is_sloshing() { 0.5 * self.dt_s() } else { 0.0 }
    }

    fn is_sloshing(&self) -> bool {
        self.case.kind() == FlowCaseKind::Sloshing
    }

    fn sample(&self, grid: CubedSphere, value: impl Fn(glam::DVec3) -> f64 + Sync) -> Vec<f64> {
        parallel::map(grid.cells(), |cell| value(grid.cell_direction(cell)))
    }

    fn seed(&self, gpu: &Gpu, solver: &mut FlowSolver) -> Result<(), GpuError> {
        let single = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect::<Vec<_>>();
        let grid = solver.sphere();
        let thickness = single(self.sample(grid, |x| self.case.log_thickness(x)));
        gpu.upload(solver.log_thickness(), &solver.padded(&thickness));
        let mut recorder = Recorder::new(gpu);
        solver.seed(&mut recorder, &single(self.sample(grid, |x| self.case.zeta(x, -self.lead_s()))))?;
        recorder.submit(&Default::default());
        gpu.wait()
    }

    /// Takes all steps; gives the mode's amplitude after each where it is of interest, and the dispatches of the last one.
    fn steps(
        &self,
        gpu: &Gpu,
        solver: &mut FlowSolver,
        mode: &[f64],
        watcher: &dyn Fn(u64),
    ) -> Result<(Vec<f64>, u64), GpuError> {
        let (mut samples, mut dispatches) = (Vec::new(), 0);
        let batch = if self.is_sloshing() { 1 } else { STEPS_PER_SUBMISSION };
        let areas = solver.sphere().areas();
        for first in (0..self.all_steps()).step_by(batch as usize) {
            let mut recorder = Recorder::new(gpu);
            for _ in first..(first + batch).min(self.all_steps()) {
                let before = recorder.counts.dispatches;
                self.step(&mut recorder, solver)?;
                dispatches = recorder.counts.dispatches - before;
            }
            recorder.submit(&Default::default());
            gpu.wait()?;
            watcher(u64::from(batch.min(self.all_steps() - first)));
            if self.is_sloshing() {
                let zeta = State::read(gpu, solver)?.zeta;
                samples.push(zeta.iter().zip(mode).zip(&areas).map(|((zeta, mode), area)| zeta * mode * area).sum());
            }
        }
        Ok((samples, dispatches))
    }

    fn step(&self, recorder: &mut Recorder<'_>, solver: &mut FlowSolver) -> Result<(), GpuError> {
        solver.step(recorder, self.dt_s(), &self.case.forces())?;
        if self.is_sloshing() {
            solver.carry_log_thickness(recorder, self.dt_s())?;
        }
        Ok(())
    }

    fn error(&self, grid: CubedSphere, last: &State) -> f64 {
        let time = self.dt_s() * f64::from(self.all_steps()) - self.lead_s();
        let zeta = |time: f64| self.sample(grid, |x| self.case.zeta(x, time));
        match self.case.kind() {
            FlowCaseKind::Poisson => relative_l2(grid, &last.psi, &self.sample(grid, |x| self.case.psi(x))),
            FlowCaseKind::Sloshing if self.case.frequency() > 0.0 => {
                // A quarter of a period into the swing vorticity is largest, but for drag.
                let largest = zeta(0.5 * std::f64::consts::PI / self.case.frequency());
                let exact = zeta(time);
                let shifted: Vec<f64> = last
                    .zeta
                    .iter()
                    .zip(&exact)
                    .zip(&largest)
                    .map(|((found, exact), largest)| found - exact + largest)
                    .collect();
                relative_l2(grid, &shifted, &largest)
            }
            _ => relative_l2(grid, &last.zeta, &zeta(time)),
        }
    }
}

fn momentum_drift(before: &Invariants, after: &Invariants) -> f64 {
    // ∫ζx is at most √(8π/3) times the root of enstrophy.
    let start = before.angular_momentum.length();
    let is_rounding = start < 1e-3 * before.enstrophy.sqrt();
    if is_rounding { f64::NAN } else { after.angular_momentum.distance(before.angular_momentum) / start }
}

impl State {
    fn read(gpu: &Gpu, solver: &FlowSolver) -> Result<Self, GpuError> {
        let [zeta, psi] = [solver.zeta(), solver.psi()].map(|buffer| Readback::of_buffer(gpu, buffer, buffer.size()));
        let cells = |read: Readback| -> Result<Vec<f64>, GpuError> {
            let padded: Vec<f32> = bytemuck::pod_collect_to_vec(&read.wait(gpu)?);
            let values: Vec<f64> = solver.inner(&padded).into_iter().map(f64::from).collect();
            // Means mean nothing: the stream function's is free, and vorticity's is taken away by the next step.
            let mean = mean(solver.sphere(), &values);
            Ok(values.into_iter().map(|value| value - mean).collect())
        };
        Ok(Self { zeta: cells(zeta)?, psi: cells(psi)? })
    }
}

fn mean(grid: CubedSphere, values: &[f64]) -> f64 {
    values.iter().zip(grid.areas()).map(|(value, area)| value * area).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Reads what a solver measured.
pub fn read_measures(gpu: &Gpu, solver: &FlowSolver) -> Result<FlowMeasures, GpuError> {
    let bytes = Readback::of_buffer(gpu, solver.measures(), size_of::<FlowMeasures>() as u64).wait(gpu)?;
    Ok(bytemuck::pod_read_unaligned(&bytes))
}
