//! Advances the backward flow map by one step.

use bytemuck::{Pod, Zeroable};
use glam::DMat3;

use super::{Gpu, GpuError, pipelines::ComputeKey, timing::Recorder};
use crate::physics::{
    film::{FrozenFlow, FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES},
    transport::{PERIOD, Wind, WindKind},
};

/// Velocity field that a pipeline is specialised for: see `FLOW` in `shaders/film/wind.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum FlowKind {
    /// Waves and vortices, frozen at the middle of the step.
    Prescribed = 0,
    /// A solid turn.
    SolidBody = 1,
    /// The non-divergent deformation wind.
    NonDivergent = 2,
    /// The divergent deformation wind.
    Divergent = 3,
}

/// One moment of a test wind.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct WindMoment {
    /// Sine of the zonal shift 2πt / T.
    pub shift_sin: f32,
    /// Its cosine.
    pub shift_cos: f32,
    /// The reversal factor cos(πt / T).
    pub reversal: f32,
    pad: f32,
}

impl WindMoment {
    fn at(time_s: f64) -> Self {
        let shift = std::f64::consts::TAU * time_s / PERIOD;
        let reversal = (0.5 * shift).cos();
        Self { shift_sin: shift.sin() as f32, shift_cos: shift.cos() as f32, reversal: reversal as f32, pad: 0.0 }
    }
}

/// One step: see `shaders/pass/advance_map.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct StepUniform {
    /// Columns take the test wind's frame to the world; the fourth number of each is padding.
    pub frame: [[f32; 4]; 3],
    /// The wind at the start, middle and end of the backward step.
    pub moments: [WindMoment; 3],
    /// Angular speed of the wind's solid turn.
    pub turn_rad_s: f32,
    /// Length of the step in seconds.
    pub dt_s: f32,
    /// Cells along a panel's edge.
    pub cells: u32,
    /// 1 right after a remap.
    pub map_is_identity: u32,
    /// Waves in use.
    pub waves_count: u32,
    /// Vortices in use.
    pub vortices_count: u32,
    pad: [u32; 2],
    /// Waves; those in use come first.
    pub waves: [FrozenWave; MAX_WAVES],
    /// Vortices; those in use come first.
    pub vortices: [FrozenVortex; MAX_VORTICES],
}

/// One step of the film's motion.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    kind: FlowKind,
    uniform: StepUniform,
}

impl Step {
    /// A step of a prescribed flow, frozen at the middle of the step.
    #[must_use]
    pub fn prescribed(flow: &FrozenFlow, dt_s: f64) -> Self {
        let mut uniform = StepUniform::zeroed();
        uniform.dt_s = dt_s as f32;
        uniform.waves_count = flow.waves.len().min(MAX_WAVES) as u32;
        uniform.vortices_count = flow.vortices.len().min(MAX_VORTICES) as u32;
        for (slot, wave) in uniform.waves.iter_mut().zip(&flow.waves) {
            *slot = *wave;
        }
        for (slot, vortex) in uniform.vortices.iter_mut().zip(&flow.vortices) {
            *slot = *vortex;
        }
        Self { kind: FlowKind::Prescribed, uniform }
    }

    /// A step of a test wind from one time to a later one, in seconds.
    #[must_use]
    pub fn wind(wind: &Wind, from_s: f64, to_s: f64) -> Self {
        let mut uniform = StepUniform::zeroed();
        uniform.frame = columns(wind.frame());
        uniform.moments = [to_s, 0.5 * (from_s + to_s), from_s].map(WindMoment::at);
        uniform.turn_rad_s = (std::f64::consts::TAU / PERIOD) as f32;
        uniform.dt_s = (to_s - from_s) as f32;
        let kind = match wind.kind() {
            WindKind::SolidBody => FlowKind::SolidBody,
            WindKind::NonDivergent => FlowKind::NonDivergent,
            WindKind::Divergent => FlowKind::Divergent,
        };
        Self { kind, uniform }
    }

    /// Whether the flow is smooth enough to be traced on a coarser grid. The winds of the published tests are not: their error is what
    /// is measured.
    #[must_use]
    pub fn may_be_coarse(&self) -> bool {
        self.kind == FlowKind::Prescribed
    }
}

fn columns(matrix: DMat3) -> [[f32; 4]; 3] {
    matrix.to_cols_array_2d().map(|column| [column[0] as f32, column[1] as f32, column[2] as f32, 0.0])
}

/// What a step reads and writes, in padded storage.
pub struct MapBuffers<'a> {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// tan(α) of each cell coordinate, halo included.
    pub tangents: &'a wgpu::Buffer,
    /// The map before the step, with its halo; nothing if it is the identity.
    pub before: Option<&'a wgpu::Buffer>,
    /// The map after it, whose halo is left alone.
    pub after: &'a wgpu::Buffer,
}

/// Records one step.
pub fn advance_map(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    step: &Step,
    map: &MapBuffers<'_>,
) -> Result<(), GpuError> {
    let gpu: &Gpu = recorder.gpu;
    let constants = vec![("FLOW", step.kind as u32)];
    let pipeline = gpu.pipelines.compute(gpu, &ComputeKey { pass: "advance_map", entry: "advance_map", constants })?;
    let uniform = StepUniform { cells: map.cells, map_is_identity: u32::from(map.before.is_none()), ..step.uniform };
    let uniform = gpu.uniform("step", &uniform);
    // Where the map is the identity nothing is read from it, and any buffer of the right kind will do.
    let before = map.before.unwrap_or(map.tangents);
    let bindings = gpu.bind(
        &pipeline.get_bind_group_layout(0),
        &[&uniform, map.tangents, before, map.after].map(wgpu::Buffer::as_entire_binding),
    );
    recorder.dispatch(name, &pipeline, &bindings, [map.cells.div_ceil(64), map.cells, 6]);
    Ok(())
}
