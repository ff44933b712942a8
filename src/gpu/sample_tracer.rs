//! Looks a film's tracer up through its flow map.

use bytemuck::{Pod, Zeroable};

use super::{
    GpuError,
    film::{Grid, rim_numbers},
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};
use crate::physics::{film::Cap, transport::Scheme};

/// What a map's fourth number means: see `GATHERED` in `shaders/pass/sample_tracer.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Gathered {
    /// Nothing: the tracer is a ratio, or the flow does not diverge.
    #[default]
    Nothing = 0,
    /// The logarithm of the area ratio: the tracer is a density in a wind that diverges.
    LogArea = 1,
    /// An amount to be added.
    Amount = 2,
}

/// See `shaders/pass/sample_tracer.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SampleUniform {
    /// Cells along a panel's edge of what is written.
    pub cells: u32,
    /// The same of the map.
    pub map_cells: u32,
    /// The same of the tracer.
    pub tracer_cells: u32,
    /// Height of the rim that the film ends at.
    pub rim_z: f32,
    /// The inversion in it.
    pub inversion: f32,
    /// Cells that the first two by two begin before storage does.
    pub quad_skew: u32,
    pad: [u32; 2],
}

/// What a sampling reads and writes.
pub struct Sampling<'a> {
    /// The scheme, whose stencil it takes.
    pub scheme: Scheme,
    /// Whether it keeps within the range of the cells around.
    pub limiter: bool,
    /// What the map has gathered.
    pub gathered: Gathered,
    /// Where the film ends, if anywhere.
    pub cap: Option<Cap>,
    /// The grid that is written.
    pub grid: &'a Grid,
    /// The map, if there is one.
    pub map: Option<&'a wgpu::Buffer>,
    /// Its cells along a panel's edge.
    pub map_cells: u32,
    /// The tracer, and its cells along a panel's edge.
    pub tracer: (&'a wgpu::Buffer, u32),
    /// The film's control block.
    pub control: &'a wgpu::Buffer,
    /// Where it goes.
    pub to: &'a wgpu::Buffer,
}

impl Sampling<'_> {
    /// Whether it takes two by two cells at once, which share what they need of a map of cells an even number of times as wide.
    #[must_use]
    pub fn takes_quads(&self) -> bool {
        self.map.is_some() && self.cap.is_none() && self.grid.has_quads_in(self.map_cells)
    }
}

/// Records one sampling, with an invocation for each cell or, where it takes those, for two by two.
pub fn sample_tracer(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    sampling: &Sampling<'_>,
    groups: Groups<'_>,
) -> Result<(), GpuError> {
    let Sampling { scheme, limiter, gathered, cap, grid, map, map_cells, .. } = *sampling;
    let (tracer, tracer_cells) = sampling.tracer;
    let [rim_z, inversion] = rim_numbers(cap);
    let quad_skew = grid.quad_skew(map_cells);
    let uniform =
        SampleUniform { cells: grid.cells, map_cells, tracer_cells, rim_z, inversion, quad_skew, pad: [0; 2] };
    let uniform = recorder.gpu.uniform("sample", &uniform);
    let constants = vec![
        ("TAPS", scheme.taps()),
        ("LIMITER", u32::from(limiter)),
        ("GATHERED", gathered as u32),
        ("ON_MAP_GRID", u32::from(grid.cells == map_cells)),
        ("ON_TRACER_GRID", u32::from(grid.cells == tracer_cells)),
        ("HAS_MAP", u32::from(map.is_some())),
        ("HAS_RIM", u32::from(cap.is_some())),
    ];
    let resources = [
        uniform.as_entire_binding(),
        grid.tangents.as_entire_binding(),
        sampling.control.as_entire_binding(),
        // Where there is no map nothing is read from it, and any buffer will do.
        map.unwrap_or(tracer).as_entire_binding(),
        tracer.as_entire_binding(),
        sampling.to.as_entire_binding(),
    ];
    let entry = if sampling.takes_quads() { "sample_quads" } else { "sample_tracer" };
    let key = ComputeKey { pass: "sample_tracer", entry, constants };
    recorder.compute(name, &key, &resources, groups)
}
