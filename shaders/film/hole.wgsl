// A hole in a film that bursts: its f64 twin, with the sources, is src/physics/film/burst.rs.

import package::sphere::axes::perpendicular;

const TAU: f32 = 6.2831853;
// Meridians about the middle along which the rim is known, evenly spaced.
override HOLE_MERIDIANS: u32;

// The rim on a meridian. Mirrors `RimValue` in src/gpu/passes/open_hole.rs.
struct Rim {
    // Angles from the middle to the film that is still at rest, and to where the rim begins.
    outer_rad: f32,
    inner_rad: f32,
    // Mean thickness of the rim, nm.
    thickness_nm: f32,
    padding: f32,
}

// Two unit vectors across the middle of a hole, from which meridians are counted.
fn meridian_axes(middle: vec3f) -> array<vec3f, 2> {
    let first = perpendicular(middle);
    return array(first, cross(middle, first));
}

// Which meridian a direction is on: a whole number and a fraction.
fn meridian_of(direction: vec3f, middle: vec3f) -> f32 {
    let axes = meridian_axes(middle);
    let turn = atan2(dot(direction, axes[1]), dot(direction, axes[0])) / TAU;
    return fract(turn) * f32(HOLE_MERIDIANS);
}

fn angle_from(direction: vec3f, middle: vec3f) -> f32 {
    return atan2(length(cross(direction, middle)), dot(direction, middle));
}

// Thickness at an angle from the middle with the hole in the film, for its thickness without.
fn pierced(rim: Rim, angle: f32, thickness_nm: f32) -> f32 {
    if (angle >= rim.outer_rad) {
        return thickness_nm;
    }
    return select(0.0, rim.thickness_nm, angle >= rim.inner_rad);
}

fn mixed(low: Rim, high: Rim, t: f32) -> Rim {
    return Rim(
        mix(low.outer_rad, high.outer_rad, t),
        mix(low.inner_rad, high.inner_rad, t),
        mix(low.thickness_nm, high.thickness_nm, t),
        0.0,
    );
}
