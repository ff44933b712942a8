//! Saving the picture: drawn once more in full, read back without waiting, and written by a worker.

use std::path::PathBuf;

use super::{files::Files, model::Model};
use crate::{
    gpu::{Gpu, GpuError, Renderer, readback::Readback},
    output::{Metadata, Picture},
    physics::colour::Gamut,
    plan::{Pace, Shot, Story},
    scene::{Quality, Scene},
};

/// A picture on its way from the device to a file.
pub struct Capture {
    readback: Readback,
    size: [u32; 2],
    radiance: bool,
    path: PathBuf,
    metadata: Metadata,
}

impl Capture {
    /// Draws the model's moment in full, and starts to read it back: radiance, or what people see.
    pub fn begin(
        renderer: &mut Renderer,
        model: &Model,
        size: [u32; 2],
        radiance: bool,
        path: PathBuf,
    ) -> Result<Self, String> {
        let moment = model.clock.moment(&model.scene.motion);
        let shot =
            Shot { size, moment, full_precision: radiance, gamut: Gamut::Srgb, yardstick: false, pace: Pace::Whole };
        let request = model
            .scene
            .request_from(&model.scene.camera, &model.resources, &shot)
            .map_err(|error| error.to_string())?;
        renderer.render(&request).map_err(|error| error.to_string())?;
        let readback = if radiance { renderer.read_radiance() } else { renderer.read_picture() };
        let readback = readback.ok_or("there is no picture to save yet")?;
        Ok(Self { readback, size, radiance, path, metadata: metadata(model) })
    }

    /// A figure that is on its way.
    pub fn of_figure((readback, size): (Readback, [u32; 2]), model: &Model, path: PathBuf) -> Self {
        Self { readback, size, radiance: false, path, metadata: metadata(model) }
    }

    /// Hands the picture to a worker once it has arrived; returns whether it is still pending.
    pub fn poll(&self, gpu: &Gpu, files: &Files) -> Result<bool, GpuError> {
        gpu.device.poll(wgpu::PollType::Poll).map_err(|error| GpuError::Lost(error.to_string()))?;
        let Some(bytes) = self.readback.try_take() else { return Ok(true) };
        let (bytes, size, radiance) = (bytes?, self.size, self.radiance);
        files.save_picture(self.path.clone(), self.metadata.clone(), move || {
            if radiance {
                Picture::radiance_from_bt2020(size, &bytemuck::pod_collect_to_vec(&bytes))
            } else {
                Picture::Display { size, gamut: Gamut::Srgb, rgba: bytes }
            }
        });
        Ok(false)
    }
}

/// Draws the model's moment in full in a quality, and starts to read back what people see.
pub fn draw_in(renderer: &mut Renderer, model: &Model, size: [u32; 2], quality: Quality) -> Result<Readback, String> {
    let mut scene = Scene::clone(&model.scene);
    scene.view.quality = quality;
    let moment = model.clock.moment(&model.scene.motion);
    let shot = Shot { size, moment, full_precision: false, gamut: Gamut::Srgb, yardstick: false, pace: Pace::Whole };
    let request = Story::new(scene).request_from(&model.scene.camera, &model.resources, &shot);
    let request = request.map_err(|error| error.to_string())?;
    renderer.render(&request).map_err(|error| error.to_string())?;
    renderer.read_picture().ok_or_else(|| "there is no picture yet".to_owned())
}

fn metadata(model: &Model) -> Metadata {
    Metadata::of_scene(&model.name, model.clock.time_s(&model.scene.motion))
}
