// The middle of back and forth error compensation (Dupont & Liu 2003, J. Comput. Phys. 190): a tracer that was carried a step forth and back
// has twice the step's error; subtract half the difference before the final step. One invocation per cell, halo included.

@group(0) @binding(0) var tracer: texture_2d_array<f32>;
@group(0) @binding(1) var<storage, read> returned: array<f32>;
@group(0) @binding(2) var corrected: texture_storage_2d_array<r32float, write>;

@compute @workgroup_size(8, 8)
fn correct_error(@builtin(global_invocation_id) id: vec3u) {
    let side = textureDimensions(tracer).x;
    if (all(id.xy < vec2u(side))) {
        let back = returned[(id.z * side + id.y) * side + id.x];
        let value = 1.5 * textureLoad(tracer, id.xy, id.z, 0).r - 0.5 * back;
        textureStore(corrected, id.xy, id.z, vec4f(value, 0.0, 0.0, 0.0));
    }
}
