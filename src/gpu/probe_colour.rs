//! Colours of a list of films, through the table and the shader functions that pictures use.

use bytemuck::{Pod, Zeroable};

use super::{
    Gpu, GpuError,
    bake_table::{Table, table_sampler},
    pipelines::ComputeKey,
    readback::Readback,
    timing::Recorder,
};

/// One ray's walls: see `shaders/pass/probe_colour.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProbePoint {
    /// Cosine of the angle outside.
    pub cos_theta: f32,
    /// Thickness of the front wall, in nm.
    pub front_nm: f32,
    /// Thickness of the back wall.
    pub back_nm: f32,
    /// Thickness where the light leaves.
    pub exit_nm: f32,
    /// 1 for the front wall alone, 2 for front and back.
    pub walls: u32,
}

/// Points of one dispatch.
const CHUNK: usize = 1 << 20;

/// Starts to measure the unpolarised colours of some points, linear BT.2020 with a fourth number that means nothing, in chunks.
pub fn probe_colours(gpu: &Gpu, table: &Table, points: &[ProbePoint]) -> Result<Vec<Readback>, GpuError> {
    points.chunks(CHUNK).map(|chunk| probe_chunk(gpu, table, chunk)).collect()
}

fn probe_chunk(gpu: &Gpu, table: &Table, points: &[ProbePoint]) -> Result<Readback, GpuError> {
    let key = ComputeKey { pass: "probe_colour", entry: "probe_colour", constants: vec![] };
    let pipeline = gpu.pipelines.compute(gpu, &key)?;
    let size = points.len() as u64 * 16;
    let colours = gpu.buffer("colours", size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let points_buffer = gpu.storage("points", points);
    let sampler = table_sampler(gpu);
    let bindings = gpu.bind(
        &pipeline.get_bind_group_layout(0),
        &[
            table.axes.as_entire_binding(),
            wgpu::BindingResource::TextureView(&table.view),
            wgpu::BindingResource::Sampler(&sampler),
            points_buffer.as_entire_binding(),
            colours.as_entire_binding(),
        ],
    );
    let mut recorder = Recorder::new(gpu);
    recorder.dispatch("probe_colour", &pipeline, &bindings, [points.len().div_ceil(64) as u32, 1, 1]);
    recorder.submit(&Default::default());
    Ok(Readback::of_buffer(gpu, &colours, size))
}
