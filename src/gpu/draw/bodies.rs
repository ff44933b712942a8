//! What is drawn at films, made ready.

use bytemuck::Zeroable;
use glam::DVec3;

use super::Shared;
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        formats::radiance_format,
        kernel::Drawable,
        passes::{
            bodies::{Bodies, BodyOverrides, BodyValue, Droplet, WIRE_SIDES},
            open_hole::OpenHole,
        },
    },
    physics::film::{HOLE_MERIDIANS, droplets},
    plan::{BodyKind, BubbleKey},
    scene::Quality,
};

/// Vertices of a piece of a strip that is cut into quadrilaterals.
const PIECE: u32 = 6;

fn value(bubble: &BubbleKey, kind: BodyKind, eye_m: DVec3) -> BodyValue {
    let (rim_rad, wire_m) = match kind {
        BodyKind::Wire { rim_rad, wire_m } => (rim_rad, wire_m),
        BodyKind::Foot { rim_rad, foot_m } => (rim_rad, foot_m),
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

/// The droplets of a bubble that bursts. Buffers hold at least one value: where there are none, it is never read.
fn spray(bubble: &BubbleKey, kind: BodyKind) -> Vec<Droplet> {
    if kind != BodyKind::Spray {
        return vec![Droplet::zeroed()];
    }
    let droplet = |found: crate::physics::film::Droplet| Droplet {
        turn: found.turn as f32,
        leaves_rad: found.leaves_rad as f32,
        radius_m: found.radius_m as f32,
        speed: found.speed as f32,
    };
    droplets(bubble.id, bubble.radius_m).map(droplet).collect()
}

impl Shared<'_> {
    /// Makes a body ready: what of it lies beyond the bubble's center, and the rest, each with its number of vertices.
    pub(super) fn body(
        &self,
        gpu: &Gpu,
        (bubble, hole): (&BubbleKey, &OpenHole),
        kind: BodyKind,
    ) -> Result<[(Drawable, u32); 2], GpuError> {
        let (key, droplets) = (self.key, spray(bubble, kind));
        let body = gpu.storage("body", &[value(bubble, kind, key.camera.eye_m)]);
        let droplet_buffer = gpu.storage("droplets", &droplets);
        let (number, vertices) = match kind {
            BodyKind::Wire { .. } => (0, PIECE * WIRE_SIDES),
            BodyKind::Foot { .. } => (1, PIECE * WIRE_SIDES),
            BodyKind::HoleRim => (2, PIECE * HOLE_MERIDIANS as u32),
            BodyKind::Drop { .. } => (3, 4),
            BodyKind::Spray => (4, PIECE * droplets.len() as u32),
        };
        let half = |is_far: bool| {
            let bodies = Bodies {
                shape: BodyOverrides {
                    IS_FAR: is_far,
                    KIND: number,
                    ON_BATH: key.on_bath,
                    FULL_PRECISION: key.full_precision,
                },
                lit: self.light.lit,
                view: &self.view,
                light: &self.light.light,
                environment: &self.environment.view,
                // Smoother than `fast` has it: bodies are as sharp as mirrors, and cover few pixels.
                environment_sampler: self.environment.sampler(Quality::Standard),
                lamps: &self.light.lamps,
                body: &body,
                picture_behind: self.behind,
                hole_middle: &hole.middle,
                hole_rim: &hole.rim,
                droplets: &droplet_buffer,
            };
            Ok::<_, GpuError>((bodies.corner(gpu, &[radiance_format(key.full_precision)])?, vertices))
        };
        Ok([half(true)?, half(false)?])
    }
}
