// Advances the flow map by a step whose backtrace was made on a coarser grid: flows are smooth, and tracing them is what costs.
// One invocation a cell of the fine grid.

import package::sphere::cubed::{HALO, cubic_stencil, locate, padded_index, panel_direction};

// Mirrors `ComposeUniform` in src/gpu/compose_map.rs.
struct Compose {
    // Cells along a panel's edge, of the map and of the step.
    cells: u32,
    step_cells: u32,
    // 1 right after a remap, when the map is the identity and there is nothing to look up.
    map_is_identity: u32,
}

@group(0) @binding(0) var<uniform> compose: Compose;
// tan(alpha) of each cell coordinate of the fine grid, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
// Where the liquid at a cell of the coarse grid was one step ago.
@group(0) @binding(2) var<storage, read> step_map: array<vec4f>;
@group(0) @binding(3) var<storage, read> map_before: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> map_after: array<vec4f>;

fn step_row(row: u32, w: vec4f) -> vec3f {
    return w.x * step_map[row].xyz + w.y * step_map[row + 1u].xyz + w.z * step_map[row + 2u].xyz + w.w * step_map[row + 3u].xyz;
}

fn step_at(x: vec3f) -> vec3f {
    let at = cubic_stencil(locate(x, compose.step_cells), compose.step_cells);
    return normalize(at.wj.x * step_row(at.first, at.wi) + at.wj.y * step_row(at.first + at.stride, at.wi) +
        at.wj.z * step_row(at.first + 2u * at.stride, at.wi) + at.wj.w * step_row(at.first + 3u * at.stride, at.wi));
}

fn map_row(row: u32, w: vec4f) -> vec3f {
    return w.x * map_before[row].xyz + w.y * map_before[row + 1u].xyz + w.z * map_before[row + 2u].xyz +
        w.w * map_before[row + 3u].xyz;
}

fn map_at(x: vec3f) -> vec3f {
    let at = cubic_stencil(locate(x, compose.cells), compose.cells);
    return normalize(at.wj.x * map_row(at.first, at.wi) + at.wj.y * map_row(at.first + at.stride, at.wi) +
        at.wj.z * map_row(at.first + 2u * at.stride, at.wi) + at.wj.w * map_row(at.first + 3u * at.stride, at.wi));
}

@compute @workgroup_size(64)
fn compose_map(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= compose.cells) {
        return;
    }
    let tangent = vec2f(tangents[id.x + HALO], tangents[id.y + HALO]);
    var origin = step_at(panel_direction(id.z, tangent));
    if (compose.map_is_identity == 0u) {
        origin = map_at(origin);
    }
    map_after[padded_index(id.z, i32(id.x), i32(id.y), compose.cells)] = vec4f(origin, 0.0);
}
