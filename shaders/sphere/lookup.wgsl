// Interpolation of fields on the cubed sphere at any direction, by Lagrange weights. Panels are stored with halos, so no lookup sees an edge.
// Weights are computed here: filtering hardware has 8 bits for what needs 20.
//
// A pass that looks fields up defines two functions for them, of textures with a layer a panel:
//     fn map_texel(map: u32, texel: vec2u, panel: u32) -> vec4f     a texel of one of its maps
//     fn tracer_texels(texel: vec2u, panel: u32) -> vec4f           four texels of its tracer, from one on, as `textureGather` gives them

import package::film::control::{all_finite, is_finite};
import package::sphere::cubed::{HALO, cubic_weights, locate};

// Taps along each side of a tracer's stencil: 2 linear, 4 cubic, 6 quintic.
override TAPS: u32;
// 1: looked-up tracers stay within the range of the four cells around them.
override LIMITER: u32;

// A place between cells: the texel of the cell below it in both directions, and the fractions beyond that cell's center.
struct CellPoint {
    panel: u32,
    texel: vec2u,
    t: vec2f,
}

fn cell_point(direction: vec3f, cells: u32) -> CellPoint {
    let at = locate(direction, cells);
    // Rounding must not carry a point on the panel's edge past the halo.
    let cell = clamp(at.cell, vec2f(-0.5), vec2f(f32(cells) - 0.5));
    let base = floor(cell);
    return CellPoint(at.panel, vec2u(vec2i(base) + i32(HALO)), cell - base);
}

// Where the center of a cell of another grid is, beyond the panel's edge or within: on all grids of the same panels its place is known.
// Halo cells of a coarser grid than the one looked up are not allowed.
fn center_of(cell: vec2i, panel: u32, other_cells: u32, cells: u32) -> CellPoint {
    let at = (vec2f(cell) + 0.5) * (f32(cells) / f32(other_cells)) - 0.5;
    // No stencil reaches beyond the halo.
    let base = clamp(floor(at), vec2f(1.0 - f32(HALO)), vec2f(f32(cells + HALO) - 3.0));
    return CellPoint(panel, vec2u(vec2i(base) + i32(HALO)), at - base);
}

fn weighted(w: vec4f, a: vec4f, b: vec4f, c: vec4f, d: vec4f) -> vec4f {
    return w.x * a + w.y * b + w.z * c + w.w * d;
}

// A row of a map's stencil.
struct MapRow {
    a: vec4f,
    b: vec4f,
    c: vec4f,
    d: vec4f,
}

fn map_row(map: u32, texel: vec2u, panel: u32) -> MapRow {
    return MapRow(
        map_texel(map, texel, panel),
        map_texel(map, texel + vec2u(1u, 0u), panel),
        map_texel(map, texel + vec2u(2u, 0u), panel),
        map_texel(map, texel + vec2u(3u, 0u), panel),
    );
}

fn along_row(w: vec4f, row: MapRow) -> vec4f {
    return weighted(w, row.a, row.b, row.c, row.d);
}

// The 4 x 4 texels of a map around a place.
struct MapStencil {
    first: MapRow,
    second: MapRow,
    third: MapRow,
    fourth: MapRow,
}

fn map_stencil(map: u32, at: CellPoint) -> MapStencil {
    let first = at.texel - 1u;
    return MapStencil(
        map_row(map, first, at.panel),
        map_row(map, first + vec2u(0u, 1u), at.panel),
        map_row(map, first + vec2u(0u, 2u), at.panel),
        map_row(map, first + vec2u(0u, 3u), at.panel),
    );
}

// Values that lookups of this invocation met and that are not finite.
var<private> sanitised: u32;

// The unit vector that a stencil has between its middle texels, and in w what was gathered on the way from it. In place of what is not finite stands
// the finite one of two middle texels, on a diagonal; at the last `direction`, with nothing gathered.
fn map_between(stencil: MapStencil, wi: vec4f, wj: vec4f, direction: vec3f) -> vec4f {
    let interpolated = weighted(
        wj,
        along_row(wi, stencil.first),
        along_row(wi, stencil.second),
        along_row(wi, stencil.third),
        along_row(wi, stencil.fourth),
    );
    sanitised += select(1u, 0u, all_finite(interpolated));
    let below = stencil.second.b;
    let above = stencil.third.c;
    let stand_in = select(select(vec4f(direction, 0.0), above, all_finite(above)), below, all_finite(below));
    let found = select(stand_in, interpolated, all_finite(interpolated));
    // A map torn to opposite directions has no direction left.
    let length = length(found.xyz);
    return vec4f(select(direction, found.xyz * (1.0 / length), length > 1e-6), found.w);
}

fn map_at_point(map: u32, at: CellPoint, direction: vec3f) -> vec4f {
    return map_between(map_stencil(map, at), cubic_weights(at.t.x), cubic_weights(at.t.y), direction);
}

// A map of unit vectors at a direction, cubic: the unit vector there, and in w what was gathered on the way from it.
fn map_at(map: u32, direction: vec3f, cells: u32) -> vec4f {
    return map_at_point(map, cell_point(direction, cells), direction);
}

