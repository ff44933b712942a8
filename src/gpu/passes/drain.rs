//! Lets film leave at its rim: drainage, and thin patches in place of thicker film.

use bytemuck::Zeroable;

use crate::{
    gpu::{
        control::{Control, ControlBlock},
        device::GpuError,
        grid::{Grid, rim_numbers},
        kernel::{PointSampler, Read, ReadWrite, Texture2dArray, Uniform, kernels, shader_struct},
        timing::{Recorder, STEP_FIELD},
    },
    physics::film::model::{DrainLaw, MAX_RIM_PATCHES},
};

shader_struct! {
    /// See `shaders/pass/drain.wgsl`.
    pub struct PatchValue {
        /// Middle.
        pub middle: [f32; 3],
        /// Thickness over the thickness of the film around.
        pub thickness: f32,
        /// Ticks since it left.
        pub age: u32,
        pad: [u32; 3],
    }
}

shader_struct! {
    /// See `shaders/pass/drain.wgsl`.
    pub struct DrainUniform {
        /// Gravity over the radius, 1/s².
        pub gravity: [f32; 3],
        /// Times it and the cube of a thickness in nm, the flux of drainage in a tick, nm rad.
        pub flux: f32,
        /// Cells along a panel's edge.
        pub cells: u32,
        /// What the tracer departs from less what has evaporated, nm.
        pub remaining_level_nm: f32,
        /// Thickness of black film, which does not drain, nm.
        pub black_nm: f32,
        /// Cosine of the angle from the lowest point within which what drains is in the drop.
        pub drop_cos: f32,
        /// Height of the rim.
        pub rim_z: f32,
        /// The inversion in it.
        pub inversion: f32,
        /// Radius of a patch, radians.
        pub patch_radius: f32,
        /// Patches in use.
        pub patches_count: u32,
        /// Patches; those in use come first.
        pub patches: [PatchValue; MAX_RIM_PATCHES],
    }
}

kernels! {
    pass drain;

    /// What drains along gravity, and what patches leave.
    struct DrainFilm {
        const TAPS: u32 = 4;
        const LIMITER: bool = true;
        @0 drain: Uniform<DrainUniform>;
        @1 tangents: Read<[f32]>;
        @2 control: ReadWrite<ControlBlock>;
        @3 tracer: Texture2dArray;
        @4 drained: ReadWrite<[f32]>;
        @5 point_sampler: PointSampler;
    }
    compute drain_film;
}

impl DrainLaw {
    fn uniform(&self, grid: &Grid, level_nm: f32) -> DrainUniform {
        let [rim_z, inversion] = rim_numbers(grid.cap);
        let mut uniform = DrainUniform {
            gravity: self.gravity.as_vec3().to_array(),
            flux: self.flux as f32,
            cells: grid.cells,
            remaining_level_nm: (f64::from(level_nm) - self.evaporated_nm) as f32,
            black_nm: self.black_nm as f32,
            drop_cos: if self.drop_rad > 0.0 { self.drop_rad.cos() as f32 } else { 2.0 },
            rim_z,
            inversion,
            patch_radius: self.patch_radius as f32,
            patches_count: self.patches.len().min(MAX_RIM_PATCHES) as u32,
            patches: [PatchValue::zeroed(); MAX_RIM_PATCHES],
        };
        for (slot, (middle, thickness, age)) in uniform.patches.iter_mut().zip(&self.patches) {
            let (middle, thickness) = (middle.as_vec3().to_array(), *thickness as f32);
            *slot = PatchValue { middle, thickness, age: *age, ..PatchValue::zeroed() };
        }
        uniform
    }

    /// If a remap is due, lets film leave the tracer, which departs from a level in nm, into another buffer, for the ticks since the last one.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &Grid,
        level_nm: f32,
        control: &Control,
        (tracer, drained): (&wgpu::TextureView, &wgpu::Buffer),
    ) -> Result<(), GpuError> {
        let kernel = DrainFilm {
            drain: &recorder.gpu.uniform("drain", &self.uniform(grid, level_nm)),
            tangents: &grid.tangents,
            control: &control.block,
            tracer,
            drained,
            point_sampler: recorder.gpu.point_sampler(),
        };
        kernel.drain_film(recorder, STEP_FIELD, control.tracer_groups())
    }
}
