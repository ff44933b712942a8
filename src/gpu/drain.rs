//! Lets film leave at its rim: drainage, and thin patches in place of thicker film.

use bytemuck::{Pod, Zeroable};

use super::{
    GpuError,
    film::{Control, Grid, rim_numbers},
    pipelines::ComputeKey,
    timing::Recorder,
};
pub use crate::physics::film::model::DrainLaw;
use crate::physics::film::model::MAX_RIM_PATCHES;

/// See `shaders/pass/drain.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PatchValue {
    /// Middle, and thickness over that of the film around.
    pub middle_thickness: [f32; 4],
    /// Ticks since it left.
    pub age: u32,
    pad: [u32; 3],
}

/// See `shaders/pass/drain.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct DrainUniform {
    /// Gravity over the radius, 1/s².
    pub gravity: [f32; 3],
    /// Times it and the cube of a thickness in nm, the flux of drainage in a tick, nm rad.
    pub flux: f32,
    /// Cells along a panel's edge.
    pub cells: u32,
    /// What the tracer departs from less what has evaporated, nm.
    pub thinned_level_nm: f32,
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

impl DrainLaw {
    fn uniform(&self, grid: &Grid, level_nm: f32) -> DrainUniform {
        let [rim_z, inversion] = rim_numbers(grid.cap);
        let mut uniform = DrainUniform {
            gravity: self.gravity.as_vec3().to_array(),
            flux: self.flux as f32,
            cells: grid.cells,
            thinned_level_nm: (f64::from(level_nm) - self.thinned_nm) as f32,
            black_nm: self.black_nm as f32,
            drop_cos: if self.drop_rad > 0.0 { self.drop_rad.cos() as f32 } else { 2.0 },
            rim_z,
            inversion,
            patch_radius: self.patch_radius as f32,
            patches_count: self.patches.len().min(MAX_RIM_PATCHES) as u32,
            patches: [PatchValue::zeroed(); MAX_RIM_PATCHES],
        };
        for (slot, (middle, thickness, age)) in uniform.patches.iter_mut().zip(&self.patches) {
            slot.middle_thickness = middle.extend(*thickness).as_vec4().to_array();
            slot.age = *age;
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
        [tracer, drained]: [&wgpu::Buffer; 2],
    ) -> Result<(), GpuError> {
        let uniform = recorder.gpu.uniform("drain", &self.uniform(grid, level_nm));
        let bound = [&uniform, &grid.tangents, &control.block, tracer, drained].map(wgpu::Buffer::as_entire_binding);
        let key = ComputeKey { pass: "drain", entry: "drain_film", constants: vec![("TAPS", 4), ("LIMITER", 1)] };
        recorder.compute("step_field", &key, &bound, control.tracer_groups())
    }
}
