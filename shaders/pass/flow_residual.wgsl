// What is left of f - (laplacian - k) psi on the finest grid. One invocation for four cells of a row.

import package::flow::laplacian::four_cells;
import package::flow::solve::Solve;
import package::sphere::cubed::{HALO, padded_index};

@group(0) @binding(0) var<uniform> solve: Solve;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> source: array<f32>;
@group(0) @binding(3) var<storage, read> psi: array<f32>;
@group(0) @binding(4) var<storage, read_write> left: array<f32>;

@compute @workgroup_size(16)
fn flow_residual(@builtin(global_invocation_id) id: vec3u) {
    if (4u * id.x >= solve.cells) {
        return;
    }
    // Where four do not divide a row, the last four overlap others, with the same answer.
    let i = min(4u * id.x, solve.cells - 4u);
    let k = i + HALO;
    let at = padded_index(id.z, i32(i), i32(id.y), solve.cells);
    let along = vec4f(tangents[k], tangents[k + 1u], tangents[k + 2u], tangents[k + 3u]);
    let four = four_cells(at, solve.cells + 2u * HALO, along, tangents[id.y + HALO]);
    let system = solve.systems[id.z / 6u];
    let f = system.gain * vec4f(source[at], source[at + 1u], source[at + 2u], source[at + 3u]);
    let found = f - four.laplacian / (solve.cell_angle * solve.cell_angle) + system.shift * four.here;
    left[at] = found.x;
    left[at + 1u] = found.y;
    left[at + 2u] = found.z;
    left[at + 3u] = found.w;
}
