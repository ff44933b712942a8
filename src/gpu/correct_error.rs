//! The middle of back and forth error compensation.

use super::{GpuError, pipelines::ComputeKey, timing::Recorder};

/// Takes half of what a tracer lost on the way forth and back off before the step is made for good.
pub fn correct_error(
    recorder: &mut Recorder<'_>,
    tracer: &wgpu::Buffer,
    returned: &wgpu::Buffer,
    corrected: &wgpu::Buffer,
    groups: [u32; 3],
) -> Result<(), GpuError> {
    let key = ComputeKey { pass: "correct_error", entry: "correct_error", constants: vec![] };
    let resources = [tracer, returned, corrected].map(wgpu::Buffer::as_entire_binding);
    recorder.compute("step_field", &key, &resources, groups.into())
}
