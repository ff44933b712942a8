// Looks the tracer up through the flow map: what is at x now is what was at map(x) at the last remap, and what was gathered since.
// Shown, it is what the picture colours; settled, it is a remap. Halos are included.

import package::film::control::Control;
import package::sphere::cap::{Cap, image};
import package::sphere::cubed::{cell_place, is_cell, is_quad, panel_direction, quad_cell};
import package::sphere::lookup::{gather_place, map_at, map_at_cell, map_at_quad, sanitised, tracer_at};

// What the map's fourth number means: see `Gathered` in src/gpu/passes/sample_tracer.rs.
override GATHERED: u32;
const GATHERED_NOTHING: u32 = 0u;
// The logarithm of the area ratio, for a density in a wind that diverges.
const GATHERED_LOG_AREA: u32 = 1u;
// An amount to be added.
const GATHERED_AMOUNT: u32 = 2u;

// Whether what is written is on the map's grid, and on the tracer's.
override ON_MAP_GRID: u32;
override ON_TRACER_GRID: u32;
// 0: there is no map, and the tracer is where it is.
override HAS_MAP: u32;
// 1: the film ends at a rim, beyond which is the image of what is within.
override HAS_RIM: u32;

// Mirrors `SampleUniform` in src/gpu/passes/sample_tracer.rs.
struct Sample {
    // Cells along a panel's edge: of what is written, of the map, and of the tracer.
    cells: u32,
    map_cells: u32,
    tracer_cells: u32,
    // Where the film ends: see `Cap`.
    rim_z: f32,
    inversion: f32,
    // Cells that the first two by two begin before storage does: 0 or 1.
    quad_skew: u32,
}

@group(0) @binding(0) var<uniform> sample: Sample;
// tan(alpha) of each cell coordinate of the grid that is written, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> control: Control;
@group(0) @binding(3) var map: texture_2d_array<f32>;
@group(0) @binding(4) var tracer: texture_2d_array<f32>;
@group(0) @binding(5) var<storage, read_write> sampled: array<f32>;
@group(0) @binding(6) var point_sampler: sampler;

// There is but one map here.
fn map_texel(unused: u32, texel: vec2u, panel: u32) -> vec4f {
    return textureLoad(map, texel, panel, 0);
}

fn tracer_texels(texel: vec2u, panel: u32) -> vec4f {
    return textureGather(0, tracer, point_sampler, gather_place(texel, sample.tracer_cells), panel);
}

fn with_gathered(value: f32, gathered: f32) -> f32 {
    if (GATHERED == GATHERED_LOG_AREA) {
        return value * exp(gathered);
    }
    if (GATHERED == GATHERED_AMOUNT) {
        return value + gathered;
    }
    return value;
}

// What is where the map leads.
fn value_from(origin: vec4f) -> f32 {
    return with_gathered(tracer_at(origin.xyz, sample.tracer_cells), origin.w);
}

fn direction_at(id: vec3u) -> vec3f {
    return normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
}

// One invocation per cell.
@compute @workgroup_size(8, 8)
fn sample_tracer(@builtin(global_invocation_id) id: vec3u) {
    if (!is_cell(id, sample.cells)) {
        return;
    }
    let x = direction_at(id);
    let place = cell_place(id, sample.cells);
    var origin = vec4f(x, 0.0);
    if (HAS_MAP == 1u) {
        if (ON_MAP_GRID == 1u) {
            origin = textureLoad(map, id.xy, id.z, 0);
        } else {
            origin = map_at_cell(0u, id, sample.cells, x, sample.map_cells);
        }
    }
    let is_image = HAS_RIM == 1u && x.z < sample.rim_z;
    if (is_image) {
        origin = vec4f(image(Cap(sample.rim_z, sample.inversion), x), 0.0);
        if (HAS_MAP == 1u) {
            origin = map_at(0u, origin.xyz, sample.map_cells);
        }
    }
    var value: f32;
    if (HAS_MAP == 0u && !is_image && ON_TRACER_GRID == 1u) {
        value = textureLoad(tracer, id.xy, id.z, 0).r;
    } else {
        value = value_from(origin);
    }
    if (sanitised > 0u) {
        atomicAdd(&control.sanitised, sanitised);
    }
    sampled[place] = value;
}

fn store(cell: vec3u, value: f32) {
    if (is_cell(cell, sample.cells)) {
        sampled[cell_place(cell, sample.cells)] = value;
    }
}

// One invocation for two by two cells, through a map of cells an even number of times as wide, of a film without a rim.
@compute @workgroup_size(8, 8)
fn sample_quads(@builtin(global_invocation_id) id: vec3u) {
    let first = 2 * vec2i(id.xy) - i32(sample.quad_skew);
    if (!is_quad(first, sample.cells)) {
        return;
    }
    let direction = direction_at(vec3u(vec2u(max(first, vec2i(0))), id.z));
    let origins = map_at_quad(0u, first, id.z, sample.cells, direction, sample.map_cells);
    // Each by itself: software rasterisers keep what a loop reads in memory.
    store(quad_cell(first, 0u, id.z), value_from(origins[0]));
    store(quad_cell(first, 1u, id.z), value_from(origins[1]));
    store(quad_cell(first, 2u, id.z), value_from(origins[2]));
    store(quad_cell(first, 3u, id.z), value_from(origins[3]));
    if (sanitised > 0u) {
        atomicAdd(&control.sanitised, sanitised);
    }
}
