//! What is drawn at the film of a bubble beside the film: what it ends at, and what flies off it.

use glam::DVec3;

use super::{Body, BodyKind, CameraKey, Shot, sight::bounds};
use crate::scene::{Boundary, Bubble};

/// Reach from the middle of its rim of what a drop is drawn on, over the rim's radius: see `shaders/pass/bodies.wgsl`.
const DROP_REACH: f64 = 2.7;
/// Radius of the thread of water that shines at the foot of a bubble on a bath, m, and of the bubble's at most: the meniscus is six times as high.
const FOOT_M: f64 = 0.35e-3;
const FOOT_PART: f64 = 0.02;
/// How far droplets fly, over the bubble's radius.
const SPRAY_REACH: f64 = 3.0;

/// What is drawn at the film of a bubble at a place, of which any pixel can see something.
pub(super) fn bodies(
    bubble: &Bubble,
    center_m: DVec3,
    is_bursting: bool,
    camera: &CameraKey,
    shot: &Shot,
) -> Vec<Body> {
    let radius_m = 1e-3 * bubble.radius_mm;
    let at_rim = |rim_deg: f64| {
        let rim_rad = rim_deg.to_radians();
        let rim_m = radius_m * rim_rad.sin();
        let (wire_m, foot_m) = (0.5e-3 * bubble.wire_mm, FOOT_M.min(FOOT_PART * radius_m));
        let (kind, reach_m) = match bubble.boundary {
            Boundary::Ring if wire_m > 0.0 => (BodyKind::Wire { rim_rad, wire_m }, rim_m + 1.2 * wire_m),
            Boundary::Bath => (BodyKind::Foot { rim_rad, foot_m }, rim_m + 1.2 * foot_m),
            Boundary::Drop => (BodyKind::Drop { rim_rad }, DROP_REACH * rim_m),
            Boundary::Ring | Boundary::Free => return None,
        };
        Some((kind, center_m + radius_m * rim_rad.cos() * DVec3::Z, reach_m))
    };
    let at_rim = bubble.boundary.rim_deg(bubble.rim_deg).and_then(at_rim);
    let hole = [(BodyKind::HoleRim, center_m, 1.1 * radius_m), (BodyKind::Spray, center_m, SPRAY_REACH * radius_m)];
    // A bath would mirror them.
    let hole = hole.into_iter().filter(|_| is_bursting && bubble.boundary != Boundary::Bath);
    let seen = |(kind, center_m, reach_m)| {
        let bounds = bounds(camera, shot.size, center_m, reach_m)?;
        Some(Body { kind, bounds })
    };
    at_rim.into_iter().chain(hole).filter_map(seen).collect()
}
