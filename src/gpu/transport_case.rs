//! A published test of transport, run on the device by the passes that move films.

use rayon::prelude::*;

use super::{Gpu, GpuError, advance_map::Step, film::Field, readback::Readback, timing::Recorder};
use crate::physics::{
    sphere::CubedSphere,
    transport::{Measured, PERIOD, Quantity, Tracer, Wind, exact, measure},
};

/// How often the flow map is remapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// At each step: semi-Lagrangian, bicubic.
    Bicubic,
    /// Five times a period.
    Map,
}

impl Scheme {
    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bicubic => "bicubic",
            Self::Map => "map",
        }
    }

    /// Steps from one remap to the next.
    #[must_use]
    pub fn interval(self, steps_a_period: u32) -> u32 {
        match self {
            Self::Bicubic => 1,
            Self::Map => (steps_a_period / 5).max(1),
        }
    }
}

/// One test.
#[derive(Clone, Debug)]
pub struct Case {
    /// The grid.
    pub grid: CubedSphere,
    /// The wind.
    pub wind: Wind,
    /// The tracer at the start.
    pub tracer: Tracer,
    /// The scheme.
    pub scheme: Scheme,
    /// Steps in one period of the wind.
    pub steps_a_period: u32,
    /// Steps in all.
    pub steps: u64,
}

/// Steps in one submission, so that none runs long.
const STEPS_A_SUBMISSION: u64 = 16;

impl Case {
    /// Time after so many steps.
    #[must_use]
    pub fn time(&self, steps: u64) -> f64 {
        PERIOD * steps as f64 / f64::from(self.steps_a_period)
    }

    /// Remaps in all.
    #[must_use]
    pub fn remaps(&self) -> u64 {
        self.steps / u64::from(self.scheme.interval(self.steps_a_period))
    }

    /// The tracer at the start, in the grid's order.
    #[must_use]
    pub fn initial(&self) -> Vec<f64> {
        (0..self.grid.cells()).into_par_iter().map(|cell| self.tracer.value(self.grid.cell_direction(cell))).collect()
    }

    /// A field with the tracer at the start.
    pub fn seed(&self, gpu: &Gpu) -> Result<Field, GpuError> {
        let mut field = Field::new(gpu, self.grid);
        let mut recorder = Recorder::new(gpu);
        let initial: Vec<f32> = self.initial().iter().map(|value| *value as f32).collect();
        field.seed(&mut recorder, &initial)?;
        recorder.submit(&Default::default());
        gpu.wait()?;
        Ok(field)
    }

    /// Takes all steps.
    pub fn advance(&self, gpu: &Gpu, field: &mut Field) -> Result<(), GpuError> {
        let interval = u64::from(self.scheme.interval(self.steps_a_period));
        for first in (0..self.steps).step_by(STEPS_A_SUBMISSION as usize) {
            let mut recorder = Recorder::new(gpu);
            for step in first..(first + STEPS_A_SUBMISSION).min(self.steps) {
                let wind = Step::wind(&self.wind, self.time(step), self.time(step + 1));
                field.advance(&mut recorder, &wind, (step + 1) % interval == 0)?;
            }
            recorder.submit(&Default::default());
            gpu.wait()?;
        }
        Ok(())
    }

    /// The tracer as it is now, in the grid's order.
    pub fn values(&self, gpu: &Gpu, field: &Field) -> Result<Vec<f64>, GpuError> {
        let mut recorder = Recorder::new(gpu);
        let tracer = field.thickness(&mut recorder, None)?;
        recorder.submit(&Default::default());
        let padded: Vec<f32> =
            bytemuck::pod_collect_to_vec(&Readback::of_buffer(gpu, tracer, tracer.size()).wait(gpu)?);
        Ok(field.inner(&padded).into_iter().map(f64::from).collect())
    }

    /// Compares values with the exact answer for a ratio, which is a density's too where the wind does not diverge.
    #[must_use]
    pub fn measure(&self, values: &[f64]) -> Measured {
        let time = self.time(self.steps);
        // Four times the steps of the run: the exact answer's own error is then far below the scheme's.
        let steps = (4 * self.steps).clamp(400, 100_000) as u32;
        let answer =
            |cell: usize| exact(&self.wind, &self.tracer, Quantity::Ratio, self.grid.cell_direction(cell), time, steps);
        let answers: Vec<f64> = (0..self.grid.cells()).into_par_iter().map(answer).collect();
        measure(self.grid, values, &answers, &self.initial())
    }
}
