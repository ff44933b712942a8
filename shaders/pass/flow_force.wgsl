// The first half of what acts on vorticity in a step: half of the drag, then half of the push of buoyancy, which is kept for the second
// half. Values that cannot be used are left out here, so that they reach nothing else. One invocation a cell.

import package::flow::operators::{first_difference, turned_gradient, usable_or_zero};
import package::flow::step::{Flow, Measures};
import package::sphere::cubed::{HALO, padded_index};

@group(0) @binding(0) var<uniform> flow: Flow;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> measures: Measures;
@group(0) @binding(3) var<storage, read> zeta: array<f32>;
@group(0) @binding(4) var<storage, read> log_thickness: array<f32>;
@group(0) @binding(5) var<storage, read_write> pushed: array<f32>;
@group(0) @binding(6) var<storage, read_write> push: array<f32>;

fn slope(at: u32, step: u32) -> f32 {
    return first_difference(vec4f(
        usable_or_zero(log_thickness[at - 2u * step]),
        usable_or_zero(log_thickness[at - step]),
        usable_or_zero(log_thickness[at + step]),
        usable_or_zero(log_thickness[at + 2u * step]),
    )) / flow.cell_angle;
}

@compute @workgroup_size(64)
fn flow_force(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= flow.cells) {
        return;
    }
    let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
    let tangent = vec2f(tangents[id.x + HALO], tangents[id.y + HALO]);
    let turned = turned_gradient(id.z, tangent, vec2f(slope(at, 1u), slope(at, flow.cells + 2u * HALO)));
    push[at] = usable_or_zero(0.5 * flow.dt_s * dot(flow.gravity, turned));
    pushed[at] = flow.half_decay * (usable_or_zero(zeta[at]) - measures.zeta_mean) + push[at];
}
