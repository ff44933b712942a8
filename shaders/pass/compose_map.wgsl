// Composes the film's flow map with a step: map(x) = where the liquid now at x was when the tracer was last remapped, and what it has
// gathered since. Halos are included. The step may have been traced on a coarser grid: flows are smooth.

import package::film::control::Control;
import package::sphere::cubed::{is_cell, is_quad, panel_direction, quad_cell};
import package::sphere::lookup::{map_at, map_at_cell, map_at_quad, sanitised};

// 1: the step was traced on the map's own grid.
override SAME_GRID: u32;
// 0: there is no map yet, and the step is all there is.
override HAS_MAP: u32;

// Mirrors `ComposeUniform` in src/gpu/passes/compose_map.rs.
struct Compose {
    // Cells along a panel's edge, of the map and of the step.
    cells: u32,
    step_cells: u32,
    // Cells that the first two by two begin before storage does: 0 or 1.
    quad_skew: u32,
}

@group(0) @binding(0) var<uniform> compose: Compose;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> control: Control;
@group(0) @binding(3) var step_map: texture_2d_array<f32>;
@group(0) @binding(4) var map_before: texture_2d_array<f32>;
@group(0) @binding(5) var map_after: texture_storage_2d_array<rgba32float, write>;

const STEP_MAP: u32 = 0u;
const MAP_BEFORE: u32 = 1u;

fn map_texel(map: u32, texel: vec2u, panel: u32) -> vec4f {
    if (map == STEP_MAP) {
        return textureLoad(step_map, texel, panel, 0);
    }
    return textureLoad(map_before, texel, panel, 0);
}

// No tracer is looked up here.
fn tracer_texels(texel: vec2u, panel: u32) -> vec4f {
    return vec4f(0.0);
}

fn direction_at(id: vec3u) -> vec3f {
    return normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
}

// Where the step and then the map before it lead.
fn composed(step: vec4f) -> vec4f {
    if (HAS_MAP == 0u) {
        return step;
    }
    let before = map_at(MAP_BEFORE, step.xyz, compose.cells);
    return vec4f(before.xyz, step.w + before.w);
}

fn store(cell: vec3u, origin: vec4f) {
    if (is_cell(cell, compose.cells)) {
        textureStore(map_after, cell.xy, cell.z, origin);
    }
}

fn count_sanitised() {
    if (sanitised > 0u) {
        atomicAdd(&control.sanitised, sanitised);
    }
}

@compute @workgroup_size(8, 8)
fn compose_map(@builtin(global_invocation_id) id: vec3u) {
    if (!is_cell(id, compose.cells)) {
        return;
    }
    var step: vec4f;
    if (SAME_GRID == 1u) {
        step = textureLoad(step_map, id.xy, id.z, 0);
    } else {
        step = map_at_cell(STEP_MAP, id, compose.cells, direction_at(id), compose.step_cells);
    }
    textureStore(map_after, id.xy, id.z, composed(step));
    count_sanitised();
}

// One invocation for two by two cells, where the step's are an even number of times as wide.
@compute @workgroup_size(8, 8)
fn compose_quads(@builtin(global_invocation_id) id: vec3u) {
    let first = 2 * vec2i(id.xy) - i32(compose.quad_skew);
    if (!is_quad(first, compose.cells)) {
        return;
    }
    let direction = direction_at(vec3u(vec2u(max(first, vec2i(0))), id.z));
    let steps = map_at_quad(STEP_MAP, first, id.z, compose.cells, direction, compose.step_cells);
    // Each by itself: software rasterisers keep what a loop reads in memory.
    store(quad_cell(first, 0u, id.z), composed(steps[0]));
    store(quad_cell(first, 1u, id.z), composed(steps[1]));
    store(quad_cell(first, 2u, id.z), composed(steps[2]));
    store(quad_cell(first, 3u, id.z), composed(steps[3]));
    count_sanitised();
}
