// Copies what a film shows into a buffer in the grid's order of cells. One invocation per cell.

import package::sphere::cubed::HALO;

@group(0) @binding(0) var film: texture_2d_array<f32>;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;

@compute @workgroup_size(8, 8)
fn read_film(@builtin(global_invocation_id) id: vec3u) {
    let cells = textureDimensions(film).x - 2u * HALO;
    if (all(id.xy < vec2u(cells))) {
        values[(id.z * cells + id.y) * cells + id.x] = textureLoad(film, id.xy + HALO, id.z, 0).r;
    }
}
