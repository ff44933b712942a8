// Copies a film's thickness, halo included, from the buffer that compute passes work on into the texture that pictures read: the
// scattered reads of reflections cost half as much there.

@group(0) @binding(0) var<storage, read> thickness_nm: array<f32>;
@group(0) @binding(1) var film: texture_storage_2d_array<r32float, write>;

@compute @workgroup_size(64)
fn pack_film(@builtin(global_invocation_id) id: vec3u) {
    let side = textureDimensions(film).x;
    if (id.x < side) {
        textureStore(film, id.xy, id.z, vec4f(thickness_nm[(id.z * side + id.y) * side + id.x], 0.0, 0.0, 0.0));
    }
}
