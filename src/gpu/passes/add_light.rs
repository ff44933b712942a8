//! Adds the linear pictures of a scene in two lights.

use crate::gpu::{
    device::GpuError,
    formats::radiance_format,
    kernel::{Texture2d, kernels},
    timing::Recorder,
};

kernels! {
    pass add_light;

    /// The sum of two pictures. Both are read and a third is written, for not every adapter blends f32.
    struct AddLight {
        override FULL_PRECISION: bool;
        @0 first: Texture2d;
        @1 second: Texture2d;
    }
    draw cover as add_light;
}

/// Records the sum of two pictures.
pub fn add_light(
    recorder: &mut Recorder<'_>,
    full_precision: bool,
    [first, second]: [&wgpu::TextureView; 2],
    sum: &wgpu::TextureView,
) -> Result<(), GpuError> {
    let kernel = AddLight { FULL_PRECISION: full_precision, first, second };
    let added = kernel.cover(recorder.gpu, &[radiance_format(full_precision)])?;
    recorder.render("add_light", sum, None, |pass| added.draw(pass, 3));
    recorder.counts.draws += 1;
    Ok(())
}
