// Thin film collapses to black film, which a real film does within a fraction of a second once its surfaces attract each other: the
// difference to black film decays at a constant rate. It is the film around a cell that must be thin: black spots are round, while cells that
// went one by one would leave a maze. Film thinner than `nucleation_nm` collapses around nuclei. What cells lose is missing until the film's liquid is restored. The
// f64 truth, with the reasons, is src/physics/film/model/blacken.rs.
//
// The tracer holds the thickness and what has evaporated of it, as their departure from the film's level. One invocation per cell, halo
// included.

import package::film::control::Control;
import package::sphere::cubed::{HALO, is_cell, locate, padded_index, panel_direction};

// A place where a black spot opens. Mirrors `NucleusValue` in src/gpu/passes/blacken.rs.
struct Nucleus {
    middle: vec3f,
    // Angle, radians.
    radius: f32,
    // Ticks since it formed.
    age: u32,
}

// Mirrors `BlackenUniform` in src/gpu/passes/blacken.rs.
struct Blacken {
    // Cells along a panel's edge.
    cells: u32,
    // What the tracer departs from, and the same less what has evaporated, nm.
    level_nm: f32,
    remaining_level_nm: f32,
    // Thickness of black film, and that below which film collapses, nm.
    black_nm: f32,
    onset_nm: f32,
    // Thickness below which film collapses around a nucleus, nm.
    nucleation_nm: f32,
    // Rate of the collapse, 1/tick.
    rate: f32,
    nuclei_count: u32,
    nuclei: array<Nucleus, 32>,
}

@group(0) @binding(0) var<uniform> blacken: Blacken;
@group(0) @binding(1) var<storage, read_write> control: Control;
@group(0) @binding(2) var<storage, read> tracer: array<f32>;
@group(0) @binding(3) var<storage, read_write> result: array<f32>;
// Means of the tracer around cells.
@group(0) @binding(4) var<storage, read> means: array<f32>;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(5) var<storage, read> tangents: array<f32>;
// The tracer as it was settled.
@group(0) @binding(6) var settled: texture_2d_array<f32>;

// Cells on each side that count for a cell's mean.
const REACH: u32 = 3u;
// Part of the onset within which the collapse sets in: borders are smooth, and some cells wide.
const ONSET_WIDTH: f32 = 0.1;
// Part of a nucleus's radius within which film collapses entirely: `CORE` in src/physics/film/nucleation.rs.
const CORE: f32 = 0.7;

fn thickness_nm(place: u32) -> f32 {
    return tracer[place] + blacken.remaining_level_nm;
}

fn mean_nm(place: u32) -> f32 {
    return means[place] + blacken.remaining_level_nm;
}

// How far nuclei that formed since the last remap let film collapse at a direction, 0 to 1.
fn nucleated(x: vec3f) -> f32 {
    var most = 0.0;
    // The youngest come first.
    for (var k = 0u; k < blacken.nuclei_count; k++) {
        let nucleus = blacken.nuclei[k];
        if (nucleus.age >= control.ticks_remapped) {
            break;
        }
        let away = distance(x, nucleus.middle) / nucleus.radius;
        if (away < 1.0) {
            let at = locate(nucleus.middle, blacken.cells);
            let cell = vec2i(round(at.cell));
            if (thickness_nm(padded_index(at.panel, cell.x, cell.y, blacken.cells)) < blacken.nucleation_nm) {
                most = max(most, 1.0 - smoothstep(CORE, 1.0, away));
            }
        }
    }
    return most;
}

fn place_of(id: vec3u) -> u32 {
    let side = blacken.cells + 2u * HALO;
    return (id.z * side + id.y) * side + id.x;
}

fn is_halo(id: vec3u) -> bool {
    return any(id.xy < vec2u(HALO)) || any(id.xy >= vec2u(blacken.cells + HALO));
}

@compute @workgroup_size(8, 8)
fn stop_evaporation(@builtin(global_invocation_id) id: vec3u) {
    if (is_cell(id, blacken.cells)) {
        let departure = textureLoad(settled, id.xy, id.z, 0).r;
        let nm = departure + blacken.remaining_level_nm;
        // Nothing where nothing was spared, to the last bit.
        let spared = max(min(departure + blacken.level_nm, blacken.black_nm) - nm, 0.0);
        result[place_of(id)] = departure + spared;
    }
}

// What a cell counts for means: no thicker than makes a straight border between black film and any thicker one stand still. Bent borders
// then straighten, as a line under tension does (Merriman, Bence & Osher 1992), and drops narrower than a rim do not last. Means along rows,
// which columns take, count as they are.
fn counted(place: u32) -> f32 {
    return min(tracer[place], 2.0 * blacken.onset_nm - blacken.black_nm - blacken.remaining_level_nm);
}

// The mean over the cells before and after one that are so far apart in storage, nearer ones counting more.
fn mean_along(place: u32, stride: u32) -> f32 {
    var sum = f32(REACH + 1u) * counted(place);
    for (var k = 1u; k <= REACH; k++) {
        sum += f32(REACH + 1u - k) * (counted(place - k * stride) + counted(place + k * stride));
    }
    return sum / f32((REACH + 1u) * (REACH + 1u));
}

// Along rows, including rows of the halo.
@compute @workgroup_size(8, 8)
fn mean_along_rows(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= HALO && id.x < blacken.cells + HALO && is_cell(id, blacken.cells)) {
        let place = place_of(id);
        result[place] = mean_along(place, 1u);
    }
}

@compute @workgroup_size(8, 8)
fn mean_along_columns(@builtin(global_invocation_id) id: vec3u) {
    if (!is_halo(id)) {
        let place = place_of(id);
        result[place] = mean_along(place, blacken.cells + 2u * HALO);
    }
}

@compute @workgroup_size(8, 8)
fn collapse(@builtin(global_invocation_id) id: vec3u) {
    if (is_halo(id)) {
        return;
    }
    let place = place_of(id);
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
    let below = (blacken.onset_nm - mean_nm(place)) / (ONSET_WIDTH * blacken.onset_nm);
    let decayed = 1.0 - exp(-clamp(below, 0.0, 1.0) * blacken.rate * f32(control.ticks_remapped));
    let lost = max(thickness_nm(place) - blacken.black_nm, 0.0) * max(decayed, nucleated(x));
    result[place] = tracer[place] - lost;
}
