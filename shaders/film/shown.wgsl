// The shown film: thickness at the cells of a cubed sphere, a layer a panel, halo included.

import package::sphere::cubed::{HALO, locate};

fn film_texel(film: texture_2d_array<f32>, texel: vec2i, panel: u32) -> f32 {
    return textureLoad(film, texel, panel, 0).r;
}

// Bilinear between cell centers.
fn film_at(film: texture_2d_array<f32>, direction: vec3f, cells: u32) -> f32 {
    return film_part_at(film, direction, cells, vec2u(0u));
}

// Thickness of a film that is stored in a part of a larger texture, from the texel `origin` on.
fn film_part_at(film: texture_2d_array<f32>, direction: vec3f, cells: u32, origin: vec2u) -> f32 {
    let at = locate(direction, cells);
    let base = floor(at.cell);
    let t = at.cell - base;
    // Weighted here: filtering hardware has only 8 bits for its weights, and need not filter this format at all.
    let first = vec2i(base) + i32(HALO) + vec2i(origin);
    let low = mix(film_texel(film, first, at.panel), film_texel(film, first + vec2i(1, 0), at.panel), t.x);
    let high = mix(film_texel(film, first + vec2i(0, 1), at.panel), film_texel(film, first + vec2i(1, 1), at.panel), t.x);
    return mix(low, high, t.y);
}
