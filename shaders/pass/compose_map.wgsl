// Composes the film's flow map with a step: map(x) = where the liquid now at x was when the tracer was last remapped, and what it has
// gathered since. One invocation a cell, halo included. The step may have been traced on a coarser grid: flows are smooth.

import package::film::control::Control;
import package::sphere::cubed::{cell_place, is_cell, panel_direction};
import package::sphere::lookup::{map_at_cell, healed, map_at};

// 1: the step was traced on the map's own grid.
override SAME_GRID: u32;
// 0: there is no map yet, and the step is all there is.
override HAS_MAP: u32;
// 0: nothing is gathered, and the fourth number of every map is 0, which need not be loaded.
override GATHERS: u32;

// Mirrors `ComposeUniform` in src/gpu/compose_map.rs.
struct Compose {
    // Cells along a panel's edge, of the map and of the step.
    cells: u32,
    step_cells: u32,
}

@group(0) @binding(0) var<uniform> compose: Compose;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> control: Control;
@group(0) @binding(3) var<storage, read> step_map: array<vec4f>;
@group(0) @binding(4) var<storage, read> map_before: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> map_after: array<vec4f>;

const STEP_MAP: u32 = 0u;
const MAP_BEFORE: u32 = 1u;

fn map_value(map: u32, place: u32) -> vec4f {
    if (map == STEP_MAP) {
        return vec4f(step_map[place].x, step_map[place].y, step_map[place].z, step_gathered(place));
    }
    return vec4f(map_before[place].x, map_before[place].y, map_before[place].z, gathered_before(place));
}

fn step_gathered(place: u32) -> f32 {
    if (GATHERS == 0u) {
        return 0.0;
    }
    return step_map[place].w;
}

fn gathered_before(place: u32) -> f32 {
    if (GATHERS == 0u) {
        return 0.0;
    }
    return map_before[place].w;
}

// No tracer is looked up here.
fn tracer_value(place: u32) -> f32 {
    return 0.0;
}

@compute @workgroup_size(8, 8)
fn compose_map(@builtin(global_invocation_id) id: vec3u) {
    if (!is_cell(id, compose.cells)) {
        return;
    }
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
    var origin: vec4f;
    if (SAME_GRID == 1u) {
        origin = step_map[cell_place(id, compose.cells)];
    } else {
        origin = map_at_cell(STEP_MAP, id, compose.cells, x, compose.step_cells);
    }
    if (HAS_MAP == 1u) {
        let before = map_at(MAP_BEFORE, origin.xyz, compose.cells);
        origin = vec4f(before.xyz, origin.w + before.w);
    }
    if (healed > 0u) {
        atomicAdd(&control.healed, healed);
    }
    map_after[cell_place(id, compose.cells)] = origin;
}
