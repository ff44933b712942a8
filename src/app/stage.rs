//! Everything that is on the device and lost with it.

use std::sync::Arc;

use winit::window::Window;

use super::{AppError, paint::Painter, render_thread::RenderThread, surface::WindowSurface, system};
use crate::gpu::{AdapterChoice, Gpu};

/// Device, surface, renderer and painter.
pub struct Stage {
    /// The window's device.
    pub gpu: Gpu,
    /// Draws scenes.
    pub drawing: RenderThread,
    /// The window's surface.
    pub surface: WindowSurface,
    /// Puts pictures and the user interface on the surface.
    pub painter: Painter,
}

impl Stage {
    /// Opens the chosen adapter for a window. `wake` is called, from another thread, whenever a picture is drawn.
    pub async fn open(
        instance: wgpu::Instance,
        choice: AdapterChoice,
        window: Arc<Window>,
        ctx: egui::Context,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, AppError> {
        let surface = instance.create_surface(window.clone()).map_err(|error| AppError::Surface(error.to_string()))?;
        let gpu = system::device(instance, &choice, &surface).await?;
        let surface = WindowSurface::new(&gpu, surface, window)?;
        let painter = Painter::new(&gpu, surface.format(), &ctx);
        let drawing = RenderThread::new(&gpu, wake).await?;
        Ok(Self { gpu, drawing, surface, painter })
    }
}
