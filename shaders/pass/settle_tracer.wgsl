// The end of a remap: what was sampled through the map, with its liquid restored, is the tracer from now on.
// One invocation per cell, halo included.

import package::film::control::{Balance, balanced};

@group(0) @binding(0) var<uniform> balance: Balance;
@group(0) @binding(1) var<storage, read> sampled: array<f32>;
@group(0) @binding(2) var<storage, read_write> tracer: array<f32>;

@compute @workgroup_size(64)
fn settle_tracer(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    // In the order of storage, whatever the panels.
    let place = ((group.z * groups.y + group.y) * groups.x + group.x) * 64u + local;
    if (place < arrayLength(&tracer)) {
        tracer[place] = balanced(sampled[place], balance);
    }
}
