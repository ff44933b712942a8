// Diffusion of a film's thickness, a stage of a Runge-Kutta-Legendre step of first order (Meyer, Balsara & Aslam 2012, MNRAS 422): three
// stages are stable for six times as long as one explicit step, and never make a new extreme. Stage k reaches k cells into the halo less.
// One invocation for two by two cells, halo included: they share most of what they read, and reading is what a stage costs.

import package::film::control::Control;
import package::sphere::cubed::HALO;

// Mirrors `DiffuseUniform` in src/gpu/passes/diffuse.rs.
struct Diffuse {
    // Cells along a panel's edge.
    cells: u32,
    // Which stage, from 1.
    stage: u32,
    // Squared cell angles that liquid spreads over in a tick and in this part of the step, times the stages' weight.
    rate: f32,
    // Maximum in any one part.
    max_spread: f32,
    // Factors of the stage before and of that before it.
    before: f32,
    earlier: f32,
}

@group(0) @binding(0) var<uniform> diffuse: Diffuse;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> control: Control;
@group(0) @binding(3) var<storage, read> stage_before: array<f32>;
@group(0) @binding(4) var<storage, read> stage_earlier: array<f32>;
@group(0) @binding(5) var<storage, read_write> stage: array<f32>;

// Two cells of a row, and the cell before and after them.
fn row_of(at: u32) -> vec4f {
    return vec4f(stage_before[at - 1u], stage_before[at], stage_before[at + 1u], stage_before[at + 2u]);
}

// Times the square of the cell angle, the Laplacian of the middle two cells of a row, of second order. See `CellMetric::laplacian_factors` in
// src/physics/flow/operators.rs.
fn laplacian(below: vec4f, here: vec4f, above: vec4f, along: vec2f, across: f32) -> vec2f {
    let by_aa = here.xy + here.zw - 2.0 * here.yz;
    let by_bb = below.yz + above.yz - 2.0 * here.yz;
    let by_ab = 0.25 * ((above.zw - above.xy) - (below.zw - below.xy));
    let a = 1.0 + along * along;
    let b = 1.0 + across * across;
    let delta2 = a + b - 1.0;
    return delta2 / a * by_aa + 2.0 * delta2 * along * across / (a * b) * by_ab + delta2 / b * by_bb;
}

// Writes the stage of two cells of a row, the first of them at a place in storage.
fn store(at: u32, here: vec2f, spread: vec2f) {
    let earlier = vec2f(stage_earlier[at], stage_earlier[at + 1u]);
    let found = diffuse.before * here + diffuse.earlier * earlier + spread;
    stage[at] = found.x;
    stage[at + 1u] = found.y;
}

@compute @workgroup_size(8, 8)
fn diffuse_stage(@builtin(global_invocation_id) id: vec3u) {
    let side = diffuse.cells + 2u * HALO;
    let reached = side - 2u * diffuse.stage;
    if (any(2u * id.xy >= vec2u(reached))) {
        return;
    }
    // Where two by two do not divide what is reached, the last ones overlap others, with the same answer.
    let first = diffuse.stage + min(2u * id.xy, vec2u(reached - 2u));
    let at = (id.z * side + first.y) * side + first.x;
    let rows = array(row_of(at - side), row_of(at), row_of(at + side), row_of(at + 2u * side));
    let along = vec2f(tangents[first.x], tangents[first.x + 1u]);
    let spread = min(diffuse.rate * f32(control.ticks_remapped), diffuse.max_spread);
    store(at, rows[1].yz, spread * laplacian(rows[0], rows[1], rows[2], along, tangents[first.y]));
    store(at + side, rows[2].yz, spread * laplacian(rows[1], rows[2], rows[3], along, tangents[first.y + 1u]));
}
