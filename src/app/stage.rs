//! Everything that is on the device and lost with it.

use std::sync::Arc;

use winit::window::Window;

use super::{AppError, paint::Painter, surface::WindowSurface, system};
use crate::gpu::{AdapterChoice, Renderer};

/// Device, surface, renderer and painter.
pub struct Stage {
    /// Draws scenes.
    pub renderer: Renderer,
    /// The window's surface.
    pub surface: WindowSurface,
    /// Puts pictures and the user interface on the surface.
    pub painter: Painter,
}

impl Stage {
    /// Opens the chosen adapter for a window.
    pub async fn open(
        instance: wgpu::Instance,
        choice: AdapterChoice,
        window: Arc<Window>,
        ctx: egui::Context,
    ) -> Result<Self, AppError> {
        let surface = instance.create_surface(window.clone()).map_err(|error| AppError::Surface(error.to_string()))?;
        let gpu = system::device(instance, &choice, &surface).await?;
        let surface = WindowSurface::new(&gpu, surface, window)?;
        let painter = Painter::new(&gpu, surface.format(), &ctx);
        Ok(Self { renderer: Renderer::new(gpu), surface, painter })
    }
}
