// The film as its flow feels it: the logarithm of the thickness over a reference at the cells of the flow's grid, looked up through the
// film's map.

import package::film::control::Control;
import package::sphere::cap::{Cap, image};
import package::sphere::cubed::{HALO, padded_index, panel_direction};
import package::sphere::lookup::{map_at, map_at_cell, sanitised, tracer_at};

// 0: there is no map, and the tracer is where it is.
override HAS_MAP: u32;
// 1: the film ends at a rim, beyond which is the image of what is within.
override HAS_RIM: u32;

// Mirrors `ThicknessUniform` in src/gpu/passes/flow_thickness.rs.
struct Thickness {
    // Cells along a panel's edge: of the flow, of the map, and of the tracer.
    cells: u32,
    map_cells: u32,
    tracer_cells: u32,
    // The reference, nm.
    reference_nm: f32,
    // Less the reference, nm: what the tracer departs from with and without what has evaporated, and the thickness at which that ends.
    offset_nm: f32,
    level_nm: f32,
    black_nm: f32,
    // Where the film ends: see `Cap`.
    rim_z: f32,
    inversion: f32,
    // Which of the films that flow together.
    film: u32,
}

@group(0) @binding(0) var<uniform> thickness: Thickness;
// tan(alpha) of each cell coordinate of the flow's grid, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> control: Control;
@group(0) @binding(3) var map: texture_2d_array<f32>;
@group(0) @binding(4) var tracer: texture_2d_array<f32>;
@group(0) @binding(5) var<storage, read_write> log_thickness: array<f32>;
@group(0) @binding(6) var point_sampler: sampler;

// There is but one map here.
fn map_texel(unused: u32, texel: vec2u, panel: u32) -> vec4f {
    return textureLoad(map, texel, panel, 0);
}

fn tracer_texels(texel: vec2u, panel: u32) -> vec4f {
    return textureGather(0, tracer, point_sampler, gather_place(texel, thickness.tracer_cells), panel);
}

// ln(1 + x) as exact near 0 as elsewhere, where the built-in logarithm may err by 2^-21: 2 artanh(x / (2 + x)) by its series.
fn log_of_one_and(x: f32) -> f32 {
    let s = x / (2.0 + x);
    let q = s * s;
    let series = 2.0 * s * (1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0 + q / 11.0)))));
    return select(log(1.0 + x), series, abs(s) < 0.2);
}

@compute @workgroup_size(8, 8)
fn flow_thickness(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= vec2u(thickness.cells))) {
        return;
    }
    var origin = normalize(panel_direction(id.z, vec2f(tangents[id.x + HALO], tangents[id.y + HALO])));
    let is_image = HAS_RIM == 1u && origin.z < thickness.rim_z;
    if (is_image) {
        origin = image(Cap(thickness.rim_z, thickness.inversion), origin);
        if (HAS_MAP == 1u) {
            origin = map_at(0u, origin, thickness.map_cells).xyz;
        }
    } else if (HAS_MAP == 1u) {
        origin = map_at_cell(0u, id + vec3u(HALO, HALO, 0u), thickness.cells, origin, thickness.map_cells).xyz;
    }
    let departure = tracer_at(origin, thickness.tracer_cells);
    if (sanitised > 0u) {
        atomicAdd(&control.sanitised, sanitised);
    }
    let place = padded_index(6u * thickness.film + id.z, i32(id.x), i32(id.y), thickness.cells);
    // As pictures have it: evaporation ends at black film.
    let nm = max(departure + thickness.offset_nm, min(departure + thickness.level_nm, thickness.black_nm));
    log_thickness[place] = log_of_one_and(nm / thickness.reference_nm);
}
