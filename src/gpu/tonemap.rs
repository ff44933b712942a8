//! Makes the finished picture from the linear one: exposure, tone curve, gamut, dither, encoding.

use bytemuck::{Pod, Zeroable};

use super::{GpuError, draw::matrix, pipelines::RenderKey, timing::Recorder};
use crate::plan::TonemapKey;

/// Format of the finished picture: gamma-encoded values in a plain format, so that no driver encodes a second time.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// See `shaders/pass/tonemap.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TonemapUniform {
    /// White balance: columns of a matrix, the fourth number of each is padding.
    pub balance: [[f32; 4]; 3],
    /// From BT.2020 to the display's linear RGB.
    pub to_display: [[f32; 4]; 3],
    /// From there to XYZ relative to white.
    pub to_xyz: [[f32; 4]; 3],
    /// And back.
    pub from_xyz: [[f32; 4]; 3],
    /// Factor on radiance beside that of the linear picture.
    pub exposure: f32,
    /// Seed of the dither.
    pub dither_seed: u32,
    /// Its amplitude in steps of the display.
    pub dither_steps: f32,
    pad: f32,
}

impl TonemapUniform {
    fn of(key: &TonemapKey) -> Self {
        let to_xyz = key.gamut.to_relative_xyz();
        Self {
            balance: matrix(key.balance),
            to_display: matrix(key.gamut.from_bt2020()),
            to_xyz: matrix(to_xyz),
            from_xyz: matrix(to_xyz.inverse()),
            exposure: (key.exposure_ev - f64::from(key.draw.exposed_ev)).exp2() as f32,
            dither_seed: key.dither.unwrap_or(0),
            dither_steps: if key.dither.is_some() { 1.0 } else { 0.0 },
            pad: 0.0,
        }
    }
}

/// Records the tonemap of a whole picture.
pub fn tonemap(
    recorder: &mut Recorder<'_>,
    key: &TonemapKey,
    radiance: &wgpu::TextureView,
    picture: &wgpu::TextureView,
) -> Result<(), GpuError> {
    let gpu = recorder.gpu;
    let pipeline_key = RenderKey {
        pass: "tonemap",
        vertex: "cover",
        fragment: "tonemapped",
        format: PICTURE_FORMAT,
        constants: vec![],
    };
    let pipeline = gpu.pipelines.render(gpu, &pipeline_key)?;
    let uniform = gpu.uniform("tonemap", &TonemapUniform::of(key));
    let bindings = gpu.bind(
        &pipeline.get_bind_group_layout(0),
        &[uniform.as_entire_binding(), wgpu::BindingResource::TextureView(radiance)],
    );
    recorder.render("tonemap", picture, |pass| {
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bindings, &[]);
        pass.draw(0..3, 0..1);
    });
    recorder.counts.draws += 1;
    Ok(())
}
