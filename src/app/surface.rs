//! The window's surface: configured for gamma-encoded values, and kept alive through all that window systems do to it.

use std::sync::Arc;

use winit::window::Window;

use super::AppError;
use crate::gpu::Gpu;

/// What the surface gives when it is asked for a frame.
pub enum Acquired {
    /// A frame to draw into.
    Frame(wgpu::SurfaceTexture),
    /// None now, but soon: ask again.
    Later,
    /// None while the window cannot be seen: the system will say when it can.
    Hidden,
}

/// A surface with its configuration.
pub struct WindowSurface {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    window: Arc<Window>,
    /// Whether the configuration must be renewed before the next frame.
    stale: bool,
}

impl WindowSurface {
    /// Configures a new surface for its window.
    pub fn new(gpu: &Gpu, surface: wgpu::Surface<'static>, window: Arc<Window>) -> Result<Self, AppError> {
        let capabilities = surface.get_capabilities(&gpu.adapter);
        // Values are gamma-encoded already: a format that encodes again would show them too bright.
        let plain = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
        // The first is the one that is shown without a copy.
        let format = capabilities.formats.into_iter().find(|format| plain.contains(format));
        let format = format.ok_or_else(|| AppError::Surface("it offers no 8-bit format without sRGB".to_owned()))?;
        let config = wgpu::SurfaceConfiguration {
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            format,
            color_space: wgpu::SurfaceColorSpace::Auto,
            width: 1,
            height: 1,
            // The one mode that exists everywhere; it also keeps the loop from running faster than the screen.
            present_mode: wgpu::PresentMode::Fifo,
            desired_maximum_frame_latency: 2,
            alpha_mode: wgpu::CompositeAlphaMode::Auto,
            view_formats: Vec::new(),
        };
        Ok(Self { surface, config, window, stale: true })
    }

    /// The format to draw in.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Follows the window's size in pixels, both above zero.
    pub fn resize(&mut self, size: [u32; 2]) {
        self.stale |= [self.config.width, self.config.height] != size;
        [self.config.width, self.config.height] = size;
    }

    /// The next frame, if there is one to be had.
    pub fn acquire(&mut self, gpu: &Gpu) -> Acquired {
        if std::mem::take(&mut self.stale) {
            self.surface.configure(&gpu.device, &self.config);
        }
        match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(frame) => Acquired::Frame(frame),
            wgpu::CurrentSurfaceTexture::Suboptimal(frame) => {
                self.stale = true;
                Acquired::Frame(frame)
            }
            wgpu::CurrentSurfaceTexture::Outdated => {
                self.stale = true;
                Acquired::Later
            }
            wgpu::CurrentSurfaceTexture::Lost => {
                self.renew(gpu);
                Acquired::Later
            }
            wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Validation => Acquired::Later,
            wgpu::CurrentSurfaceTexture::Occluded => Acquired::Hidden,
        }
    }

    /// Makes the surface again; where that fails, the next frame tries once more.
    fn renew(&mut self, gpu: &Gpu) {
        match gpu.instance.create_surface(self.window.clone()) {
            Ok(surface) => self.surface = surface,
            Err(error) => log::warn!("the window's surface cannot be recreated: {error}"),
        }
        self.stale = true;
    }
}
