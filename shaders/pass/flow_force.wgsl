// What half a step of drag leaves of vorticity, and what half a step of the forces adds to it. Values that cannot be used are left out
// here, so that they reach nothing else. One invocation per cell.

import package::flow::operators::{first_difference, turned_gradient, is_valid, valid_or_zero};
import package::flow::step::{Flow, Forces, Measures};
import package::sphere::cubed::{HALO, padded_index};

@group(0) @binding(0) var<uniform> flow: Flow;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> measures: array<Measures>;
@group(0) @binding(3) var<storage, read> zeta: array<f32>;
@group(0) @binding(4) var<storage, read> log_thickness: array<f32>;
@group(0) @binding(5) var<storage, read> velocity: array<vec4f>;
// What stirs the film besides, 1/s2.
@group(0) @binding(6) var<storage, read> forcing: array<f32>;
// What is left of vorticity, and what is added, 1/s.
@group(0) @binding(7) var<storage, read_write> pushed: array<vec2f>;
// The part that is left.
@group(0) @binding(8) var<storage, read_write> decay: array<f32>;
// On each film.
@group(0) @binding(9) var<uniform> forces: array<Forces, 64>;

fn slope(at: u32, step: u32) -> f32 {
    return first_difference(vec4f(
        valid_or_zero(log_thickness[at - 2u * step]),
        valid_or_zero(log_thickness[at - step]),
        valid_or_zero(log_thickness[at + step]),
        valid_or_zero(log_thickness[at + 2u * step]),
    )) / flow.cell_angle;
}

@compute @workgroup_size(8, 8)
fn flow_force(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(flow.cells))) {
        return;
    }
    let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
    let tangent = vec2f(tangents[id.x + HALO], tangents[id.y + HALO]);
    let turned = turned_gradient(id.z % 6u, tangent, vec2f(slope(at, 1u), slope(at, flow.cells + 2u * HALO)));
    let film = id.z / 6u;
    let half_step = half_of_forces(forces[film], at, turned);
    decay[at] = half_step.x;
    pushed[at] = vec2f(half_step.x * (valid_or_zero(zeta[at]) - measures[film].zeta_mean), half_step.y);
}

// What forces that hold still do in half a step, exactly, however strong: what drag leaves, and what is added. See `HalfStep` in
// src/physics/flow/solver.rs.
fn half_of_forces(force: Forces, at: u32, turned: vec3f) -> vec2f {
    let u = velocity[at].xyz;
    // No film is so much thinner than its mean, and nothing stands in for one whose thickness cannot be used.
    let thin = select(0.0, exp(-max(log_thickness[at], -12.0)), is_valid(log_thickness[at]));
    let of_air = force.air_drag * sqrt(max(length(u), flow.min_air_speed)) * thin;
    let x = 0.5 * flow.dt_s * (force.drag + of_air);
    let decay = exp(-x);
    // (1 - exp(-x)) / x, by its series where the difference would be all rounding.
    let decayed = select((1.0 - decay) / x, 1.0 - x * (0.5 - x / 6.0), x < 0.02);
    let source = dot(force.gravity + of_air * u, turned) + valid_or_zero(forcing[at]);
    return vec2f(decay, valid_or_zero(0.5 * flow.dt_s * decayed * source));
}
