//! A film that moves by itself, step by step, under forces of a measurement's own choice.

use glam::DVec3;

use crate::{
    gpu::{
        Gpu, GpuError,
        control::ControlBlock,
        film::{Field, FreeMotion, Rules, Surroundings},
        grid::film_areas,
        passes::decide_remap::RemapRule,
        passes::sample_tracer::Gathered,
        timing::Recorder,
        transport_case::values,
    },
    physics::{
        film::{PrescribedFlow, model::FreePart},
        flow::FlowForces,
        sphere::CubedSphere,
        transport::Scheme,
    },
};

/// How a film is moved by a flow map, from pole to pole.
pub const RULES: Rules = Rules {
    scheme: Scheme::Map,
    limiter: true,
    gathered: Gathered::Nothing,
    conserved: true,
    remap: RemapRule { error_limit_cells: RemapRule::ERROR_LIMIT_CELLS, latest_ticks: 20 },
    map_coarsening: 1,
    flow_cells: 64,
    cap: None,
    drop_rad: None,
};

/// A field of a thickness by direction, in nm, with a number of cells along a panel's edge.
pub fn field(
    gpu: &Gpu,
    cells: usize,
    rules: Rules,
    thickness_nm: impl Fn(DVec3) -> f64 + Sync,
) -> Result<Field, GpuError> {
    let sphere = CubedSphere::new(cells).map_err(|error| GpuError::Refused(error.to_string()))?;
    let mut field = Field::new(gpu, sphere, rules)?;
    field.seed(gpu, thickness_nm);
    Ok(field)
}

/// The film on the device.
pub struct FreeFilm<'a> {
    gpu: &'a Gpu,
    air: PrescribedFlow,
    seconds: f64,
    /// What acts upon it.
    pub forces: FlowForces,
    /// Its thickness.
    pub field: Field,
    /// Its flow.
    pub motion: FreeMotion,
}

impl<'a> FreeFilm<'a> {
    /// The film at rest, in moving air.
    pub fn new(gpu: &'a Gpu, field: Field, forces: FlowForces, air: PrescribedFlow) -> Result<Self, GpuError> {
        let mut recorder = Recorder::new(gpu);
        let motion = FreeMotion::new(&mut recorder, &field)?;
        recorder.submit(&Default::default());
        Ok(Self { gpu, air, seconds: 0.0, forces, field, motion })
    }

    /// Takes steps of some seconds.
    pub fn run(&mut self, steps: u32, step_s: f64) -> Result<(), GpuError> {
        /// Steps in one submission, so that none runs long.
        const BATCH: u32 = 8;
        let (forces, mean_nm) = (self.forces, self.field.mean());
        for first in (0..steps).step_by(BATCH as usize) {
            let mut recorder = Recorder::new(self.gpu);
            for _ in first..steps.min(first + BATCH) {
                let part = FreePart {
                    from_s: self.seconds,
                    dt_s: step_s,
                    forces,
                    pushes: Vec::new(),
                    evaporated_nm: 0.0,
                    black_nm: 1.0,
                    strain: 0.0,
                };
                let around = Surroundings { part: &part, air: &self.air, mean_nm };
                self.motion.advance(&mut recorder, &mut self.field, &around, 1)?;
                self.seconds += step_s;
            }
            recorder.submit(&Default::default());
            self.gpu.wait()?;
        }
        Ok(())
    }

    /// Grid of the thickness.
    pub fn sphere(&self) -> CubedSphere {
        self.field.sphere()
    }

    /// Areas of the grid's cells, of what of them is film, sr.
    pub fn areas(&self) -> Vec<f64> {
        self.field.rules().cap.map_or_else(|| self.sphere().areas(), |cap| film_areas(self.sphere(), cap))
    }

    /// Thickness in nm, in the order of the grid.
    pub fn thickness(&mut self) -> Result<Vec<f64>, GpuError> {
        values(self.gpu, &mut self.field)
    }

    /// The mean thickness of the film, and what the device says has left it, nm of that.
    pub fn liquid(&mut self) -> Result<(f64, f64), GpuError> {
        let (areas, nm) = (self.areas(), self.thickness()?);
        let control: ControlBlock = bytemuck::pod_read_unaligned(&self.field.read_control(self.gpu).wait(self.gpu)?);
        let total: f64 = areas.iter().zip(nm).map(|(area, nm)| area * nm).sum();
        Ok((total / areas.iter().sum::<f64>(), control.drained_nm.into()))
    }
}
