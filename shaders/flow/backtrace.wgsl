// Where liquid came from, in a velocity field that a pass declares as `velocity: array<vec4f>`: Cartesian, in rad/s, in padded storage, film after
// film.

import package::sphere::cubed::{cubic_stencil, locate_in};

fn velocity_row(row: u32, w: vec4f) -> vec3f {
    return w.x * velocity[row].xyz + w.y * velocity[row + 1u].xyz + w.z * velocity[row + 2u].xyz + w.w * velocity[row + 3u].xyz;
}

// Bicubic interpolation on the grid of a film, with `cells` cells per edge.
fn velocity_at(film: u32, x: vec3f, cells: u32) -> vec3f {
    let at = cubic_stencil(locate_in(film, x, cells), cells);
    return at.wj.x * velocity_row(at.first, at.wi) + at.wj.y * velocity_row(at.first + at.stride, at.wi) +
        at.wj.z * velocity_row(at.first + 2u * at.stride, at.wi) + at.wj.w * velocity_row(at.first + 3u * at.stride, at.wi);
}

// Where three iterates lead to in the end, in the tangent plane at x: Aitken's extrapolation, with vectors for complex numbers. It is exact
// within an eddy, whose turn by more than a radian in a step the iteration alone would not follow: it would spiral outwards.
fn extrapolated(x: vec3f, first: vec3f, second: vec3f, third: vec3f) -> vec3f {
    let before = second - first;
    let last = third - second;
    let ratio = vec2f(dot(before, last), dot(x, cross(before, last))) / max(dot(before, before), 1e-30);
    let rest = vec2f(1.0, 0.0) - ratio;
    // Next to 1 it says nothing.
    let factor = vec2f(ratio.x - dot(ratio, ratio), ratio.y) / max(dot(rest, rest), 0.25);
    return third + factor.x * last + factor.y * cross(x, last);
}

// Where the liquid of a film at unit vector x was a time dt_s ago, in a steady flow whose velocity at x is given: the implicit midpoint rule on the
// sphere. The origin is x reflected at the middle, a symmetric step along a great circle, so that circles stay circles.
fn backtrace(film: u32, x: vec3f, velocity_at_x: vec3f, dt_s: f32, cells: u32) -> vec3f {
    let once = velocity_at(film, x - 0.5 * dt_s * velocity_at_x, cells);
    let twice = velocity_at(film, x - 0.5 * dt_s * once, cells);
    let u = velocity_at(film, x - 0.5 * dt_s * extrapolated(x, velocity_at_x, once, twice), cells);
    let middle = normalize(x - 0.5 * dt_s * u);
    return 2.0 * dot(x, middle) * middle - x;
}
