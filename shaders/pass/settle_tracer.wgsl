// The end of a remap: what was sampled through the map, with its liquid restored, is the tracer from now on.
// One invocation a cell, halo included.

import package::film::control::{Balance, balanced};

@group(0) @binding(0) var<uniform> balance: Balance;
@group(0) @binding(1) var<storage, read> sampled: array<f32>;
@group(0) @binding(2) var<storage, read_write> tracer: array<f32>;

@compute @workgroup_size(64)
fn settle_tracer(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    // Rows of the dispatch are the rows of storage: as many as the padded panel's side.
    let place = (id.z * groups.y + id.y) * groups.y + id.x;
    if (id.x < groups.y) {
        tracer[place] = balanced(sampled[place], balance);
    }
}
