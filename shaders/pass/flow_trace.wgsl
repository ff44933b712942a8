// Carries fields along a steady flow for one step: each cell gets the value at the place where its liquid came from. One invocation per cell.

import package::flow::backtrace::backtrace;
import package::flow::step::Flow;
import package::sphere::cubed::{CubicStencil, HALO, cubic_stencil, locate_in, padded_index, panel_direction};

@group(0) @binding(0) var<uniform> flow: Flow;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> velocity: array<vec4f>;
// What is left of vorticity and what is added after half a step, at the cells that liquid comes from, and the part that is left.
@group(0) @binding(3) var<storage, read> pushed: array<vec2f>;
@group(0) @binding(4) var<storage, read> decay: array<f32>;
@group(0) @binding(5) var<storage, read_write> first_stage: array<f32>;
@group(0) @binding(6) var<storage, read_write> second_stage: array<f32>;
// A field that nothing but the flow changes.
@group(0) @binding(3) var<storage, read> field: array<f32>;
@group(0) @binding(4) var<storage, read_write> moved: array<f32>;

// That of 2.
const ROOT: f32 = 1.41421356;

fn origin(id: vec3u, at: u32) -> CubicStencil {
    let film = id.z / 6u;
    let x = normalize(panel_direction(id.z % 6u, vec2f(tangents[id.x + HALO], tangents[id.y + HALO])));
    let origin = backtrace(film, x, velocity[at].xyz, flow.dt_s, flow.cells);
    return cubic_stencil(locate_in(film, origin, flow.cells), flow.cells);
}

fn pushed_row(row: u32, w: vec4f) -> vec2f {
    return w.x * pushed[row] + w.y * pushed[row + 1u] + w.z * pushed[row + 2u] + w.w * pushed[row + 3u];
}

fn field_row(row: u32, w: vec4f) -> f32 {
    return dot(w, vec4f(field[row], field[row + 1u], field[row + 2u], field[row + 3u]));
}

// Vorticity, as the two stages of viscosity take it: see `FlowSolver::viscous` in src/physics/flow/solver.rs. Their sum is what is there
// without viscosity.
@compute @workgroup_size(8, 8)
fn trace_vorticity(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(flow.cells))) {
        return;
    }
    let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
    let source = origin(id, at);
    let carried = source.wj.x * pushed_row(source.first, source.wi) +
        source.wj.y * pushed_row(source.first + source.stride, source.wi) +
        source.wj.z * pushed_row(source.first + 2u * source.stride, source.wi) +
        source.wj.w * pushed_row(source.first + 3u * source.stride, source.wi);
    let zeta = decay[at] * carried.x;
    let added = decay[at] * carried.y + pushed[at].y;
    first_stage[at] = (1.0 + ROOT) * zeta + added / ROOT;
    second_stage[at] = (1.0 - 1.0 / ROOT) * added - ROOT * zeta;
}

@compute @workgroup_size(8, 8)
fn trace_tracer(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(flow.cells))) {
        return;
    }
    let at = padded_index(id.z, i32(id.x), i32(id.y), flow.cells);
    let source = origin(id, at);
    let rows = vec4f(
        field_row(source.first, source.wi),
        field_row(source.first + source.stride, source.wi),
        field_row(source.first + 2u * source.stride, source.wi),
        field_row(source.first + 3u * source.stride, source.wi),
    );
    moved[at] = dot(source.wj, rows);
}
