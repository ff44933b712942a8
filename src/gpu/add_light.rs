//! Adds the linear pictures of a scene in two lights.

use super::{GpuError, draw::radiance_format, pipelines::RenderKey, timing::Recorder};

/// Records the sum of two pictures. Both are read and a third is written, for not every adapter blends f32.
pub fn add_light(
    recorder: &mut Recorder<'_>,
    full_precision: bool,
    [first, second]: [&wgpu::TextureView; 2],
    sum: &wgpu::TextureView,
) -> Result<(), GpuError> {
    let gpu = recorder.gpu;
    let key = RenderKey {
        pass: "add_light",
        vertex: "cover",
        fragment: "add_light",
        format: radiance_format(full_precision),
        constants: vec![("FULL_PRECISION", u32::from(full_precision))],
    };
    let pipeline = gpu.pipelines.render(gpu, &key)?;
    let resources = [first, second].map(wgpu::BindingResource::TextureView);
    let bindings = gpu.bind(&pipeline.get_bind_group_layout(0), &resources);
    recorder.render("add_light", sum, |pass| {
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bindings, &[]);
        pass.draw(0..3, 0..1);
    });
    recorder.counts.draws += 1;
    Ok(())
}
