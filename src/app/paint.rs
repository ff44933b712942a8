//! Draws picture and user interface into the window, and only where they have changed.

use egui::epaint::ClippedShape;
use egui::{ClippedPrimitive, Color32, Context, Rect, Shape, TextureId, pos2};
use egui_wgpu::{RendererOptions, ScreenDescriptor};

use super::surface::{Acquired, WindowSurface};
use crate::gpu::Gpu;

/// Everything that a frame shows.
pub struct Contents<'a> {
    /// The user interface.
    pub shapes: Vec<ClippedShape>,
    /// The picture, if there is one, and where it stands in points.
    pub picture: Option<(&'a wgpu::TextureView, Rect)>,
    /// Whether the picture's pixels are others than in the frame before, or the system asks for the window again.
    pub is_new: bool,
    /// Physical pixels of the window.
    pub size: [u32; 2],
    /// Physical pixels for a point.
    pub pixels_per_point: f32,
}

/// What came of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Painted {
    /// It is on the screen, or was already.
    Done,
    /// There was no frame to draw into: try again soon.
    Later,
    /// The window cannot be seen.
    Hidden,
}

/// Draws frames.
pub struct Painter {
    egui: egui_wgpu::Renderer,
    picture: Option<(wgpu::TextureView, TextureId)>,
    /// What is on the window: shapes and size.
    shown: Option<(Vec<ClippedShape>, [u32; 2])>,
}

impl Painter {
    /// A painter with the texts that a context has drawn so far.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, ctx: &Context) -> Self {
        // The picture has its own dither; more noise on it would be wrong.
        let options = RendererOptions { dithering: false, ..RendererOptions::default() };
        let mut egui = egui_wgpu::Renderer::new(&gpu.device, format, options);
        if ctx.cumulative_pass_nr() > 0 {
            // egui sends its letters once; a device that comes later must be given all of them.
            let letters = ctx.fonts(|fonts| fonts.image());
            let letters = egui::epaint::ImageDelta::full(letters, egui::TextureOptions::LINEAR);
            egui.update_texture(&gpu.device, &gpu.queue, TextureId::default(), &letters);
        }
        Self { egui, picture: None, shown: None }
    }

    /// Takes the textures that egui has changed; must be called with each output, whether it is painted or not.
    pub fn update_textures(&mut self, gpu: &Gpu, delta: &mut egui::TexturesDelta) {
        for (id, images) in delta.set.drain() {
            for image in images {
                self.egui.update_texture(&gpu.device, &gpu.queue, id, &image);
            }
        }
        for id in delta.free.drain() {
            self.egui.free_texture(&id);
        }
    }

    /// Shows a frame, unless it is on the window already.
    pub fn paint(&mut self, gpu: &Gpu, surface: &mut WindowSurface, ctx: &Context, contents: Contents<'_>) -> Painted {
        let Contents { shapes, picture, is_new, size, pixels_per_point } = contents;
        let shapes = self.with_picture(gpu, shapes, picture);
        if !is_new && self.shown.as_ref().is_some_and(|(known, at)| *at == size && *known == shapes) {
            return Painted::Done;
        }
        surface.resize(size);
        let frame = match surface.acquire(gpu) {
            Acquired::Frame(frame) => frame,
            failed => {
                self.shown = None;
                return if matches!(failed, Acquired::Hidden) { Painted::Hidden } else { Painted::Later };
            }
        };
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point };
        let primitives = ctx.tessellate(shapes.clone(), pixels_per_point);
        self.submit(gpu, &frame, &primitives, &screen);
        gpu.queue.present(frame);
        self.shown = Some((shapes, size));
        Painted::Done
    }

    /// Puts the picture beneath everything else.
    fn with_picture(
        &mut self,
        gpu: &Gpu,
        mut shapes: Vec<ClippedShape>,
        picture: Option<(&wgpu::TextureView, Rect)>,
    ) -> Vec<ClippedShape> {
        if let Some((view, rect)) = picture {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            let image = Shape::image(self.texture(gpu, view), rect, whole, Color32::WHITE);
            shapes.insert(0, ClippedShape::new(rect, image));
        }
        shapes
    }

    /// egui's name for the picture's texture.
    fn texture(&mut self, gpu: &Gpu, view: &wgpu::TextureView) -> TextureId {
        // Pixels of the picture are pixels of the window, so that nothing is filtered.
        let filter = wgpu::FilterMode::Nearest;
        let id = match &self.picture {
            Some((known, id)) if known == view => return *id,
            Some((_, id)) => {
                self.egui.update_egui_texture_from_wgpu_texture(&gpu.device, view, filter, *id);
                *id
            }
            None => self.egui.register_native_texture(&gpu.device, view, filter),
        };
        self.picture = Some((view.clone(), id));
        id
    }

    fn submit(
        &mut self,
        gpu: &Gpu,
        frame: &wgpu::SurfaceTexture,
        primitives: &[ClippedPrimitive],
        screen: &ScreenDescriptor,
    ) {
        let view = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("window") });
        // Callbacks would have buffers of their own; there are none.
        self.egui.update_buffers(&gpu.device, &gpu.queue, &mut encoder, primitives, screen);
        let attachment = wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
        };
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("window"),
            color_attachments: &[Some(attachment)],
            ..Default::default()
        });
        self.egui.render(&mut pass.forget_lifetime(), primitives, screen);
        gpu.queue.submit([encoder.finish()]);
    }
}
