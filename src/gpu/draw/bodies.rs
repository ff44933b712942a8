//! What films end at, ready to be drawn.

use glam::DVec3;

use super::Shared;
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        formats::radiance_format,
        kernel::Drawable,
        passes::bodies::{BodyUniform, WIRE_SIDES, WaterDrop, Wire},
    },
    plan::{Body, BodyKind, BubbleKey},
    scene::Quality,
};

fn uniform(bubble: &BubbleKey, body: &Body, eye_m: DVec3) -> BodyUniform {
    let to_center_m = bubble.center_m - eye_m;
    let (sin, cos) = body.rim_rad.sin_cos();
    BodyUniform {
        to_center_m: to_center_m.as_vec3().to_array(),
        rim_m: (bubble.radius_m * sin) as f32,
        to_rim_m: (to_center_m + bubble.radius_m * cos * DVec3::Z).as_vec3().to_array(),
        wire_m: match body.kind {
            BodyKind::Wire(radius_m) => radius_m as f32,
            BodyKind::Drop => 0.0,
        },
    }
}

impl Shared<'_> {
    /// Makes ready what lies beyond the bubble's center of the body that its film ends at, or the rest, with its number of vertices.
    pub(super) fn body(
        &self,
        gpu: &Gpu,
        bubble: &BubbleKey,
        body: &Body,
        is_far: bool,
    ) -> Result<(Drawable, u32), GpuError> {
        let Self { key, view, light, environment, .. } = self;
        let format = radiance_format(key.full_precision);
        let uniform = &gpu.storage("body", &[uniform(bubble, body, key.camera.eye_m)]);
        // Smoother than `fast` has it: they are as sharp as mirrors and cover few pixels.
        let environment_sampler = environment.sampler(Quality::Standard);
        match body.kind {
            BodyKind::Wire(_) => {
                let wire = Wire {
                    IS_FAR: is_far,
                    FULL_PRECISION: key.full_precision,
                    lit: light.lit,
                    view,
                    light: &light.light,
                    environment: &environment.view,
                    environment_sampler,
                    lamps: &light.lamps,
                    body: uniform,
                    picture_behind: self.behind,
                };
                Ok((wire.ribbon(gpu, format)?, 6 * WIRE_SIDES))
            }
            BodyKind::Drop => {
                let drop = WaterDrop {
                    IS_FAR: is_far,
                    FULL_PRECISION: key.full_precision,
                    lit: light.lit,
                    view,
                    light: &light.light,
                    environment: &environment.view,
                    environment_sampler,
                    lamps: &light.lamps,
                    body: uniform,
                    picture_behind: self.behind,
                };
                Ok((drop.around_drop(gpu, format)?, 4))
            }
        }
    }
}
