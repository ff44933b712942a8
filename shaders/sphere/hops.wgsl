// The way of a ray from wall to wall of a bubble.
//
// The pass that draws bubbles declares what this reads: `bubble`.

import package::light::strips::reflected_surroundings;
import package::light::water::{crossing, past_meniscus};
import package::sphere::path::Path;
import package::sphere::trace::{STRETCHED, to_round, wall_normal};

// A ray inside that heads for the wall at a point of the unit sphere.
struct Hop {
    point: vec3f,
    direction: vec3f,
}

fn reflected(hop: Hop, chord: f32) -> Hop {
    if (STRETCHED == 1u) {
        let turned = reflect(hop.direction, wall_normal(hop.point));
        let round = normalize(to_round(turned));
        return Hop(hop.point - 2.0 * dot(hop.point, round) * round, turned);
    }
    let direction = hop.direction - chord * hop.point;
    return Hop(hop.point + chord * direction, direction);
}

// The outer reflection at a point of the unit sphere.
fn mirrored(path: Path, front: vec3f) -> vec3f {
    if (STRETCHED == 1u) {
        return reflect(path.direction, wall_normal(front));
    }
    return path.direction + 2.0 * path.cos_theta * front;
}

// How far a ray was followed inside: where it heads now, how often it was reflected, what a bath on the way there leaves of light, and the
// light from there.
struct Followed {
    hop: Hop,
    reflections: f32,
    left: f32,
    light: vec3f,
}

fn followed(path: Path, before: Followed) -> Followed {
    var after = reflected_inside(path, before);
    after.light *= reflected_surroundings(path, after.hop.direction, -2.0 * after.reflections);
    return after;
}

// How far it is followed, with what is left of light from there as its light.
fn reflected_inside(path: Path, before: Followed) -> Followed {
    let hop = reflected(before.hop, 2.0 * path.half_chord);
    let left = before.left * crossing(before.hop.point.z, hop.point.z, hop.direction)
        * past_meniscus(hop.point.z, bubble.radius_m);
    let leaving = left * crossing(hop.point.z, hop.direction.z, hop.direction);
    return Followed(hop, before.reflections + 1.0, left, vec3f(leaving));
}

// What a bath leaves of light between the eye and beyond the front wall.
fn left_before(path: Path) -> f32 {
    let front_z = path.foot.z - path.half_chord * path.round.z;
    return crossing(-bubble.to_center_m.z, front_z, path.direction) * past_meniscus(front_z, bubble.radius_m);
}
