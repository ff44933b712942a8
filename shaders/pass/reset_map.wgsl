// Makes a film's flow map the identity, with nothing gathered. One invocation per cell, halo included.

import package::sphere::cubed::panel_direction;

// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(0) var<storage, read> tangents: array<f32>;
@group(0) @binding(1) var map: texture_storage_2d_array<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn reset_map(@builtin(global_invocation_id) id: vec3u) {
    let side = arrayLength(&tangents);
    if (all(id.xy < vec2u(side))) {
        let x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
        textureStore(map, id.xy, id.z, vec4f(x, 0.0));
    }
}
