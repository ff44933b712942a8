//! Fields of a film in textures: a layer a panel, halo included. Scattered reads cost half as much there as in buffers.

use super::{device::Gpu, timing::Recorder};
use crate::physics::sphere::PANELS;

/// A field on the panels of a cubed sphere.
pub struct PanelTexture {
    /// The texture.
    pub texture: wgpu::Texture,
    /// All its layers.
    pub view: wgpu::TextureView,
}

impl PanelTexture {
    /// A field of panels of some texels across and down.
    pub(in crate::gpu) fn new(gpu: &Gpu, label: &str, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: gpu.array_layers(PANELS.len() as u32) },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self { texture, view }
    }

    /// Texels of a panel, across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.texture.width(), self.texture.height()]
    }

    /// Bytes of a texel.
    fn texel_bytes(&self) -> u32 {
        // Formats of fields have a fixed size.
        self.texture.format().block_copy_size(None).unwrap_or(0)
    }

    fn panels(&self) -> wgpu::Extent3d {
        wgpu::Extent3d { depth_or_array_layers: PANELS.len() as u32, ..self.texture.size() }
    }

    /// Bytes of all panels.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let wgpu::Extent3d { width, height, depth_or_array_layers } = self.panels();
        [width, height, depth_or_array_layers, self.texel_bytes()].into_iter().map(u64::from).product()
    }

    /// Writes all texels, in the order of padded storage.
    pub(in crate::gpu) fn upload(&self, gpu: &Gpu, values: &[f32]) {
        self.write(gpu, wgpu::Origin3d::ZERO, bytemuck::cast_slice(values), self.panels());
    }

    /// Writes one texel.
    pub(in crate::gpu) fn upload_texel(&self, gpu: &Gpu, origin: wgpu::Origin3d, texel: &[f32]) {
        self.write(gpu, origin, bytemuck::cast_slice(texel), wgpu::Extent3d::default());
    }

    fn write(&self, gpu: &Gpu, origin: wgpu::Origin3d, bytes: &[u8], size: wgpu::Extent3d) {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.width * self.texel_bytes()),
            rows_per_image: Some(size.height),
        };
        gpu.upload_texture(wgpu::TexelCopyTextureInfo { origin, ..self.texture.as_image_copy() }, bytes, layout, size);
    }

    /// Copies all panels to a texture that is made for them.
    pub(in crate::gpu) fn copy(&self, recorder: &mut Recorder<'_>) -> Self {
        let copy = Self::new(recorder.gpu, "copy of a field", self.size(), self.texture.format());
        self.copy_to(recorder, &copy);
        copy
    }

    /// Copies all panels to a texture of the same size and format.
    pub(in crate::gpu) fn copy_to(&self, recorder: &mut Recorder<'_>, to: &Self) {
        let [from, to] = [self, to].map(|field| field.texture.as_image_copy());
        recorder.encoder().copy_texture_to_texture(from, to, self.panels());
    }
}
