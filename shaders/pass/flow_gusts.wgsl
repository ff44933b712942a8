// What the moving air around a film does to it: a source of vorticity, the air's own times the rate at which it drags the film along.
// One invocation per cell.

import package::film::prescribed::{MAX_VORTICES, MAX_WAVES, Vortex, Wave, vortex_vorticity, wave_vorticity};
import package::sphere::cubed::{HALO, padded_index, panel_direction};

// Mirrors `GustsUniform` in src/gpu/passes/flow_gusts.rs.
struct Gusts {
    // Cells along a panel's edge.
    cells: u32,
    // Waves and vortices in use; those come first.
    waves_count: u32,
    vortices_count: u32,
    // Rate at which the air drags the film along, 1/s.
    rate: f32,
    // Which of the films that flow together.
    film: u32,
    waves: array<Wave, 32>,
    vortices: array<Vortex, 64>,
}

@group(0) @binding(0) var<uniform> gusts: Gusts;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> forcing: array<f32>;

@compute @workgroup_size(8, 8)
fn flow_gusts(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(gusts.cells))) {
        return;
    }
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x + HALO], tangents[id.y + HALO])));
    var vorticity = 0.0;
    for (var k = 0u; k < min(gusts.waves_count, MAX_WAVES); k++) {
        vorticity += wave_vorticity(gusts.waves[k], x);
    }
    for (var k = 0u; k < min(gusts.vortices_count, MAX_VORTICES); k++) {
        vorticity += vortex_vorticity(gusts.vortices[k], x);
    }
    forcing[padded_index(6u * gusts.film + id.z, i32(id.x), i32(id.y), gusts.cells)] = gusts.rate * vorticity;
}
