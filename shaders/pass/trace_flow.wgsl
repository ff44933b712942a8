// Traces one step back in a solved flow, whose velocity stands still meanwhile: from each cell to where its liquid was when the step began.
// One invocation per cell, halo included.

import package::flow::backtrace::backtrace;
import package::sphere::cubed::{cell_place, is_cell, panel_direction};

// Mirrors `SolvedUniform` in src/gpu/passes/trace_flow.rs.
struct Solved {
    dt_s: f32,
    // Cells along a panel's edge.
    cells: u32,
    // Which of the films that flow together.
    film: u32,
}

@group(0) @binding(0) var<uniform> solved: Solved;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> velocity: array<vec4f>;
@group(0) @binding(3) var step_map: texture_storage_2d_array<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn trace_flow(@builtin(global_invocation_id) id: vec3u) {
    if (!is_cell(id, solved.cells)) {
        return;
    }
    let here = velocity[cell_place(id + vec3u(0u, 0u, 6u * solved.film), solved.cells)].xyz;
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
    // Nothing is gathered in a flow that does not diverge.
    textureStore(step_map, id.xy, id.z, vec4f(backtrace(solved.film, x, here, solved.dt_s, solved.cells), 0.0));
}
