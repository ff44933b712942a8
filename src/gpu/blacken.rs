//! Lets thin film collapse to black film.

use bytemuck::{Pod, Zeroable};

use super::{
    Gpu, GpuError,
    film::{Control, Grid},
    flow_halo::halo_of_thickness,
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};
pub use crate::physics::film::model::BlackeningLaw;

/// See `shaders/pass/blacken.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct BlackenUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// What the tracer departs from, nm.
    pub level_nm: f32,
    /// The same less what has evaporated, nm.
    pub thinned_level_nm: f32,
    /// Thickness of black film, nm.
    pub black_nm: f32,
    /// Thickness below which film collapses, nm.
    pub onset_nm: f32,
    /// Rate of the collapse, 1/tick.
    pub rate: f32,
    pad: [u32; 2],
}

/// The collapse of a film, done at remaps.
pub struct BlackFilm {
    /// The law in force.
    pub law: BlackeningLaw,
    /// What the tracer departs from, nm.
    level_nm: f32,
    /// What each cell gives to each of those around it, nm; before that, means along rows.
    shed: wgpu::Buffer,
    /// The tracer's means around cells, nm.
    means: wgpu::Buffer,
}

impl BlackFilm {
    /// On a film's tracer grid, for a tracer that departs from a level in nm.
    #[must_use]
    pub fn new(gpu: &Gpu, grid: &Grid, law: BlackeningLaw, level_nm: f32) -> Self {
        let [shed, means] = ["shed", "means"].map(|label| grid.field(gpu, label, 4));
        Self { law, level_nm, shed, means }
    }

    fn uniform(&self, recorder: &Recorder<'_>, grid: &Grid) -> wgpu::Buffer {
        let BlackeningLaw { thinned_nm, black_nm, onset_nm, rate } = self.law;
        recorder.gpu.uniform(
            "blacken",
            &BlackenUniform {
                cells: grid.cells,
                level_nm: self.level_nm,
                thinned_level_nm: (f64::from(self.level_nm) - thinned_nm) as f32,
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
        let uniform = self.uniform(recorder, grid);
        run(recorder, "stop_evaporation", &[(0, &uniform), (3, tracer)], control.tracer_groups())
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
        let uniform = self.uniform(recorder, grid);
        let (uniform, block, tracer, means) = ((0, &uniform), (1, &control.block), (2, tracer), (5, &self.means));
        let all = control.tracer_groups();
        run(recorder, "mean_along_rows", &[uniform, tracer, (3, &self.shed)], all)?;
        run(recorder, "mean_along_columns", &[uniform, (2, &self.shed), (3, &self.means)], all)?;
        halo_of_thickness(recorder, grid, &self.means, control.one_group())?;
        run(recorder, "shed", &[uniform, block, tracer, (3, &self.shed), means], all)?;
        halo_of_thickness(recorder, grid, &self.shed, control.one_group())?;
        run(recorder, "gather", &[uniform, block, tracer, (3, to), (4, &self.shed), means], all)?;
        halo_of_thickness(recorder, grid, to, control.one_group())
    }
}

fn run(
    recorder: &mut Recorder<'_>,
    entry: &'static str,
    buffers: &[(u32, &wgpu::Buffer)],
    groups: Groups<'_>,
) -> Result<(), GpuError> {
    let key = ComputeKey { pass: "blacken", entry, constants: vec![] };
    let bound: Vec<_> = buffers.iter().map(|(place, buffer)| (*place, buffer.as_entire_binding())).collect();
    recorder.compute_at("step_field", &key, &bound, groups)
}
