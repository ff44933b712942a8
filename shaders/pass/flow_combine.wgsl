// A sum of three fields with factors, less a multiple of a mean, over all of padded storage: halos are linear too. Films
// are stored one after the other.

import package::flow::operators::valid_or_zero;
import package::flow::step::Measures;

// Mirrors `CombineUniform` in src/gpu/passes/flow_combine.rs.
struct Combine {
    first: f32,
    second: f32,
    third: f32,
    // Of the mean of 2 psi - psi_before.
    mean: f32,
    // Values of each film.
    values: u32,
}

@group(0) @binding(0) var<uniform> combine: Combine;
@group(0) @binding(1) var<storage, read> measures: array<Measures>;
@group(0) @binding(2) var<storage, read> first: array<f32>;
@group(0) @binding(3) var<storage, read> second: array<f32>;
@group(0) @binding(4) var<storage, read> third: array<f32>;
@group(0) @binding(5) var<storage, read_write> combined: array<f32>;
@group(0) @binding(6) var<storage, read_write> sum: array<f32>;

@compute @workgroup_size(64)
fn flow_combine(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < combine.values) {
        let at = id.y * combine.values + id.x;
        combined[at] = combine.first * valid_or_zero(first[at]) + combine.second * valid_or_zero(second[at]) +
            combine.third * valid_or_zero(third[at]) + combine.mean * measures[id.y].guess_mean;
    }
}

// Besides, the plain sum of the first two.
@compute @workgroup_size(64)
fn flow_combine_and_sum(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < combine.values) {
        let at = id.y * combine.values + id.x;
        let both = vec2f(valid_or_zero(first[at]), valid_or_zero(second[at]));
        combined[at] = combine.first * both.x + combine.second * both.y + combine.third * valid_or_zero(third[at]);
        sum[at] = both.x + both.y;
    }
}
