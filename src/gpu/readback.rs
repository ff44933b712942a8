//! Reads data back from the device without blocking a caller that must not block: begin, poll, take.

use std::sync::{Arc, Mutex, PoisonError};
#[cfg(not(target_arch = "wasm32"))]
use std::time::{Duration, Instant};

use super::device::{Gpu, GpuError};

/// How long a copy may take to be told once the device has done it.
#[cfg(not(target_arch = "wasm32"))]
const PATIENCE: Duration = Duration::from_secs(20);

/// Bytes on their way from the device.
pub struct Readback {
    buffer: wgpu::Buffer,
    mapped: Arc<Mutex<Option<Result<(), wgpu::BufferAsyncError>>>>,
    rows: Rows,
}

/// How the requested bytes lie in the copy: rows of a texture are padded to multiples of 256 bytes.
#[derive(Clone, Copy)]
struct Rows {
    count: usize,
    bytes: usize,
    stride: usize,
}

impl Readback {
    /// Starts to read back the first bytes of a buffer.
    #[must_use]
    pub fn of_buffer(gpu: &Gpu, source: &wgpu::Buffer, bytes: u64) -> Self {
        let rows = Rows { count: 1, bytes: bytes as usize, stride: bytes as usize };
        Self::begin(gpu, rows, |encoder, target| encoder.copy_buffer_to_buffer(source, 0, target, 0, bytes))
    }

    /// Starts to read back the first level and layer of a texture, row by row.
    #[must_use]
    pub fn of_texture(gpu: &Gpu, source: &wgpu::Texture) -> Self {
        // Colour formats in use here all have a fixed size in bytes.
        let texel = source.format().block_copy_size(None).unwrap_or(4) as usize;
        let bytes = source.width() as usize * texel;
        let stride = bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        let rows = Rows { count: source.height() as usize, bytes, stride };
        let size = wgpu::Extent3d { depth_or_array_layers: 1, ..source.size() };
        Self::begin(gpu, rows, |encoder, buffer| {
            let layout =
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride as u32), rows_per_image: None };
            encoder.copy_texture_to_buffer(source.as_image_copy(), wgpu::TexelCopyBufferInfo { buffer, layout }, size);
        })
    }

    fn begin(gpu: &Gpu, rows: Rows, copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer)) -> Self {
        let size = (rows.count * rows.stride) as u64;
        let buffer = gpu.buffer("readback", size, wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
        copy(&mut encoder, &buffer);
        gpu.queue.submit([encoder.finish()]);
        let mapped = Arc::new(Mutex::new(None));
        let told = mapped.clone();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        });
        Self { buffer, mapped, rows }
    }

    /// The bytes, if they have arrived since the device was last polled.
    pub fn try_take(&self) -> Option<Result<Vec<u8>, GpuError>> {
        let lost = |error: String| GpuError::Lost(error);
        let mapped = self.mapped.lock().unwrap_or_else(PoisonError::into_inner).take()?;
        Some(mapped.map_err(|error| lost(error.to_string())).and_then(|()| {
            let view = self.buffer.get_mapped_range(..).map_err(|error| lost(error.to_string()))?;
            let rows = view.chunks_exact(self.rows.stride);
            Ok(rows.flat_map(|row| &row[..self.rows.bytes]).copied().collect())
        }))
    }

    /// Waits for the bytes. Not for browsers, where nothing may block.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn wait(self, gpu: &Gpu) -> Result<Vec<u8>, GpuError> {
        let since = Instant::now();
        while since.elapsed() < PATIENCE {
            gpu.wait()?;
            if let Some(bytes) = self.try_take() {
                return bytes;
            }
            // Another thread that waits for the same device may have been told of this copy, and passes it on in a moment.
            std::thread::yield_now();
        }
        Err(GpuError::Lost("a copy never arrived".to_owned()))
    }
}
