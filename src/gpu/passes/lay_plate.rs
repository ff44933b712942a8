//! Lays a photograph behind the bubbles of a linear picture.

use super::backdrop::ViewUniform;
use crate::{
    gpu::{
        device::GpuError,
        formats::radiance_format,
        kernel::{Matrix, Texture2d, Uniform, kernels, shader_struct},
        timing::Recorder,
    },
    physics::colour::{bt709_to_bt2020, bt2020_to_bt709},
    plan::DrawKey,
};

shader_struct! {
    /// See `shaders/pass/lay_plate.wgsl`.
    pub struct PlateUniform {
        /// From linear BT.2020 to BT.709.
        pub to_plate: Matrix,
        /// And back.
        pub from_plate: Matrix,
        /// What is seen of white light from behind, linear BT.709.
        pub white: [f32; 3],
        /// Factor on the photograph.
        pub exposure: f32,
    }
}

kernels! {
    pass lay_plate;

    /// The picture with the photograph behind its bubbles.
    struct LayPlate {
        override FULL_PRECISION: bool;
        override ON_BATH: bool;
        @0 view: Uniform<ViewUniform>;
        @1 laying: Uniform<PlateUniform>;
        @2 added: Texture2d;
        @3 through: Texture2d;
        @4 plate: Texture2d;
    }
    draw cover as lay_plate;
}

impl PlateUniform {
    fn of(key: &DrawKey) -> Self {
        let exposure = f64::from(key.exposed_ev).exp2();
        let white = bt2020_to_bt709() * (exposure * key.lighting.light.seen * glam::DVec3::ONE);
        Self {
            to_plate: bt2020_to_bt709().into(),
            from_plate: bt709_to_bt2020().into(),
            white: white.as_vec3().to_array(),
            exposure: exposure as f32,
        }
    }
}

/// Records the picture of a key with a photograph behind what bubbles add, where they leave a part of white light from there.
pub fn lay_plate(
    recorder: &mut Recorder<'_>,
    (key, view): (&DrawKey, &ViewUniform),
    [added, through, plate]: [&wgpu::TextureView; 3],
    laid: &wgpu::TextureView,
) -> Result<(), GpuError> {
    let gpu = recorder.gpu;
    let kernel = LayPlate {
        FULL_PRECISION: key.full_precision,
        ON_BATH: key.on_bath,
        view: &gpu.uniform("view", view),
        laying: &gpu.uniform("laying of a plate", &PlateUniform::of(key)),
        added,
        through,
        plate,
    };
    let drawn = kernel.cover(gpu, &[radiance_format(key.full_precision)])?;
    recorder.render("lay_plate", laid, None, |pass| drawn.draw(pass, 3));
    recorder.counts.draws += 1;
    Ok(())
}
