// Beyond the rim of a film, vorticity becomes the image of what is within: then nothing flows across the rim. One invocation per cell.

import package::sphere::cap::{Cap, image, stretch};
import package::sphere::cubed::{HALO, locate_in, padded_index, panel_direction};

// Mirrors `MirrorUniform` in src/gpu/passes/flow_mirror.rs.
struct Mirror {
    // Where the film ends: see `Cap`.
    rim_z: f32,
    inversion: f32,
    // Cells along a panel's edge.
    cells: u32,
}

@group(0) @binding(0) var<uniform> mirror: Mirror;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
// Vorticity with its halo.
@group(0) @binding(2) var<storage, read> zeta: array<f32>;
@group(0) @binding(3) var<storage, read_write> with_mirror: array<f32>;

// Bilinear: at the rim vorticity jumps, and a wider stencil would ring.
fn zeta_at(film: u32, x: vec3f) -> f32 {
    let at = locate_in(film, x, mirror.cells);
    let cell = clamp(at.cell, vec2f(-0.5), vec2f(f32(mirror.cells) - 0.5));
    let base = floor(cell);
    let t = cell - base;
    let first = padded_index(at.panel, i32(base.x), i32(base.y), mirror.cells);
    let above = first + mirror.cells + 2u * HALO;
    return mix(mix(zeta[first], zeta[first + 1u], t.x), mix(zeta[above], zeta[above + 1u], t.x), t.y);
}

@compute @workgroup_size(8, 8)
fn flow_mirror(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(mirror.cells))) {
        return;
    }
    let x = normalize(panel_direction(id.z % 6u, vec2f(tangents[id.x + HALO], tangents[id.y + HALO])));
    let at = padded_index(id.z, i32(id.x), i32(id.y), mirror.cells);
    if (x.z >= mirror.rim_z) {
        with_mirror[at] = zeta[at];
        return;
    }
    let cap = Cap(mirror.rim_z, mirror.inversion);
    let longer = stretch(cap, x);
    with_mirror[at] = -longer * longer * zeta_at(id.z / 6u, image(cap, x));
}