// A map at the center of a cell of another grid, numbered like an invocation of a pass over `other_cells` with the halo included.
fn map_at_cell(map: u32, id: vec3u, other_cells: u32, direction: vec3f, cells: u32) -> vec4f {
    return map_at_point(map, center_of(vec2i(id.xy) - i32(HALO), id.z, other_cells, cells), direction);
}

// A map at two by two cells of a finer grid that share a stencil: a quarter of the loads do. The first may be numbered -1, the halo's
// neighbour; the direction may be that of any of them, for all it does is to stand in for what is lost.
fn map_at_quad(map: u32, first_id: vec2i, panel: u32, other_cells: u32, direction: vec3f, cells: u32) -> array<vec4f, 4> {
    let at = center_of(first_id - i32(HALO), panel, other_cells, cells);
    let next = at.t + f32(cells) / f32(other_cells);
    let left = cubic_weights(at.t.x);
    let right = cubic_weights(next.x);
    let below = cubic_weights(at.t.y);
    let above = cubic_weights(next.y);
    let stencil = map_stencil(map, at);
    return array(
        map_between(stencil, left, below, direction),
        map_between(stencil, right, below, direction),
        map_between(stencil, left, above, direction),
        map_between(stencil, right, above, direction),
    );
}

// Weights of the Lagrange interpolation through TAPS neighbours for a fraction t in [0, 1] between the two middle ones.
fn lagrange_weights(t: f32) -> array<f32, 6> {
    if (TAPS == 2u) {
        return array(1.0 - t, t, 0.0, 0.0, 0.0, 0.0);
    }
    if (TAPS == 4u) {
        let w = cubic_weights(t);
        return array(w.x, w.y, w.z, w.w, 0.0, 0.0);
    }
    let far = (t + 2.0) * (t - 3.0);
    let middle = (t + 1.0) * (t - 2.0);
    let near = t * (t - 1.0);
    return array(
        near * middle * (t - 3.0) * (-1.0 / 120.0),
        near * far * (t - 2.0) * (1.0 / 24.0),
        (t - 1.0) * middle * far * (-1.0 / 12.0),
        t * middle * far * (1.0 / 12.0),
        near * far * (t + 1.0) * (-1.0 / 24.0),
        near * middle * (t + 2.0) * (1.0 / 120.0),
    );
}

// Where a texture of a film's cells is sampled for the four texels from one on.
fn gather_place(texel: vec2u, cells: u32) -> vec2f {
    return vec2f(texel + 1u) * (1.0 / f32(cells + 2u * HALO));
}

// The lower and the upper row of four gathered texels.
fn weighted_pair(texels: vec4f, first: f32, second: f32) -> vec2f {
    return first * texels.wx + second * texels.zy;
}

// Two rows of a tracer's stencil from a texel on, less a reference; `next`: their third and fourth texels, where a stencil has any.
fn tracer_rows(texel: vec2u, panel: u32, next: vec4f, w: array<f32, 6>, reference: f32) -> vec2f {
    var rows = weighted_pair(tracer_texels(texel, panel) - reference, w[0], w[1]);
    if (TAPS > 2u) {
        rows += weighted_pair(next - reference, w[2], w[3]);
    }
    if (TAPS > 4u) {
        rows += weighted_pair(tracer_texels(texel + vec2u(4u, 0u), panel) - reference, w[4], w[5]);
    }
    return rows;
}

// A tracer at a direction. What is interpolated is the difference from the nearest cell below, so that constants stay what they are
// to the last bit. Where a value of the stencil is not finite a neighbour's is the next best, and at last 0.
fn tracer_at(direction: vec3f, cells: u32) -> f32 {
    let at = cell_point(direction, cells);
    let wi = lagrange_weights(at.t.x);
    let wj = lagrange_weights(at.t.y);
    let middle = tracer_texels(at.texel, at.panel);
    let reference = middle.w;
    let above = middle.y;
    // Cells before the middle two.
    let first = at.texel - (TAPS / 2u - 1u);
    var next = middle;
    if (TAPS > 2u) {
        next = tracer_texels(first + vec2u(2u, 0u), at.panel);
    }
    var rows = tracer_rows(first, at.panel, next, wi, reference);
    var total = wj[0] * rows.x + wj[1] * rows.y;
    if (TAPS > 2u) {
        // Of six rows these are the middle ones.
        next = middle;
        if (TAPS == 4u) {
            next = tracer_texels(first + 2u, at.panel);
        }
        rows = tracer_rows(first + vec2u(0u, 2u), at.panel, next, wi, reference);
        total += wj[2] * rows.x + wj[3] * rows.y;
    }
    if (TAPS > 4u) {
        next = tracer_texels(first + vec2u(2u, 4u), at.panel);
        rows = tracer_rows(first + vec2u(0u, 4u), at.panel, next, wi, reference);
        total += wj[4] * rows.x + wj[5] * rows.y;
    }
    if (LIMITER == 1u) {
        let low = min(min(0.0, above - reference), min(middle.z - reference, middle.x - reference));
        let high = max(max(0.0, above - reference), max(middle.z - reference, middle.x - reference));
        total = select(total, clamp(total, low, high), is_finite(total));
    }
    sanitised += select(1u, 0u, is_finite(total));
    let neighbour = select(select(0.0, above, is_finite(above)), reference, is_finite(reference));
    return select(neighbour, reference + total, is_finite(total));
}
