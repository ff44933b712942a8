// The path of a ray through a bubble: what all of its hits have in common.

import package::optics::film_colour::POLARISED;

// The part of a pixel that a sample stands for.
struct PixelPart {
    // Unit vector in the picture, y down.
    line: vec2f,
    // Its size along the line and across, in pixels.
    size: vec2f,
    // Whether all pixels take the sample, so that derivatives can be taken; other samples use those of the one before.
    is_everywhere: bool,
}

const WHOLE_PIXEL: PixelPart = PixelPart(vec2f(1.0, 0.0), vec2f(1.0), true);

// A ray and the great circle that all its hits lie on. With the unit sphere at the origin a hit at normal n under direction v has
// v . n = -+cos_theta, a chord has the length 2 cos_theta, and every reflection turns the ray by the same angle. An ellipsoid is met where
// it is round, and turns rays by its true normals; the angle at the film is the mean of those at the first two walls.
struct Path {
    direction: vec3f,
    // The direction where the bubble is round.
    round: vec3f,
    // Foot of the perpendicular from the center on the ray there: |foot| = sin theta.
    foot: vec3f,
    // Half of a chord there.
    half_chord: f32,
    cos_theta: f32,
    // Angles that the sample spans: towards the bubble's center and across.
    pixel: vec2f,
    // Rate at which theta turns as the ray turns, radians per radian.
    theta_rate: f32,
    // sin of the angle between the ray and the direction to the center.
    sin_view: f32,
    // Unit vector from the eye to the center.
    to_center: vec3f,
    // Across the plane of incidence, not of unit length: zero straight through the middle.
    across: vec3f,
    // Where the ray is in the picture, in pixels.
    position: vec2f,
    part: PixelPart,
}

// Angles that a sample spans of reflected directions: in the plane of incidence, where the sphere's curvature widens its spread, and across,
// where it turns about the axis through the center.
fn spanned_angles(path: Path, direction: vec3f, turns: f32) -> vec2f {
    let along = path.pixel.x * abs(1.0 + turns * path.theta_rate);
    let across = path.pixel.y * length(cross(direction, path.to_center)) / max(path.sin_view, 1e-6);
    return vec2f(along, across);
}

// Footprint of a lookup over such angles. The geometric mean, but no finer than a quarter of the wider one.
fn footprint(angles: vec2f) -> f32 {
    return max(sqrt(angles.x * angles.y), 0.25 * max(angles.x, angles.y));
}

// Shares of s and p light that a polariser leaves which passes fields along a direction: theirs stand across the plane of incidence and in it.
fn polarisation_along(path: Path, polariser: vec3f) -> vec2f {
    if (POLARISED == 0u) {
        return vec2f(0.5);
    }
    let s = dot(polariser, path.across);
    let p = dot(polariser, cross(path.direction, path.across));
    // Straight through the middle s and p are the same.
    return (vec2f(s * s, p * p) + 5e-13) / (s * s + p * p + 1e-12);
}
