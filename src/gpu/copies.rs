//! Copies of buffers on the device, from which they can be made again.

use super::timing::Recorder;

/// The contents of some buffers at a moment.
pub struct Copies(Vec<wgpu::Buffer>);

impl Copies {
    /// Copies all of them.
    #[must_use]
    pub fn of(recorder: &mut Recorder<'_>, buffers: &[&wgpu::Buffer]) -> Self {
        let usage = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let copies: Vec<_> =
            buffers.iter().map(|buffer| recorder.gpu.buffer("copy of state", buffer.size(), usage)).collect();
        for (from, to) in buffers.iter().zip(&copies) {
            recorder.encoder().copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
        Self(copies)
    }

    /// Copies them back into buffers of the same sizes, in the same order.
    pub fn restore(&self, recorder: &mut Recorder<'_>, buffers: &[&wgpu::Buffer]) {
        for (from, to) in self.0.iter().zip(buffers) {
            recorder.encoder().copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
    }
}
