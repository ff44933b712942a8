//! What is drawn at films, made ready.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::Shared;
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        formats::radiance_format,
        kernel::Drawable,
        passes::{
            bodies::{BodyOverrides, BodyValue, Droplet, Foot, HoleRim, Spray, WIRE_SIDES, WaterDrop, Wire},
            open_hole::OpenHole,
        },
    },
    physics::film::{HOLE_MERIDIANS, droplets},
    plan::{Body, BodyKind, BubbleKey},
    scene::Quality,
};

/// Vertices of a piece of a strip that is cut into quadrilaterals.
const PIECE: u32 = 6;

fn value(bubble: &BubbleKey, kind: BodyKind, eye_m: DVec3) -> BodyValue {
    let (rim_rad, wire_m) = match kind {
        BodyKind::Wire { rim_rad, wire_m } => (rim_rad, wire_m),
        BodyKind::Foot { foot_m } => (FRAC_PI_2, foot_m),
        BodyKind::Drop { rim_rad } => (rim_rad, 0.0),
        BodyKind::HoleRim | BodyKind::Spray => (0.0, 0.0),
    };
    let to_center_m = bubble.center_m - eye_m;
    let (sin, cos) = rim_rad.sin_cos();
    BodyValue {
        to_center_m: to_center_m.as_vec3().to_array(),
        rim_m: (bubble.radius_m * sin) as f32,
        to_rim_m: (to_center_m + bubble.radius_m * cos * DVec3::Z).as_vec3().to_array(),
        wire_m: wire_m as f32,
        to_world: bubble.to_film.transpose().into(),
        radius_m: bubble.radius_m as f32,
        padding: [0.0; 3],
    }
}

/// The droplets of a bubble that bursts.
fn spray(bubble: &BubbleKey) -> Vec<Droplet> {
    let droplet = |found: crate::physics::film::Droplet| Droplet {
        turn: found.turn as f32,
        leaves_rad: found.leaves_rad as f32,
        radius_m: found.radius_m as f32,
        speed: found.speed as f32,
    };
    droplets(bubble.id, bubble.radius_m).map(droplet).collect()
}

impl Shared<'_> {
    /// Makes ready what lies beyond the bubble's center of a body, or the rest, with its number of vertices.
    pub(super) fn body(
        &self,
        gpu: &Gpu,
        (bubble, hole): (&BubbleKey, &OpenHole),
        body: &Body,
        is_far: bool,
    ) -> Result<(Drawable, u32), GpuError> {
        let Self { key, view, light, environment, .. } = self;
        let format = radiance_format(key.full_precision);
        let value = &gpu.storage("body", &[value(bubble, body.kind, key.camera.eye_m)]);
        let shape = BodyOverrides { IS_FAR: is_far, ON_BATH: key.on_bath, FULL_PRECISION: key.full_precision };
        // Smoother than `fast` has it: they are as sharp as mirrors and cover few pixels.
        let (environment_sampler, environment) = (environment.sampler(Quality::Standard), &environment.view);
        let (lit, lamps, light, picture_behind) = (light.lit, &light.lamps, &light.light, self.behind);
        match body.kind {
            BodyKind::Wire { .. } => {
                let wire = Wire {
                    shape,
                    lit,
                    view,
                    light,
                    environment,
                    environment_sampler,
                    lamps,
                    body: value,
                    picture_behind,
                };
                Ok((wire.along_wire(gpu, format)?, PIECE * WIRE_SIDES))
            }
            BodyKind::Foot { .. } => {
                let foot = Foot {
                    shape,
                    lit,
                    view,
                    light,
                    environment,
                    environment_sampler,
                    lamps,
                    body: value,
                    picture_behind,
                };
                Ok((foot.along_wire(gpu, format)?, PIECE * WIRE_SIDES))
            }
            BodyKind::Drop { .. } => {
                let drop = WaterDrop {
                    shape,
                    lit,
                    view,
                    light,
                    environment,
                    environment_sampler,
                    lamps,
                    body: value,
                    picture_behind,
                };
                Ok((drop.around_drop(gpu, format)?, 4))
            }
            BodyKind::HoleRim => {
                let rim = HoleRim {
                    shape,
                    lit,
                    view,
                    light,
                    environment,
                    environment_sampler,
                    lamps,
                    body: value,
                    picture_behind,
                    hole_middle: &hole.middle,
                    hole_rim: &hole.rim,
                };
                Ok((rim.along_hole(gpu, format)?, PIECE * HOLE_MERIDIANS as u32))
            }
            BodyKind::Spray => {
                let droplets = spray(bubble);
                let spray = Spray {
                    shape,
                    lit,
                    view,
                    light,
                    environment,
                    environment_sampler,
                    lamps,
                    body: value,
                    picture_behind,
                    hole_middle: &hole.middle,
                    hole_rim: &hole.rim,
                    droplets: &gpu.storage("droplets", &droplets),
                };
                Ok((spray.around_droplet(gpu, format)?, PIECE * droplets.len() as u32))
            }
        }
    }
}
