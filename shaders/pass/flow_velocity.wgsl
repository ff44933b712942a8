// The velocity of the stream function, and that half a step later, extrapolated from a step ago. One invocation per cell.

import package::flow::operators::{first_difference, turned_gradient, valid_or_zero};
import package::flow::step::Flow;
import package::sphere::cubed::{HALO, padded_index};

@group(0) @binding(0) var<uniform> flow: Flow;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> psi: array<f32>;
@group(0) @binding(3) var<storage, read> psi_before: array<f32>;
@group(0) @binding(4) var<storage, read_write> velocity: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> velocity_ahead: array<vec4f>;

fn slope(at: u32, step: u32) -> f32 {
    return first_difference(vec4f(psi[at - 2u * step], psi[at - step], psi[at + step], psi[at + 2u * step]));
}

fn slope_before(at: u32, step: u32) -> f32 {
    return first_difference(
        vec4f(psi_before[at - 2u * step], psi_before[at - step], psi_before[at + step], psi_before[at + 2u * step])
    );
}

@compute @workgroup_size(8, 8)
fn flow_velocity(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(flow.cells))) {
        return;
    }
    let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
    let side = flow.cells + 2u * HALO;
    let tangent = vec2f(tangents[id.x + HALO], tangents[id.y + HALO]);
    let now = vec2f(slope(at, 1u), slope(at, side)) / flow.cell_angle;
    let before = vec2f(slope_before(at, 1u), slope_before(at, side)) / flow.cell_angle;
    velocity[at] = vec4f(turned_gradient(id.z % 6u, tangent, now), 0.0);
    velocity_ahead[at] = vec4f(turned_gradient(id.z % 6u, tangent, 1.5 * now - 0.5 * before), 0.0);
}
