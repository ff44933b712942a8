// Makes a film's flow map the identity, with nothing gathered. One invocation a cell, halo included.

import package::sphere::cubed::panel_direction;

// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(0) var<storage, read> tangents: array<f32>;
@group(0) @binding(1) var<storage, read_write> map: array<vec4f>;

@compute @workgroup_size(64)
fn reset_map(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    // Rows of the dispatch are the rows of storage: as many as the padded panel's side.
    if (id.x < groups.y) {
        let x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
        map[(id.z * groups.y + id.y) * groups.y + id.x] = vec4f(x, 0.0);
    }
}
