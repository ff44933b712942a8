//! Lets thin film collapse to black film.

use bytemuck::Zeroable;

use super::flow_halo::halo_of_thickness;
use crate::gpu::{
    control::{Control, ControlBlock},
    device::{Gpu, GpuError},
    grid::Grid,
    kernel::{Read, ReadWrite, Texture2dArray, Uniform, kernels, shader_struct},
    timing::{Recorder, STEP_FIELD},
    uniform_buffer::UniformBuffer,
};
use crate::physics::film::{
    NUCLEATION_NM, Nucleus,
    model::{BlackeningLaw, MAX_NUCLEI},
};

shader_struct! {
    /// See `shaders/pass/blacken.wgsl`.
    pub struct NucleusValue {
        /// Middle.
        pub middle: [f32; 3],
        /// Radius, radians.
        pub radius: f32,
        /// Ticks since it formed.
        pub age: u32,
        pad: [u32; 3],
    }
}

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
        /// Thickness below which film collapses around a nucleus, nm.
        pub nucleation_nm: f32,
        /// Rate of the collapse, 1/tick.
        pub rate: f32,
        /// Nuclei in use.
        pub nuclei_count: u32,
        /// Nuclei; those in use come first.
        pub nuclei: [NucleusValue; MAX_NUCLEI],
    }
}

kernels! {
    pass blacken;

    /// The tracer as it was settled, with what did not evaporate from film that was black already.
    struct StopEvaporation {
        @0 blacken: Uniform<BlackenUniform>;
        @3 result: ReadWrite<[f32]>;
        @6 settled: Texture2dArray;
    }
    compute stop_evaporation;

    /// Means around cells, along rows and then along columns.
    struct MeanAlong {
        @0 blacken: Uniform<BlackenUniform>;
        @2 tracer: Read<[f32]>;
        @3 result: ReadWrite<[f32]>;
    }
    compute mean_along_rows, mean_along_columns;

    /// What each cell has after it has collapsed.
    struct Collapse {
        @0 blacken: Uniform<BlackenUniform>;
        @1 control: ReadWrite<ControlBlock>;
        @2 tracer: Read<[f32]>;
        @3 result: ReadWrite<[f32]>;
        @4 means: Read<[f32]>;
        @5 tangents: Read<[f32]>;
    }
    compute collapse;
}

/// The collapse of a film, done at remaps.
pub struct BlackFilm {
    /// The law in force.
    pub law: BlackeningLaw,
    /// What the tracer departs from, nm.
    level_nm: f32,
    /// The tracer's means along rows, nm; once those are used, what each cell has after it has collapsed.
    scratch: wgpu::Buffer,
    /// The tracer's means around cells, nm.
    means: wgpu::Buffer,
}

impl BlackFilm {
    /// On a film's tracer grid, for a tracer that departs from a level in nm.
    #[must_use]
    pub fn new(gpu: &Gpu, grid: &Grid, law: BlackeningLaw, level_nm: f32) -> Self {
        let [scratch, means] = ["scratch of black film", "means"].map(|label| grid.field(gpu, label, 4));
        Self { law, level_nm, scratch, means }
    }

    fn uniform(&self, recorder: &Recorder<'_>, grid: &Grid) -> UniformBuffer<BlackenUniform> {
        let BlackeningLaw { evaporated_nm, black_nm, onset_nm, rate, nuclei } = &self.law;
        let mut uniform = BlackenUniform {
            cells: grid.cells,
            level_nm: self.level_nm,
            remaining_level_nm: (f64::from(self.level_nm) - evaporated_nm) as f32,
            black_nm: *black_nm as f32,
            onset_nm: *onset_nm as f32,
            nucleation_nm: NUCLEATION_NM as f32,
            rate: *rate as f32,
            nuclei_count: nuclei.len().min(MAX_NUCLEI) as u32,
            nuclei: [NucleusValue::zeroed(); MAX_NUCLEI],
        };
        for (slot, (Nucleus { middle, radius }, age)) in uniform.nuclei.iter_mut().zip(nuclei) {
            let (middle, radius) = (middle.as_vec3().to_array(), *radius as f32);
            *slot = NucleusValue { middle, radius, age: *age, ..NucleusValue::zeroed() };
        }
        recorder.gpu.uniform("blacken", &uniform)
    }

    /// If a remap is due, gives back what did not evaporate from film that was black already: from a tracer into another buffer.
    pub fn stop_evaporation(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        control: &Control,
        (settled, result): (&wgpu::TextureView, &wgpu::Buffer),
    ) -> Result<(), GpuError> {
        let blacken = &self.uniform(recorder, grid);
        StopEvaporation { blacken, result, settled }.stop_evaporation(recorder, STEP_FIELD, control.tracer_groups())
    }

    /// If a remap is due, lets a tracer collapse for the ticks since the last one, and gives what is left of it.
    pub fn collapse(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        control: &Control,
        tracer: &wgpu::Buffer,
    ) -> Result<&wgpu::Buffer, GpuError> {
        let (blacken, block) = (&self.uniform(recorder, grid), &control.block);
        let Self { scratch, means, .. } = self;
        let (all, one) = (control.tracer_groups(), control.one_group());
        MeanAlong { blacken, tracer, result: scratch }.mean_along_rows(recorder, STEP_FIELD, all)?;
        MeanAlong { blacken, tracer: scratch, result: means }.mean_along_columns(recorder, STEP_FIELD, all)?;
        halo_of_thickness(recorder, grid, means, one)?;
        Collapse { blacken, control: block, tracer, result: scratch, means, tangents: &grid.tangents }
            .collapse(recorder, STEP_FIELD, all)?;
        halo_of_thickness(recorder, grid, scratch, one)?;
        Ok(scratch)
    }
}
