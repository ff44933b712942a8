// Adds the next grid's correction, interpolated, to psi on the finest. One invocation per cell.

import package::flow::solve::Solve;
import package::sphere::cubed::{HALO, padded_index};

@group(0) @binding(0) var<uniform> solve: Solve;
@group(0) @binding(1) var<storage, read> correction: array<f32>;
@group(0) @binding(2) var<storage, read> psi: array<f32>;
@group(0) @binding(3) var<storage, read_write> psi_after: array<f32>;

@compute @workgroup_size(8, 8)
fn flow_correct(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(solve.cells))) {
        return;
    }
    let place = (vec2f(id.xy) + 0.5) * f32(solve.coarse_cells) / f32(solve.cells) - 0.5;
    let t = place - floor(place);
    let first = solve.coarse_field + padded_index(id.z, i32(floor(place.x)), i32(floor(place.y)), solve.coarse_cells);
    let above = first + solve.coarse_cells + 2u * HALO;
    let found = mix(mix(correction[first], correction[first + 1u], t.x), mix(correction[above], correction[above + 1u], t.x), t.y);
    let at = padded_index(id.z, i32(id.x), i32(id.y), solve.cells);
    psi_after[at] = psi[at] + found;
}
