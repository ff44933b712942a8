// Follows the rim of a hole along its meridians, each by one invocation of one workgroup. First finds where the film is thinnest, if nothing
// pricked it. See src/physics/film/burst.rs.

import package::film::hole::{HOLE_MERIDIANS, Rim, TAU, meridian_axes};
import package::film::shown::film_at;
import package::sphere::cubed::{HALO, panel_direction};

// Parts of a meridian from the middle to the point opposite.
override HOLE_PARTS: u32;
// 1: the film has one thickness everywhere, and no field is read.
override UNIFORM_FILM: u32;

const PI: f32 = 3.14159265;
const LANES: u32 = 256u;

// Mirrors `OpenHoleUniform` in src/gpu/passes/open_hole.rs.
struct OpenHole {
    // Direction of its middle in the film; of no account where `seeks` is 1.
    middle: vec3f,
    // For how long it has opened, s.
    seconds: f32,
    // Seconds a radian, over the root of the thickness in nm.
    delay: f32,
    // Radius of the sphere in nm.
    radius_nm: f32,
    // Cells along a panel's edge of the film, and its thickness where that is the same everywhere, nm.
    cells: u32,
    thickness_nm: f32,
    // What has evaporated, and the thickness at which that ends, nm.
    evaporated_nm: f32,
    black_nm: f32,
    // 1: the middle is where the film is thinnest.
    seeks: u32,
}

@group(0) @binding(0) var<uniform> hole: OpenHole;
@group(0) @binding(1) var film: texture_2d_array<f32>;
@group(0) @binding(4) var point_sampler: sampler;
// The middle of the hole, and its rim.
@group(0) @binding(2) var<storage, read_write> middle: vec4f;
@group(0) @binding(3) var<storage, read_write> rim: array<Rim>;

var<workgroup> thinnest_nm: array<f32, LANES>;
var<workgroup> thinnest_cell: array<u32, LANES>;

fn remaining_nm(nm: f32) -> f32 {
    return max(nm - hole.evaporated_nm, min(nm, hole.black_nm));
}

fn thickness_nm(direction: vec3f) -> f32 {
    if (UNIFORM_FILM == 1u) {
        return remaining_nm(hole.thickness_nm);
    }
    return remaining_nm(film_at(film, point_sampler, direction, hole.cells));
}

fn cell_texel(cell: u32) -> vec3u {
    let panel_cells = hole.cells * hole.cells;
    return vec3u(cell % hole.cells, cell % panel_cells / hole.cells, cell / panel_cells);
}

// Of two cells as thin the first is the thinnest, so that the order of the search is of no account.
fn is_thinner(nm: f32, cell: u32, lane: u32) -> bool {
    return nm < thinnest_nm[lane] || (nm == thinnest_nm[lane] && cell < thinnest_cell[lane]);
}

fn direction_of(cell: u32) -> vec3f {
    let texel = cell_texel(cell);
    let angle = ((vec2f(texel.xy) + 0.5) / f32(hole.cells) - 0.5) * (0.5 * PI);
    return normalize(panel_direction(texel.z, tan(angle)));
}

// Where the film is thinnest; all invocations must call it.
fn thinnest(lane: u32) -> vec3f {
    thinnest_nm[lane] = 3e38;
    thinnest_cell[lane] = 0u;
    for (var cell = lane; cell < 6u * hole.cells * hole.cells; cell += LANES) {
        let texel = cell_texel(cell);
        let nm = textureLoad(film, texel.xy + HALO, texel.z, 0).r;
        if (is_thinner(nm, cell, lane)) {
            thinnest_nm[lane] = nm;
            thinnest_cell[lane] = cell;
        }
    }
    for (var half = LANES / 2u; half > 0u; half >>= 1u) {
        workgroupBarrier();
        if (lane < half && is_thinner(thinnest_nm[lane + half], thinnest_cell[lane + half], lane)) {
            thinnest_nm[lane] = thinnest_nm[lane + half];
            thinnest_cell[lane] = thinnest_cell[lane + half];
        }
    }
    workgroupBarrier();
    return direction_of(thinnest_cell[0]);
}

fn followed_rim(from_middle: vec3f, along: vec3f) -> Rim {
    let step = PI / f32(HOLE_PARTS);
    var angle = 0.0;
    var left = hole.seconds;
    var swept = 0.0;
    for (var part = 0u; part < HOLE_PARTS && left > 0.0; part++) {
        let at = (f32(part) + 0.5) * step;
        let nm = thickness_nm(cos(at) * from_middle + sin(at) * along);
        let takes = max(hole.delay * sqrt(nm) * step, 1e-30);
        let share = clamp(left / takes, 0.0, 1.0);
        angle += share * step;
        swept += share * step * nm * sin(at);
        left -= takes;
    }
    // A thread of circular cross-section: its area, over the squared radius of the sphere, is what was swept over the rim's length.
    let area = swept / (hole.radius_nm * max(sin(angle), 1e-3));
    let width = 2.0 * sqrt(area / PI);
    let mean_nm = select(0.0, hole.radius_nm * area / width, width > 0.0);
    return Rim(angle, max(angle - width, 0.0), mean_nm, 0.0);
}

@compute @workgroup_size(LANES)
fn open_hole(@builtin(local_invocation_index) lane: u32) {
    var from_middle = hole.middle;
    if (hole.seeks == 1u) {
        from_middle = thinnest(lane);
    }
    if (lane == 0u) {
        middle = vec4f(from_middle, 0.0);
    }
    let axes = meridian_axes(from_middle);
    for (var meridian = lane; meridian < HOLE_MERIDIANS; meridian += LANES) {
        let turn = TAU * f32(meridian) / f32(HOLE_MERIDIANS);
        rim[meridian] = followed_rim(from_middle, cos(turn) * axes[0] + sin(turn) * axes[1]);
    }
}
