//! Figures: what a panel draws, drawn once more by itself on white, for a file.

use egui::{Context, FullOutput, Pos2, RawInput, Rect, Ui, Visuals, vec2};
use egui_wgpu::{RendererOptions, ScreenDescriptor};

use crate::gpu::{Gpu, formats::PICTURE_FORMAT, readback::Readback};

/// Size of a figure, points.
const SIZE: egui::Vec2 = vec2(640.0, 420.0);
/// Pixels for a point: sharp on paper.
const SCALE: f32 = 2.0;
/// Passes until a plot has found its size.
const PASSES: usize = 3;

/// Draws a figure, and starts to read it back; its size is in pixels.
pub fn draw(gpu: &Gpu, content: impl Fn(&mut Ui)) -> (Readback, [u32; 2]) {
    let ctx = Context::default();
    ctx.set_pixels_per_point(SCALE);
    ctx.set_visuals(Visuals::light());
    let mut renderer = egui_wgpu::Renderer::new(&gpu.device, PICTURE_FORMAT, RendererOptions::default());
    let mut output = FullOutput::default();
    for _ in 0..PASSES {
        let input = RawInput { screen_rect: Some(Rect::from_min_size(Pos2::ZERO, SIZE)), ..RawInput::default() };
        output = ctx.run_ui(input, |ui| {
            egui::Frame::NONE.fill(egui::Color32::WHITE).inner_margin(12).show(ui, |ui| {
                ui.set_min_size(ui.available_size());
                content(ui);
            });
        });
        for (id, images) in output.textures_delta.set.drain() {
            images.iter().for_each(|image| renderer.update_texture(&gpu.device, &gpu.queue, id, image));
        }
        output.textures_delta.free.clear();
    }
    let size = [SIZE.x, SIZE.y].map(|side| (SCALE * side) as u32);
    let primitives = ctx.tessellate(std::mem::take(&mut output.shapes), SCALE);
    let texture = target(gpu, size);
    submit(gpu, &mut renderer, &primitives, &texture);
    (Readback::of_texture(gpu, &texture), size)
}

fn target(gpu: &Gpu, [width, height]: [u32; 2]) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("figure"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: PICTURE_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

fn submit(
    gpu: &Gpu,
    renderer: &mut egui_wgpu::Renderer,
    primitives: &[egui::ClippedPrimitive],
    texture: &wgpu::Texture,
) {
    let screen = ScreenDescriptor { size_in_pixels: [texture.width(), texture.height()], pixels_per_point: SCALE };
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("figure") });
    // Callbacks would have buffers of their own; there are none.
    renderer.update_buffers(&gpu.device, &gpu.queue, &mut encoder, primitives, &screen);
    let attachment = wgpu::RenderPassColorAttachment {
        view: &view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
    };
    let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("figure"),
        color_attachments: &[Some(attachment)],
        ..Default::default()
    });
    renderer.render(&mut pass.forget_lifetime(), primitives, &screen);
    gpu.queue.submit([encoder.finish()]);
}
