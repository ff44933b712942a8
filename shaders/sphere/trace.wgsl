// A view ray and a bubble, which may be an ellipsoid: it is traced where it is round.
//
// The pass that draws bubbles declares what this reads: `view` and `bubble`.

import package::camera::view::{View, pixel_angle};
import package::sphere::axes::perpendicular;
import package::sphere::path::{Path, PixelPart};
import package::sphere::silhouette::{Silhouette, silhouette};

// 1: the bubble is an ellipsoid. It is traced where it is round: `unstretch` takes the picture there, `stretch` back.
override STRETCHED: u32;
// 1: the eye is inside the bubble.
override INSIDE: u32;

// A vector of the world where the bubble is round.
fn to_round(vector: vec3f) -> vec3f {
    if (STRETCHED == 0u) {
        return vector;
    }
    return bubble.unstretch * vector;
}

// The inverse.
fn from_round(vector: vec3f) -> vec3f {
    if (STRETCHED == 0u) {
        return vector;
    }
    return bubble.stretch * vector;
}

// The wall's normal at a point of the unit sphere.
fn wall_normal(point: vec3f) -> vec3f {
    return normalize(to_round(point));
}

// Geometry of a view ray that meets the sphere.
fn path_along(direction: vec3f, part: PixelPart, position: vec2f) -> Path {
    let eye = to_round(-bubble.to_center_m) / bubble.radius_m;
    var round = direction;
    if (STRETCHED == 1u) {
        round = normalize(to_round(direction));
    }
    let foot = eye - dot(eye, round) * round;
    let half_chord = sqrt(max(1.0 - dot(foot, foot), 0.0));
    var cos_theta = half_chord;
    if (STRETCHED == 1u) {
        let front = -dot(direction, wall_normal(foot - half_chord * round));
        let back = dot(direction, wall_normal(foot + half_chord * round));
        cos_theta = select(0.5 * (front + back), back, eye_is_inside());
    }
    let distance = length(eye);
    // At the center no direction leads there, and what a bubble reflects is as wide as the pixel whichever is taken.
    let is_central = distance < 1e-6;
    return Path(
        direction,
        round,
        foot,
        half_chord,
        cos_theta,
        part.size * pixel_angle(view, direction),
        abs(dot(eye, round)) / max(cos_theta, 1e-3),
        select(length(foot) / max(distance, 1e-6), 1.0, is_central),
        select(bubble.to_center_m / max(length(bubble.to_center_m), 1e-30), perpendicular(direction), is_central),
        cross(direction, to_round(foot)),
        position,
        part,
    );
}

fn eye_is_inside() -> bool {
    return INSIDE == 1u;
}

// The outline, a sphere's where the bubble is round.
fn outline(plane: vec3f, width: f32) -> Silhouette {
    if (INSIDE == 1u) {
        return Silhouette(1.0, normalize(plane));
    }
    if (STRETCHED == 0u) {
        return silhouette(view, bubble.to_center_m, bubble.radius_m, plane, width);
    }
    var round = view;
    round.right = to_round(view.right);
    round.up = to_round(view.up);
    let edge = silhouette(round, to_round(bubble.to_center_m), bubble.radius_m, to_round(plane), width);
    return Silhouette(edge.coverage, normalize(from_round(edge.inside)));
}
