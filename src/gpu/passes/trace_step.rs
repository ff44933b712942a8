//! Traces one step of a film's motion back, from each cell to where its liquid was.

use bytemuck::Zeroable;

use super::trace_flow::{SolvedUniform, TraceFlow};
use crate::{
    gpu::{
        device::GpuError,
        grid::Grid,
        kernel::{Matrix, Read, Rgba32Float, Uniform, Written2dArray, choices, kernels, shader_struct, shader_view},
        timing::Recorder,
    },
    physics::{
        film::{FrozenVortex, FrozenWave, MAX_VORTICES, MAX_WAVES, PrescribedFlow},
        transport::{PERIOD, Wind, WindKind},
    },
};

/// Traces that one step of a test wind can be made of.
pub const MAX_TRACES: usize = 16;

choices! {
    /// Velocity field that a pipeline is specialised for: see `FLOW` in `shaders/film/wind.wgsl`.
    pub enum FlowKind {
        /// Waves and vortices.
        Prescribed = 0,
        /// A solid turn.
        SolidBody = 1,
        /// The non-divergent deformation wind.
        NonDivergent = 2,
        /// The divergent deformation wind.
        Divergent = 3,
    }
}

shader_view! { FrozenWave { k, phase, amplitude, padding } }
shader_view! { FrozenVortex { center, sharpness, strength, padding } }

shader_struct! {
    /// One moment of a test wind.
    #[derive(Default)]
    pub struct WindMoment {
        /// Sine of the zonal shift 2πt / T.
        pub shift_sin: f32,
        /// Its cosine.
        pub shift_cos: f32,
        /// The reversal factor cos(πt / T).
        pub reversal: f32,
        pad: f32,
    }
}

impl WindMoment {
    fn at(time_s: f64) -> Self {
        let shift = std::f64::consts::TAU * time_s / PERIOD;
        let reversal = (0.5 * shift).cos();
        Self { shift_sin: shift.sin() as f32, shift_cos: shift.cos() as f32, reversal: reversal as f32, pad: 0.0 }
    }
}

shader_struct! {
    /// One step: see `shaders/pass/trace_step.wgsl`.
    pub struct StepUniform {
        /// Takes the test wind's frame to the world.
        pub frame: Matrix,
        /// The wind at the start, middle and end of each backward trace, the end of one being the start of the next.
        pub moments: [WindMoment; 2 * MAX_TRACES + 1],
        /// Angular speed of the wind's solid turn.
        pub turn_rad_s: f32,
        /// Length of the step in seconds.
        pub dt_s: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// Waves in use.
        pub waves_count: u32,
        /// Vortices in use.
        pub vortices_count: u32,
        /// Runge-Kutta steps that the step is traced in; one where waves or vortices are in use.
        pub traces: u32,
        pad: [u32; 2],
        /// Waves at the first three moments; those in use come first.
        pub waves: [[FrozenWave; MAX_WAVES]; 3],
        /// Vortices at the same three moments; those in use come first.
        pub vortices: [[FrozenVortex; MAX_VORTICES]; 3],
    }
}

kernels! {
    pass trace_step;

    /// From each cell to where its liquid was, in a flow in closed form.
    struct TraceStep {
        override FLOW: FlowKind;
        @0 step: Uniform<StepUniform>;
        @1 tangents: Read<[f32]>;
        @2 step_map: Written2dArray<Rgba32Float>;
    }
    compute trace_step;
}

/// One step of a film's motion, from a time to a later one. From a time to an earlier one it is the way back.
#[derive(Clone, Debug)]
pub enum Step {
    /// In a flow in closed form.
    Closed(FlowKind, Box<StepUniform>),
    /// In a solver's velocity on the grid that steps are traced on, held constant.
    Solved {
        /// The velocity of all of the solver's films.
        velocity: wgpu::Buffer,
        /// Place of the film among them.
        film: u32,
        /// For how many seconds.
        dt_s: f64,
    },
}

