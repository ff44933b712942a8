// Carries a field along a steady flow for one step: its value is that of where the liquid came from. What acts in the second half of the
// step follows: drag and a push. One invocation a cell.

import package::flow::backtrace::backtrace;
import package::flow::step::Flow;
import package::sphere::cubed::{HALO, cubic_stencil, locate, padded_index, panel_direction};

@group(0) @binding(0) var<uniform> flow: Flow;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> velocity: array<vec4f>;
@group(0) @binding(3) var<storage, read> field: array<f32>;
@group(0) @binding(4) var<storage, read_write> moved: array<f32>;
@group(0) @binding(5) var<storage, read> half_step: array<vec2f>;

fn field_row(row: u32, w: vec4f) -> f32 {
    return dot(w, vec4f(field[row], field[row + 1u], field[row + 2u], field[row + 3u]));
}

fn field_at(x: vec3f) -> f32 {
    let at = cubic_stencil(locate(x, flow.cells), flow.cells);
    let rows = vec4f(
        field_row(at.first, at.wi),
        field_row(at.first + at.stride, at.wi),
        field_row(at.first + 2u * at.stride, at.wi),
        field_row(at.first + 3u * at.stride, at.wi),
    );
    return dot(at.wj, rows);
}

fn carried(id: vec3u, at: u32) -> f32 {
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x + HALO], tangents[id.y + HALO])));
    return field_at(backtrace(x, velocity[at].xyz, flow.dt_s, flow.cells));
}

// Vorticity.
@compute @workgroup_size(64)
fn trace_vorticity(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < flow.cells) {
        let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
        moved[at] = half_step[at].x * carried(id, at) + half_step[at].y;
    }
}

// A field that nothing but the flow changes.
@compute @workgroup_size(64)
fn trace_tracer(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < flow.cells) {
        let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
        moved[at] = carried(id, at);
    }
}
