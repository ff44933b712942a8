//! A published test of transport, run on the device by the passes that move films.

use super::{
    control::ControlBlock,
    device::{Gpu, GpuError},
    film::{Field, Rules},
    passes::{decide_remap::RemapRule, sample_tracer::Gathered, trace_step::Step},
    readback::Readback,
    timing::Recorder,
};
use crate::{
    parallel,
    physics::{
        sphere::CubedSphere,
        transport::{Measured, PERIOD, Quantity, Scheme, Tracer, Wind, WindKind, exact, measure},
    },
};

/// One test.
#[derive(Clone, Debug)]
pub struct Case {
    /// The grid.
    pub grid: CubedSphere,
    /// The wind.
    pub wind: Wind,
    /// The tracer at the start.
    pub tracer: Tracer,
    /// What its values mean.
    pub quantity: Quantity,
    /// The scheme.
    pub scheme: Scheme,
    /// How many of its cells a cell of the map spans along each side.
    pub map_coarsening: u32,
    /// Whether the limiter is on.
    pub limiter: bool,
    /// Steps in one period of the wind.
    pub steps_per_period: u32,
    /// Steps in all.
    pub steps: u64,
    /// Runge-Kutta steps that each step is traced in: see [`Case::traces_per_step`].
    pub traces_per_step: u32,
}

/// Runge-Kutta steps per period of the wind with which following it errs by less than 0.005 in l2 of bells after eight periods. Of the
/// fastest wind each is half a radian.
const TRACES_PER_PERIOD: u32 = 32;

/// Part of a period between two remaps: more would let a test that undoes itself within a period undo the error too. A little less than a
/// quarter, so that none falls on the half period, where answers are asked for.
const REMAP_PERIODS: f64 = 0.23;

/// Steps in one submission, so that none runs long.
const STEPS_PER_SUBMISSION: u64 = 16;

impl Case {
    /// Time after a number of steps.
    #[must_use]
    pub fn time(&self, steps: u64) -> f64 {
        PERIOD * steps as f64 / f64::from(self.steps_per_period)
    }

    /// Runge-Kutta steps that a step of a scheme is traced in. Schemes that keep a map follow the wind through a long step in as many as keep
    /// the trace accurate. The others, which are here to be compared with, take one per step, as they were published.
    #[must_use]
    pub fn traces_per_step(scheme: Scheme, steps_per_period: u32) -> u32 {
        if scheme.keeps_map() { TRACES_PER_PERIOD.div_ceil(steps_per_period.max(1)) } else { 1 }
    }

    /// How the tracer is moved.
    #[must_use]
    pub fn rules(&self) -> Rules {
        let stretches = self.wind.kind() == WindKind::Divergent && self.quantity == Quantity::Density;
        Rules {
            scheme: self.scheme,
            limiter: self.limiter,
            gathered: if stretches { Gathered::LogArea } else { Gathered::Nothing },
            conserved: self.quantity == Quantity::Density,
            remap: RemapRule {
                error_limit_cells: RemapRule::ERROR_LIMIT_CELLS,
                latest_ticks: (REMAP_PERIODS * f64::from(self.steps_per_period)).max(1.0) as u32,
            },
            map_coarsening: self.map_coarsening,
            // To trace steps more finely than the map would gain nothing.
            flow_cells: (self.grid.n() as u32).div_ceil(self.map_coarsening.max(1)),
            cap: None,
            drop_rad: None,
        }
    }

    /// The tracer at the start, in the grid's order.
    #[must_use]
    pub fn initial(&self) -> Vec<f64> {
        parallel::map(self.grid.cells(), |cell| self.tracer.value(self.grid.cell_direction(cell)))
    }

    /// A field with the tracer at the start.
    pub fn seed(&self, gpu: &Gpu) -> Result<Field, GpuError> {
        let mut field = Field::new(gpu, self.grid, self.rules())?;
        field.seed(gpu, |x| self.tracer.value(x));
        Ok(field)
    }

    /// Takes all steps.
    pub fn advance(&self, gpu: &Gpu, field: &mut Field) -> Result<(), GpuError> {
        self.advance_watched(gpu, field, &|_| ())
    }

    /// Takes all steps; `watcher` hears how many more are done.
    pub fn advance_watched(&self, gpu: &Gpu, field: &mut Field, watcher: &dyn Fn(u64)) -> Result<(), GpuError> {
        for first in (0..self.steps).step_by(STEPS_PER_SUBMISSION as usize) {
            let mut recorder = Recorder::new(gpu);
            for step in first..(first + STEPS_PER_SUBMISSION).min(self.steps) {
                let [from, to] = [step, step + 1].map(|step| self.time(step));
                let wind = Step::long_wind(&self.wind, from, to, self.traces_per_step);
                field.advance(&mut recorder, &wind, 1)?;
            }
            recorder.submit(&Default::default());
            gpu.wait()?;
            watcher(STEPS_PER_SUBMISSION.min(self.steps - first));
        }
        Ok(())
    }

    /// Remaps so far.
    pub fn remaps(&self, gpu: &Gpu, field: &Field) -> Result<u64, GpuError> {
        if !self.scheme.keeps_map() {
            return Ok(self.steps);
        }
        let control: Vec<ControlBlock> = bytemuck::pod_collect_to_vec(&field.read_control(gpu).wait(gpu)?);
        Ok(control.iter().map(|block| u64::from(block.remaps)).sum())
    }

    /// Compares values with the exact answer.
    #[must_use]
    pub fn measure(&self, values: &[f64]) -> Measured {
        self.measure_watched(values, &|| ())
    }

    /// Compares values with the exact answer; `watcher` hears of each cell whose answer is found, from any thread.
    #[must_use]
    pub fn measure_watched(&self, values: &[f64], watcher: &(dyn Fn() + Sync)) -> Measured {
        let time = self.time(self.steps);
        // Four times the steps of the run: the exact answer's own error is then far below the scheme's.
        let steps = (4 * self.steps).clamp(400, 100_000) as u32;
        let answer = |cell: usize| {
            let answer = exact(&self.wind, &self.tracer, self.quantity, self.grid.cell_direction(cell), time, steps);
            watcher();
            answer
        };
        let answers = parallel::map(self.grid.cells(), answer);
        measure(self.grid, values, &answers, &self.initial())
    }
}

/// A field's values as they are now, in the grid's order.
pub fn values(gpu: &Gpu, field: &mut Field) -> Result<Vec<f64>, GpuError> {
    let mut recorder = Recorder::new(gpu);
    field.show(&mut recorder, None)?;
    let values = field.read(&mut recorder)?;
    recorder.submit(&Default::default());
    let values: Vec<f32> = bytemuck::pod_collect_to_vec(&Readback::of_buffer(gpu, &values, values.size()).wait(gpu)?);
    Ok(values.into_iter().map(f64::from).collect())
}
