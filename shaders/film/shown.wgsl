// The shown film: thickness at the cells of a cubed sphere, a layer a panel, halo included.

import package::sphere::cubed::{HALO, locate};

// Bilinear between cell centers.
fn film_at(film: texture_2d_array<f32>, point_sampler: sampler, direction: vec3f, cells: u32) -> f32 {
    return film_part_at(film, point_sampler, direction, cells, vec2u(0u));
}

// Thickness of a film that is stored in a part of a larger texture, from the texel `origin` on.
fn film_part_at(film: texture_2d_array<f32>, point_sampler: sampler, direction: vec3f, cells: u32, origin: vec2u) -> f32 {
    let at = locate(direction, cells);
    let base = floor(at.cell);
    let t = at.cell - base;
    // Weighted here: filtering hardware has only 8 bits for its weights, and need not filter this format at all.
    let between = vec2f(vec2i(base) + i32(HALO + 1u) + vec2i(origin)) / vec2f(textureDimensions(film));
    let four = textureGather(0, film, point_sampler, between, at.panel);
    let rows = mix(four.wx, four.zy, t.x);
    return mix(rows.x, rows.y, t.y);
}
