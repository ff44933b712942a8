//! The end of a remap.

use super::{
    GpuError,
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};

/// Makes what a remap sampled the tracer, with its liquid restored.
pub fn settle_tracer(
    recorder: &mut Recorder<'_>,
    balance: &wgpu::Buffer,
    sampled: &wgpu::Buffer,
    tracer: &wgpu::Buffer,
    groups: Groups<'_>,
) -> Result<(), GpuError> {
    let key = ComputeKey { pass: "settle_tracer", entry: "settle_tracer", constants: vec![] };
    recorder.compute("step_field", &key, &[balance, sampled, tracer].map(wgpu::Buffer::as_entire_binding), groups)
}
