//! The environment on the device: a cube map with all its levels.

use super::device::Gpu;
use crate::physics::environment::CubeMap;

/// An environment and how it is sampled.
pub struct Environment {
    texture: wgpu::Texture,
    /// The cube.
    pub view: wgpu::TextureView,
    /// Angle between neighbouring texels at the center of a face of the finest level, in radians.
    pub texel_angle: f32,
    /// Linear within and between levels; cube maps have no seams.
    pub sampler: wgpu::Sampler,
}

impl Environment {
    /// Sends a cube map to the device.
    #[must_use]
    pub fn upload(gpu: &Gpu, map: &CubeMap) -> Self {
        let environment = Self::new(gpu, map);
        environment.write(gpu, map, [true; 6]);
        environment
    }

    /// A black cube as large as a map.
    #[must_use]
    pub fn new(gpu: &Gpu, map: &CubeMap) -> Self {
        let width = map.size() as u32;
        let size = wgpu::Extent3d { width, height: width, depth_or_array_layers: 6 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("environment"),
            size,
            mip_level_count: map.mips().len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::Cube),
            ..Default::default()
        });
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("environment"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self { texture, view, texel_angle: 2.0 / width as f32, sampler }
    }

    /// Sends some faces of a map that is as large.
    pub fn write(&self, gpu: &Gpu, map: &CubeMap, faces: [bool; 6]) {
        for (number, level) in map.mips().iter().enumerate() {
            for (face, texels) in level.faces.iter().enumerate().filter(|(face, _)| faces[*face]) {
                write_face(gpu, &self.texture, number as u32, face as u32, bytemuck::cast_slice(texels));
            }
        }
    }
}

fn write_face(gpu: &Gpu, texture: &wgpu::Texture, level: u32, face: u32, texels: &[u8]) {
    let width = (texture.width() >> level).max(1);
    gpu.upload_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: level,
            origin: wgpu::Origin3d { x: 0, y: 0, z: face },
            aspect: wgpu::TextureAspect::All,
        },
        texels,
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(8 * width), rows_per_image: None },
        wgpu::Extent3d { width, height: width, depth_or_array_layers: 1 },
    );
}
