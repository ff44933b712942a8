// Puts what was sampled of a film, with its liquid restored, into a texture: the one that pictures show, or at the end of a remap the tracer.
// Scattered reads cost half as much there as in a buffer.
// One invocation per cell, halo included.

import package::film::control::{Balance, balanced};

@group(0) @binding(0) var<uniform> balance: Balance;
@group(0) @binding(1) var<storage, read> sampled: array<f32>;
@group(0) @binding(2) var film: texture_storage_2d_array<r32float, write>;

@compute @workgroup_size(8, 8)
fn balance_film(@builtin(global_invocation_id) id: vec3u) {
    let side = textureDimensions(film).x;
    if (all(id.xy < vec2u(side))) {
        let value = balanced(sampled[(id.z * side + id.y) * side + id.x], balance);
        textureStore(film, id.xy, id.z, vec4f(value, 0.0, 0.0, 0.0));
    }
}
