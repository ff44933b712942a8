// Where liquid came from, in a velocity field that a pass declares as `velocity: array<vec4f>`: Cartesian, in rad/s, in padded storage, film after
// film.

import package::sphere::cubed::{cubic_stencil, locate_in};

// Four velocities of a row.
fn velocity_row(row: u32) -> array<vec3f, 4> {
    return array(velocity[row].xyz, velocity[row + 1u].xyz, velocity[row + 2u].xyz, velocity[row + 3u].xyz);
}

fn along_row(row: array<vec3f, 4>, w: vec4f) -> vec3f {
    return w.x * row[0] + w.y * row[1] + w.z * row[2] + w.w * row[3];
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
// sphere, with bicubic interpolation on a grid of `cells` cells per edge. The origin is x reflected at the middle, a symmetric step along a great
// circle, so that circles stay circles. The middle is found in three rounds, which mostly lead to the same 4 x 4 cells: those are read once, for
// reading is what this costs.
fn backtrace(film: u32, x: vec3f, velocity_at_x: vec3f, dt_s: f32, cells: u32) -> vec3f {
    var at = cubic_stencil(locate_in(film, x - 0.5 * dt_s * velocity_at_x, cells), cells);
    var rounds = 0u;
    var once: vec3f;
    var u: vec3f;
    loop {
        let a = velocity_row(at.first);
        let b = velocity_row(at.first + at.stride);
        let c = velocity_row(at.first + 2u * at.stride);
        let d = velocity_row(at.first + 3u * at.stride);
        let read = at.first;
        loop {
            u = at.wj.x * along_row(a, at.wi) + at.wj.y * along_row(b, at.wi) + at.wj.z * along_row(c, at.wi) +
                at.wj.w * along_row(d, at.wi);
            rounds++;
            // After the second round comes what all of them lead to.
            let guess = select(extrapolated(x, velocity_at_x, once, u), u, rounds == 1u);
            once = select(once, u, rounds == 1u);
            at = cubic_stencil(locate_in(film, x - 0.5 * dt_s * guess, cells), cells);
            if (rounds == 3u || at.first != read) {
                break;
            }
        }
        if (rounds == 3u) {
            break;
        }
    }
    let middle = normalize(x - 0.5 * dt_s * u);
    return 2.0 * dot(x, middle) * middle - x;
}
