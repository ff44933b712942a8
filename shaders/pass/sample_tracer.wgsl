// Looks the tracer up through the flow map: the thickness that is at x now is the one that was at map(x) at the last remap.
// Into the shown film it is what the picture colours; into the tracer itself it is a remap. One invocation a cell.

import package::sphere::cubed::{cubic_stencil, locate, padded_index};

// Mirrors `GridUniform` in src/gpu/film.rs.
struct Grid {
    cells: u32,
}

@group(0) @binding(0) var<uniform> grid: Grid;
@group(0) @binding(1) var<storage, read> map: array<vec4f>;
@group(0) @binding(2) var<storage, read> tracer: array<f32>;
@group(0) @binding(3) var<storage, read_write> sampled: array<f32>;

@compute @workgroup_size(64)
fn sample_tracer(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= grid.cells) {
        return;
    }
    let cell = padded_index(id.z, i32(id.x), i32(id.y), grid.cells);
    let stencil = cubic_stencil(locate(map[cell].xyz, grid.cells), grid.cells);
    var total = 0.0;
    for (var j = 0u; j < 4u; j++) {
        let row = stencil.first + j * stencil.stride;
        total += stencil.wj[j] * dot(stencil.wi, vec4f(tracer[row], tracer[row + 1u], tracer[row + 2u], tracer[row + 3u]));
    }
    sampled[cell] = total;
}
