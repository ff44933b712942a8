// The middle of back and forth error compensation (Dupont & Liu 2003, J. Comput. Phys. 190): a tracer that was carried a step forth and back
// has twice the step's error; take half the difference off before the step is made for good. One invocation a cell, halo included.

@group(0) @binding(0) var<storage, read> tracer: array<f32>;
@group(0) @binding(1) var<storage, read> returned: array<f32>;
@group(0) @binding(2) var<storage, read_write> corrected: array<f32>;

@compute @workgroup_size(64)
fn correct_error(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    // Rows of the dispatch are the rows of storage: as many as the padded panel's side.
    let place = (id.z * groups.y + id.y) * groups.y + id.x;
    if (id.x < groups.y) {
        corrected[place] = 1.5 * tracer[place] - 0.5 * returned[place];
    }
}
