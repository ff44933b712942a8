// What is left of f - (laplacian - k) psi on the finest grid. One invocation for four cells of each of two rows.

import package::flow::laplacian::{FourCells, eight_cells};
import package::flow::solve::{FilmSystem, Solve};

@group(0) @binding(0) var<uniform> solve: Solve;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> source: array<f32>;
@group(0) @binding(3) var<storage, read> psi: array<f32>;
@group(0) @binding(4) var<storage, read_write> left: array<f32>;

fn find(at: u32, four: FourCells, system: FilmSystem) {
    let f = system.gain * vec4f(source[at], source[at + 1u], source[at + 2u], source[at + 3u]);
    let found = f - four.laplacian + system.shift * four.here;
    left[at] = found.x;
    left[at + 1u] = found.y;
    left[at + 2u] = found.z;
    left[at + 3u] = found.w;
}

@compute @workgroup_size(8, 4)
fn flow_residual(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy * vec2u(4u, 2u) >= vec2u(solve.cells))) {
        return;
    }
    let eight = eight_cells(id, solve.cells, solve.per_angle2);
    let system = solve.systems[id.z / 6u];
    find(eight.at.x, eight.rows[0], system);
    find(eight.at.y, eight.rows[1], system);
}
