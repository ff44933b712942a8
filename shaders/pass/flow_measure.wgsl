// What a step of the flow must know of the whole film, and what was wrong with it: sums over all cells by one workgroup for each film.

import package::flow::operators::{area_density, is_valid, valid_or_zero};
import package::flow::step::{Flow, Measures};
import package::sphere::cubed::{HALO, padded_index, quotient};

const FOUR_PI: f32 = 12.566370614;
const LANES: u32 = 256u;

@group(0) @binding(0) var<uniform> flow: Flow;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> zeta: array<f32>;
@group(0) @binding(3) var<storage, read> psi: array<f32>;
@group(0) @binding(4) var<storage, read> psi_before: array<f32>;
@group(0) @binding(5) var<storage, read> log_thickness: array<f32>;
@group(0) @binding(6) var<storage, read> velocity: array<vec4f>;
@group(0) @binding(7) var<storage, read_write> measures: array<Measures>;

// Sum of zeta, sum of the guess, largest speed, invalid values.
var<workgroup> shares: array<vec4f, 256>;

@compute @workgroup_size(256)
fn flow_measure(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let film = group.x;
    var share = vec4f(0.0);
    for (var cell = lane; cell < 6u * flow.cells * flow.cells; cell += LANES) {
        let row = quotient(cell, flow.cells);
        let panel = quotient(row, flow.cells);
        let i = cell - row * flow.cells;
        let j = row - panel * flow.cells;
        let at = padded_index(6u * film + panel, i32(i), i32(j), flow.cells);
        let area = area_density(vec2f(tangents[i + HALO], tangents[j + HALO]));
        let guess = 2.0 * valid_or_zero(psi[at]) - valid_or_zero(psi_before[at]);
        share += vec4f(area * valid_or_zero(zeta[at]), area * guess, 0.0, 0.0);
        share.z = max(share.z, length(velocity[at].xyz));
        share.w += select(1.0, 0.0, is_valid(zeta[at])) + select(1.0, 0.0, is_valid(log_thickness[at])) +
            select(1.0, 0.0, is_valid(psi[at]));
    }
    shares[lane] = share;
    for (var half = LANES / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if (lane < half) {
            let other = shares[lane + half];
            shares[lane] = vec4f(shares[lane].xy + other.xy, max(shares[lane].z, other.z), shares[lane].w + other.w);
        }
    }
    if (lane == 0u) {
        let mean = shares[0].xy * flow.cell_angle * flow.cell_angle / FOUR_PI;
        measures[film].zeta_mean = mean.x;
        measures[film].guess_mean = mean.y;
        measures[film].max_speed = shares[0].z;
        measures[film].invalid += u32(shares[0].w);
    }
}
