//! Lets thin film collapse to black film.

use super::flow_halo::halo_of_thickness;
use crate::gpu::{
    control::{Control, ControlBlock},
    device::{Gpu, GpuError},
    grid::Grid,
    kernel::{Read, ReadWrite, Uniform, kernels, shader_struct},
    timing::{Recorder, STEP_FIELD},
    uniform_buffer::UniformBuffer,
};
use crate::physics::film::model::BlackeningLaw;

shader_struct! {
    /// See `shaders/pass/blacken.wgsl`.
    pub struct BlackenUniform {
        /// Cells along a panel's edge.
        pub cells: u32,
        /// What the tracer departs from, nm.
        pub level_nm: f32,
        /// This level less what has evaporated, nm.
        pub remaining_level_nm: f32,
        /// Thickness of black film, nm.
        pub black_nm: f32,
        /// Thickness below which film collapses, nm.
        pub onset_nm: f32,
        /// Rate of the collapse, 1/tick.
        pub rate: f32,
        pad: [u32; 2],
    }
}

kernels! {
    pass blacken;

    /// Gives back to the tracer what did not evaporate from film that was black already.
    struct StopEvaporation {
        @0 blacken: Uniform<BlackenUniform>;
        @3 result: ReadWrite<[f32]>;
    }
    compute stop_evaporation;

    /// Means around cells, along rows and then along columns.
    struct MeanAlong {
        @0 blacken: Uniform<BlackenUniform>;
        @2 tracer: Read<[f32]>;
        @3 result: ReadWrite<[f32]>;
    }
    compute mean_along_rows, mean_along_columns;

    /// What each cell gives to each of those around it.
    struct Redistribute {
        @0 blacken: Uniform<BlackenUniform>;
        @1 control: ReadWrite<ControlBlock>;
        @2 tracer: Read<[f32]>;
        @3 result: ReadWrite<[f32]>;
        @5 means: Read<[f32]>;
    }
    compute redistribute;

    /// What each cell has after it has given and taken.
    struct Gather {
        @0 blacken: Uniform<BlackenUniform>;
        @1 control: ReadWrite<ControlBlock>;
        @2 tracer: Read<[f32]>;
        @3 result: ReadWrite<[f32]>;
        @4 shares_around: Read<[f32]>;
        @5 means: Read<[f32]>;
    }
    compute gather;
}

/// The collapse of a film, done at remaps.
pub struct BlackFilm {
    /// The law in force.
    pub law: BlackeningLaw,
    /// What the tracer departs from, nm.
    level_nm: f32,
    /// What each cell gives to each of those around it, nm; before that, means along rows.
    shares: wgpu::Buffer,
    /// The tracer's means around cells, nm.
    means: wgpu::Buffer,
}

impl BlackFilm {
    /// On a film's tracer grid, for a tracer that departs from a level in nm.
    #[must_use]
    pub fn new(gpu: &Gpu, grid: &Grid, law: BlackeningLaw, level_nm: f32) -> Self {
        let [shares, means] = ["shares", "means"].map(|label| grid.field(gpu, label, 4));
        Self { law, level_nm, shares, means }
    }

    fn uniform(&self, recorder: &Recorder<'_>, grid: &Grid) -> UniformBuffer<BlackenUniform> {
        let BlackeningLaw { evaporated_nm, black_nm, onset_nm, rate } = self.law;
        recorder.gpu.uniform(
            "blacken",
            &BlackenUniform {
                cells: grid.cells,
                level_nm: self.level_nm,
                remaining_level_nm: (f64::from(self.level_nm) - evaporated_nm) as f32,
                black_nm: black_nm as f32,
                onset_nm: onset_nm as f32,
                rate: rate as f32,
                pad: [0; 2],
            },
        )
    }

    /// If a remap is due, gives back to the tracer what did not evaporate from film that was black already.
    pub fn stop_evaporation(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        control: &Control,
        tracer: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let blacken = &self.uniform(recorder, grid);
        StopEvaporation { blacken, result: tracer }.stop_evaporation(recorder, STEP_FIELD, control.tracer_groups())
    }

    /// If a remap is due, lets the tracer collapse for the ticks since the last one, into another buffer.
    pub fn collapse(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        control: &Control,
        tracer: &wgpu::Buffer,
        to: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let (blacken, block) = (&self.uniform(recorder, grid), &control.block);
        let Self { shares, means, .. } = self;
        let (all, one) = (control.tracer_groups(), control.one_group());
        MeanAlong { blacken, tracer, result: shares }.mean_along_rows(recorder, STEP_FIELD, all)?;
        MeanAlong { blacken, tracer: shares, result: means }.mean_along_columns(recorder, STEP_FIELD, all)?;
        halo_of_thickness(recorder, grid, means, one)?;
        Redistribute { blacken, control: block, tracer, result: shares, means }
            .redistribute(recorder, STEP_FIELD, all)?;
        halo_of_thickness(recorder, grid, shares, one)?;
        Gather { blacken, control: block, tracer, result: to, shares_around: shares, means }
            .gather(recorder, STEP_FIELD, all)?;
        halo_of_thickness(recorder, grid, to, one)
    }
}
