// Where liquid came from, in a velocity field that a pass declares as `velocity: array<vec4f>`: Cartesian, in rad/s, in padded storage.

import package::sphere::cubed::{cubic_stencil, locate};

// Improvements of the velocity at the middle of a backtrace; each multiplies its error by about dt |grad u| / 2.
override BACKTRACE_ITERATIONS: u32;

fn velocity_row(row: u32, w: vec4f) -> vec3f {
    return w.x * velocity[row].xyz + w.y * velocity[row + 1u].xyz + w.z * velocity[row + 2u].xyz + w.w * velocity[row + 3u].xyz;
}

// Bicubic interpolation on a grid of so many cells an edge.
fn velocity_at(x: vec3f, cells: u32) -> vec3f {
    let at = cubic_stencil(locate(x, cells), cells);
    return at.wj.x * velocity_row(at.first, at.wi) + at.wj.y * velocity_row(at.first + at.stride, at.wi) +
        at.wj.z * velocity_row(at.first + 2u * at.stride, at.wi) + at.wj.w * velocity_row(at.first + 3u * at.stride, at.wi);
}

// Where the liquid at unit vector x was a time dt_s ago, in a steady flow whose velocity at x is given: the implicit midpoint rule on the
// sphere. The origin is x reflected at the middle, a symmetric step along a great circle, so that circles stay circles.
fn backtrace(x: vec3f, velocity_at_x: vec3f, dt_s: f32, cells: u32) -> vec3f {
    var u = velocity_at_x;
    for (var k = 0u; k < BACKTRACE_ITERATIONS; k++) {
        u = velocity_at(x - 0.5 * dt_s * u, cells);
    }
    let middle = normalize(x - 0.5 * dt_s * u);
    return 2.0 * dot(x, middle) * middle - x;
}
