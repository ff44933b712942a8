// The middle of back and forth error compensation (Dupont & Liu 2003, J. Comput. Phys. 190): a tracer that was carried a step forth and back
// has twice the step's error; subtract half the difference before the final step. One invocation per cell, halo included.

@group(0) @binding(0) var<storage, read> tracer: array<f32>;
@group(0) @binding(1) var<storage, read> returned: array<f32>;
@group(0) @binding(2) var<storage, read_write> corrected: array<f32>;

@compute @workgroup_size(64)
fn correct_error(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    // In the order of storage, whatever the panels.
    let place = ((group.z * groups.y + group.y) * groups.x + group.x) * 64u + local;
    if (place < arrayLength(&tracer)) {
        corrected[place] = 1.5 * tracer[place] - 0.5 * returned[place];
    }
}
