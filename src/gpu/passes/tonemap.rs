//! Makes the finished picture from the linear one: exposure, tone curve, gamut, dither, encoding.

use crate::{
    gpu::{
        device::GpuError,
        formats::PICTURE_FORMAT,
        kernel::{Matrix, Texture2d, Uniform, kernels, shader_struct},
        timing::{Recorder, TONEMAP},
    },
    plan::TonemapKey,
};

shader_struct! {
    /// See `shaders/pass/tonemap.wgsl`.
    pub struct TonemapUniform {
        /// White balance.
        pub balance: Matrix,
        /// From BT.2020 to the display's linear RGB.
        pub to_display: Matrix,
        /// From there to XYZ relative to white.
        pub to_xyz: Matrix,
        /// And back.
        pub from_xyz: Matrix,
        /// Factor on radiance beside the exposure of the linear picture.
        pub exposure: f32,
        /// Seed of the dither.
        pub dither_seed: u32,
        /// Its amplitude in steps of the display.
        pub dither_steps: f32,
        pad: f32,
    }
}

kernels! {
    pass tonemap;

    /// The finished picture of a linear one.
    struct Tonemap {
        @0 tonemap: Uniform<TonemapUniform>;
        @1 radiance: Texture2d;
    }
    draw cover as tonemapped;
}

impl TonemapUniform {
    fn of(key: &TonemapKey) -> Self {
        let to_xyz = key.gamut.to_relative_xyz();
        Self {
            balance: key.balance.into(),
            to_display: key.gamut.from_bt2020().into(),
            to_xyz: to_xyz.into(),
            from_xyz: to_xyz.inverse().into(),
            exposure: key.exposure() as f32,
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
    let uniform = &gpu.uniform("tonemap", &TonemapUniform::of(key));
    let finished = Tonemap { tonemap: uniform, radiance }.cover(gpu, &[PICTURE_FORMAT])?;
    recorder.render(TONEMAP, picture, None, |pass| finished.draw(pass, 3));
    recorder.counts.draws += 1;
    Ok(())
}
