//! Looks a film's tracer up through its flow map.

use crate::{
    gpu::{
        control::ControlBlock,
        device::GpuError,
        grid::{Grid, rim_numbers},
        kernel::{PointSampler, Read, ReadWrite, Texture2dArray, Uniform, choices, kernels, shader_struct},
        timing::{Groups, Recorder},
    },
    physics::{film::Cap, transport::Scheme},
};

choices! {
    /// What a map's fourth number means: see `GATHERED` in `shaders/pass/sample_tracer.wgsl`.
    #[derive(Default)]
    pub enum Gathered {
        /// Nothing: the tracer is a ratio, or the flow does not diverge.
        #[default]
        Nothing = 0,
        /// The logarithm of the area ratio: the tracer is a density in a wind that diverges.
        LogArea = 1,
        /// An amount to be added.
        Amount = 2,
    }
}

shader_struct! {
    /// See `shaders/pass/sample_tracer.wgsl`.
    pub struct SampleUniform {
        /// Cells along a panel's edge of what is written.
        pub cells: u32,
        /// Cells along a panel's edge of the map.
        pub map_cells: u32,
        /// Cells along a panel's edge of the tracer.
        pub tracer_cells: u32,
        /// Height of the rim that the film ends at.
        pub rim_z: f32,
        /// The inversion in it.
        pub inversion: f32,
        /// Cells that the first two by two begin before storage does.
        pub quad_skew: u32,
        pad: [u32; 2],
    }
}

kernels! {
    pass sample_tracer;

    /// The tracer where the map leads to.
    struct SampleTracer {
        override TAPS: u32 in [2, 4, 6];
        override LIMITER: bool;
        override GATHERED: Gathered;
        override ON_MAP_GRID: bool;
        override ON_TRACER_GRID: bool;
        override HAS_MAP: bool;
        override HAS_RIM: bool;
        @0 sample: Uniform<SampleUniform>;
        @1 tangents: Read<[f32]>;
        @2 control: ReadWrite<ControlBlock>;
        @3 map: Texture2dArray;
        @4 tracer: Texture2dArray;
        @5 sampled: ReadWrite<[f32]>;
        @6 point_sampler: PointSampler;
    }
    compute sample_tracer, sample_quads;
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
    pub map: Option<&'a wgpu::TextureView>,
    /// Its cells along a panel's edge.
    pub map_cells: u32,
    /// The tracer, and its cells along a panel's edge.
    pub tracer: (&'a wgpu::TextureView, u32),
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
    let kernel = SampleTracer {
        TAPS: scheme.taps(),
        LIMITER: limiter,
        GATHERED: gathered,
        ON_MAP_GRID: grid.cells == map_cells,
        ON_TRACER_GRID: grid.cells == tracer_cells,
        HAS_MAP: map.is_some(),
        HAS_RIM: cap.is_some(),
        sample: &recorder.gpu.uniform("sample", &uniform),
        tangents: &grid.tangents,
        control: sampling.control,
        // Where there is no map nothing is read from it, and any texture will do.
        map: map.unwrap_or(tracer),
        tracer,
        sampled: sampling.to,
        point_sampler: recorder.gpu.point_sampler(),
    };
    if sampling.takes_quads() {
        kernel.sample_quads(recorder, name, groups)
    } else {
        kernel.sample_tracer(recorder, name, groups)
    }
}
