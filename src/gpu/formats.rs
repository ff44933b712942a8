//! Formats of pictures on the device.

/// Format of the finished picture: gamma-encoded values in a plain format, so that no driver encodes a second time.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Format of what is polarised of the linear picture: see `shaders/light/stokes.wgsl`.
pub const POLARISATION_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// Format of the linear picture.
#[must_use]
pub fn radiance_format(full_precision: bool) -> wgpu::TextureFormat {
    if full_precision { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float }
}
