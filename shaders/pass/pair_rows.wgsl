// Stores a table as lookups read it: each row in one texel with the next. See optics/table.wgsl.

import package::optics::table::two_rows;

// Mirrors `PairUniform` in src/gpu/passes/pair_rows.rs.
struct Pair {
    columns: u32,
    first_row: u32,
    end_row: u32,
    last_row: u32,
}

@group(0) @binding(0) var<uniform> pair: Pair;
@group(0) @binding(1) var baked: texture_2d_array<f32>;
@group(0) @binding(2) var paired: texture_storage_2d_array<rgba32uint, write>;

@compute @workgroup_size(64)
fn pair_rows(@builtin(global_invocation_id) id: vec3u) {
    let texel = vec2u(id.x, pair.first_row + id.y);
    if (any(texel >= vec2u(pair.columns, pair.end_row))) {
        return;
    }
    let next = vec2u(texel.x, min(texel.y + 1u, pair.last_row));
    let rows = two_rows(textureLoad(baked, texel, id.z, 0).rgb, textureLoad(baked, next, id.z, 0).rgb);
    textureStore(paired, texel, id.z, rows);
}
