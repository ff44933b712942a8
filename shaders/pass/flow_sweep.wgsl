// A damped Jacobi sweep of (laplacian - k) psi = f on the finest grid. One invocation for four cells of a row.

import package::flow::laplacian::four_cells;
import package::flow::solve::Solve;
import package::sphere::cubed::{HALO, padded_index};

// Which of the sweeps after a correction.
override SWEEP: u32;

@group(0) @binding(0) var<uniform> solve: Solve;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> source: array<f32>;
@group(0) @binding(3) var<storage, read> psi: array<f32>;
@group(0) @binding(4) var<storage, read_write> psi_after: array<f32>;

@compute @workgroup_size(16)
fn flow_sweep(@builtin(global_invocation_id) id: vec3u) {
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
    let angle2 = solve.cell_angle * solve.cell_angle;
    let residual = f - four.laplacian / angle2 + system.shift * four.here;
    let after = four.here + system.weights[SWEEP] * residual / (four.own / angle2 - system.shift);
    psi_after[at] = after.x;
    psi_after[at + 1u] = after.y;
    psi_after[at + 2u] = after.z;
    psi_after[at + 3u] = after.w;
}