impl Step {
    /// A step of a prescribed flow.
    #[must_use]
    pub fn prescribed(flow: &PrescribedFlow, from_s: f64, to_s: f64) -> Self {
        let mut uniform = Self::empty(from_s, to_s);
        uniform.waves_count = flow.waves().len().min(MAX_WAVES) as u32;
        uniform.vortices_count = flow.vortices().len().min(MAX_VORTICES) as u32;
        for (moment, time_s) in moments(from_s, to_s).into_iter().enumerate() {
            let frozen = flow.frozen_at(time_s);
            for (slot, wave) in uniform.waves[moment].iter_mut().zip(&frozen.waves) {
                *slot = *wave;
            }
            for (slot, vortex) in uniform.vortices[moment].iter_mut().zip(&frozen.vortices) {
                *slot = *vortex;
            }
        }
        Self::Closed(FlowKind::Prescribed, uniform)
    }

    /// A step of a test wind.
    #[must_use]
    pub fn wind(wind: &Wind, from_s: f64, to_s: f64) -> Self {
        Self::long_wind(wind, from_s, to_s, 1)
    }

    /// A step of a test wind that may be so long that it is traced in several, [`MAX_TRACES`] at most: the wind is known at all times.
    #[must_use]
    pub fn long_wind(wind: &Wind, from_s: f64, to_s: f64, traces: u32) -> Self {
        let mut uniform = Self::empty(from_s, to_s);
        uniform.traces = traces.clamp(1, MAX_TRACES as u32);
        uniform.frame = wind.frame().into();
        let end_s = |trace: usize| to_s + (from_s - to_s) * trace as f64 / f64::from(uniform.traces);
        for trace in 0..uniform.traces as usize {
            let times_s = moments(end_s(trace + 1), end_s(trace));
            uniform.moments[2 * trace..][..3].copy_from_slice(&times_s.map(WindMoment::at));
        }
        uniform.turn_rad_s = (std::f64::consts::TAU / PERIOD) as f32;
        let kind = match wind.kind() {
            WindKind::SolidBody => FlowKind::SolidBody,
            WindKind::NonDivergent => FlowKind::NonDivergent,
            WindKind::Divergent => FlowKind::Divergent,
        };
        Self::Closed(kind, uniform)
    }

    fn empty(from_s: f64, to_s: f64) -> Box<StepUniform> {
        let mut uniform = Box::new(StepUniform::zeroed());
        uniform.dt_s = (to_s - from_s) as f32;
        uniform.traces = 1;
        uniform
    }

    /// The way back: where the liquid at a place when the step begins will be when it ends.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match self {
            Self::Closed(kind, uniform) => {
                let mut uniform = uniform.clone();
                uniform.dt_s = -uniform.dt_s;
                uniform.moments[..=2 * uniform.traces as usize].reverse();
                uniform.waves.reverse();
                uniform.vortices.reverse();
                Self::Closed(*kind, uniform)
            }
            Self::Solved { velocity, film, dt_s } => {
                Self::Solved { velocity: velocity.clone(), film: *film, dt_s: -dt_s }
            }
        }
    }

    /// Whether its times are numbers that a device can work with, and it does not go back.
    #[must_use]
    pub fn is_forward(&self) -> bool {
        match self {
            Self::Closed(_, uniform) => {
                let moments_are_finite = uniform.moments.iter().all(|moment| moment.reversal.is_finite());
                uniform.dt_s.is_finite() && uniform.dt_s >= 0.0 && moments_are_finite
            }
            Self::Solved { dt_s, .. } => dt_s.is_finite() && *dt_s >= 0.0,
        }
    }
}

/// Start, middle and end of a backward step.
fn moments(from_s: f64, to_s: f64) -> [f64; 3] {
    [to_s, 0.5 * (from_s + to_s), from_s]
}

/// Records the trace of one step on a grid.
pub fn trace_step(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    step: &Step,
    grid: &Grid,
    step_map: &wgpu::TextureView,
) -> Result<(), GpuError> {
    let (tangents, groups) = (&grid.tangents, grid.padded_groups());
    match step {
        Step::Closed(kind, uniform) => {
            let step = &recorder.gpu.uniform("step", &StepUniform { cells: grid.cells, ..**uniform });
            TraceStep { FLOW: *kind, step, tangents, step_map }.trace_step(recorder, name, groups)
        }
        Step::Solved { velocity, film, dt_s } => {
            let uniform = SolvedUniform { dt_s: *dt_s as f32, cells: grid.cells, film: *film, padding: 0 };
            let solved = &recorder.gpu.uniform("solved step", &uniform);
            TraceFlow { solved, tangents, velocity, step_map }.trace_flow(recorder, name, groups)
        }
    }
}
