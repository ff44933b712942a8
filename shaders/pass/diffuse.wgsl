// Diffusion of a film's thickness, a stage of a Runge-Kutta-Legendre step of first order (Meyer, Balsara & Aslam 2012, MNRAS 422): three
// stages are stable for six times as long as one explicit step, and never make a new extreme. Stage k reaches k cells into the halo less.
// One invocation per cell, halo included.

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

// Times the square of the cell angle, the Laplacian at a place, of second order. See `CellMetric::laplacian_factors` in
// src/physics/flow/operators.rs.
fn laplacian(at: u32, side: u32, tangent: vec2f) -> f32 {
    let here = stage_before[at];
    let by_aa = stage_before[at - 1u] + stage_before[at + 1u] - 2.0 * here;
    let by_bb = stage_before[at - side] + stage_before[at + side] - 2.0 * here;
    let by_ab = 0.25 * ((stage_before[at + side + 1u] - stage_before[at + side - 1u]) -
        (stage_before[at - side + 1u] - stage_before[at - side - 1u]));
    let s = 1.0 + tangent * tangent;
    let delta2 = s.x + s.y - 1.0;
    return delta2 / s.x * by_aa + 2.0 * delta2 * tangent.x * tangent.y / (s.x * s.y) * by_ab + delta2 / s.y * by_bb;
}

@compute @workgroup_size(8, 8)
fn diffuse_stage(@builtin(global_invocation_id) id: vec3u) {
    let side = diffuse.cells + 2u * HALO;
    let margin = diffuse.stage;
    if (any(id.xy < vec2u(margin)) || any(id.xy >= vec2u(side - margin))) {
        return;
    }
    let at = (id.z * side + id.y) * side + id.x;
    let spread = min(diffuse.rate * f32(control.ticks_remapped), diffuse.max_spread);
    let found = spread * laplacian(at, side, vec2f(tangents[id.x], tangents[id.y]));
    stage[at] = diffuse.before * stage_before[at] + diffuse.earlier * stage_earlier[at] + found;
}
