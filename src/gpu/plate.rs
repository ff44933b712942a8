//! The photograph behind the bubbles, on the device.

use super::{device::Gpu, target::Target};
use crate::plan::PlateKey;

/// Sends what a picture shows of a photograph: as f32, for no shader interpolates it.
#[must_use]
pub fn upload_plate(gpu: &Gpu, key: &PlateKey) -> Target {
    let target = Target::fit(None, gpu, "plate", key.size, wgpu::TextureFormat::Rgba32Float);
    let texels: Vec<[f32; 4]> = key.pixels().into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect();
    target.upload(gpu, bytemuck::cast_slice(&texels));
    target
}
