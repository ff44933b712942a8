//! Pictures on the device.

use super::device::Gpu;

/// A picture on the device.
pub struct Target {
    /// The texture.
    pub texture: wgpu::Texture,
    /// All of it.
    pub view: wgpu::TextureView,
}

impl Target {
    /// A picture without content.
    fn new(gpu: &Gpu, label: &str, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST;
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }

    /// Keeps a picture that fits, else makes a new one.
    pub fn fit(old: Option<Self>, gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let fits = |target: &Self| {
            [target.texture.width(), target.texture.height()] == size && target.texture.format() == format
        };
        old.filter(fits).unwrap_or_else(|| Self::new(gpu, label, size, format))
    }

    /// Sends all of its texels, row by row.
    pub fn upload(&self, gpu: &Gpu, texels: &[u8]) {
        let size = self.texture.size();
        // Colour formats in use here all have a fixed size in bytes.
        let texel = self.texture.format().block_copy_size(None).unwrap_or(4);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(texel * size.width), rows_per_image: None };
        gpu.upload_texture(self.texture.as_image_copy(), texels, layout, size);
    }
}
