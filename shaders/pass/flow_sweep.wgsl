// A damped Jacobi sweep of (laplacian - k) psi = f on the finest grid. One invocation for four cells of each of two rows.

import package::flow::laplacian::{FourCells, eight_cells};
import package::flow::solve::{FilmSystem, Solve};

// Which of the sweeps after a correction.
override SWEEP: u32;

@group(0) @binding(0) var<uniform> solve: Solve;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> source: array<f32>;
@group(0) @binding(3) var<storage, read> psi: array<f32>;
@group(0) @binding(4) var<storage, read_write> psi_after: array<f32>;

fn sweep(at: u32, four: FourCells, system: FilmSystem) {
    let f = system.gain * vec4f(source[at], source[at + 1u], source[at + 2u], source[at + 3u]);
    let residual = f - four.laplacian + system.shift * four.here;
    let after = four.here + system.weights[SWEEP] * residual / (four.own - system.shift);
    psi_after[at] = after.x;
    psi_after[at + 1u] = after.y;
    psi_after[at + 2u] = after.z;
    psi_after[at + 3u] = after.w;
}

@compute @workgroup_size(8, 4)
fn flow_sweep(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy * vec2u(4u, 2u) >= vec2u(solve.cells))) {
        return;
    }
    let eight = eight_cells(id, solve.cells, solve.per_angle2);
    let system = solve.systems[id.z / 6u];
    sweep(eight.at.x, eight.rows[0], system);
    sweep(eight.at.y, eight.rows[1], system);
}
