//! The photograph behind the bubbles, on the device.

use super::{device::Gpu, target::Target};
use crate::plan::PlateKey;

/// Sends what a picture shows of a photograph: as f32, for no shader interpolates it.
#[must_use]
pub fn upload_plate(gpu: &Gpu, key: &PlateKey) -> Target {
    let target = Target::fit(None, gpu, "plate", key.size, wgpu::TextureFormat::Rgba32Float);
    let texels: Vec<[f32; 4]> = key.pixels().into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect();
    let [width, height] = key.size;
    gpu.upload_texture(
        target.texture.as_image_copy(),
        bytemuck::cast_slice(&texels),
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(16 * width), rows_per_image: None },
        wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
    );
    target
}
