// Stirs and jets of the user: adds the source of vorticity of each push to the draught's (flow_gusts). One invocation per cell. The f64 truth is
// `Push::source` in src/physics/film/push.rs.

import package::sphere::cubed::{HALO, padded_index, panel_direction};

const MAX_PUSHES: u32 = 32u;

struct Push {
    center: vec3f,
    sharpness: f32,
    // Velocity towards which the film is drawn, rad/s, and how fast it is, 1/s.
    velocity: vec3f,
    rate: f32,
}

// Mirrors `PushesUniform` in src/gpu/passes/flow_push.rs.
struct Pushes {
    // Cells along a panel's edge.
    cells: u32,
    // Pushes in use; those come first.
    count: u32,
    // Which of the films that flow together.
    film: u32,
    pushes: array<Push, 32>,
}

@group(0) @binding(0) var<uniform> pushes: Pushes;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
// Velocity and vorticity of the film.
@group(0) @binding(2) var<storage, read> velocity: array<vec4f>;
@group(0) @binding(3) var<storage, read> zeta: array<f32>;
@group(0) @binding(4) var<storage, read_write> forcing: array<f32>;

fn push_source(push: Push, x: vec3f, u: vec3f, vorticity: f32) -> f32 {
    let strength = push.rate * exp(push.sharpness * (dot(push.center, x) - 1.0));
    return strength * (push.sharpness * dot(x, cross(push.center, push.velocity - u)) - vorticity);
}

@compute @workgroup_size(8, 8)
fn flow_push(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(pushes.cells))) {
        return;
    }
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x + HALO], tangents[id.y + HALO])));
    let at = padded_index(6u * pushes.film + id.z, i32(id.x), i32(id.y), pushes.cells);
    var source = 0.0;
    for (var k = 0u; k < min(pushes.count, MAX_PUSHES); k++) {
        source += push_source(pushes.pushes[k], x, velocity[at].xyz, zeta[at]);
    }
    forcing[at] += source;
}
