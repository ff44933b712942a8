//! Saving the picture: drawn once more in full, beside the window, read back without waiting, and written by a worker.

use std::path::PathBuf;

use super::{files::Files, model::Model};
use crate::{
    gpu::{Gpu, GpuError, readback::Readback},
    output::{Metadata, Picture},
    physics::colour::Gamut,
    plan::{FrameRequest, Pace, Shot, Story},
    scene::{Quality, Scene},
};

/// A picture on its way from the device to a file.
pub struct Capture {
    /// The picture.
    pub readback: Readback,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Whether it is radiance; if not, it is what people see.
    pub radiance: bool,
    /// The file.
    pub path: PathBuf,
    /// What the file says of itself.
    pub metadata: Metadata,
}

impl Capture {
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

/// The model's moment in full, to be saved as radiance, or as what people see.
pub fn request(model: &Model, size: [u32; 2], radiance: bool) -> Result<FrameRequest, String> {
    let shot = shot(model, size, radiance);
    model.scene.request_from(&model.scene.camera, &model.resources, &shot).map_err(|error| error.to_string())
}

/// The model's moment in full in a quality, as people see it.
pub fn request_in(model: &Model, size: [u32; 2], quality: Quality) -> Result<FrameRequest, String> {
    let mut scene = Scene::clone(&model.scene);
    scene.view.quality = quality;
    let request = Story::new(scene).request_from(&model.scene.camera, &model.resources, &shot(model, size, false));
    request.map_err(|error| error.to_string())
}

fn shot(model: &Model, size: [u32; 2], full_precision: bool) -> Shot {
    let moment = model.clock.moment(&model.scene.motion);
    Shot { size, moment, full_precision, gamut: Gamut::Srgb, pace: Pace::Whole }
}

/// What a picture of the model says of itself.
pub fn metadata(model: &Model) -> Metadata {
    Metadata::of_scene(&model.name, model.clock.time_s(&model.scene.motion))
}
