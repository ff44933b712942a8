// Interpolation of fields on the cubed sphere at any direction, by Lagrange weights. Panels are stored with halos, so no lookup sees an edge.
// Weights are computed here: filtering hardware has 8 bits for what needs 20.
//
// A pass that looks fields up defines two functions for them:
//     fn map_value(map: u32, place: u32) -> vec4f     the value of one of its maps at a place in padded storage
//     fn tracer_value(place: u32) -> f32              a value of its tracer

import package::film::control::{all_finite, is_finite};
import package::sphere::cubed::{HALO, cubic_weights, locate, padded_index};

// Taps along each side of a tracer's stencil: 2 linear, 4 cubic, 6 quintic.
override TAPS: u32;
// 1: looked-up tracers stay within the range of the four cells around them.
override LIMITER: u32;

// A place between cells: the padded index of the cell below it in both directions, the fractions beyond that cell's center, and the
// distance of rows in storage.
struct CellPoint {
    place: u32,
    stride: u32,
    t: vec2f,
}

fn cell_point(direction: vec3f, cells: u32) -> CellPoint {
    let at = locate(direction, cells);
    // Rounding must not carry a point on the panel's edge past the halo.
    let cell = clamp(at.cell, vec2f(-0.5), vec2f(f32(cells) - 0.5));
    let base = floor(cell);
    return CellPoint(padded_index(at.panel, i32(base.x), i32(base.y), cells), cells + 2u * HALO, cell - base);
}

fn weighted(w: vec4f, a: vec4f, b: vec4f, c: vec4f, d: vec4f) -> vec4f {
    return w.x * a + w.y * b + w.z * c + w.w * d;
}

fn map_row(map: u32, place: u32, w: vec4f) -> vec4f {
    return weighted(
        w,
        map_value(map, place),
        map_value(map, place + 1u),
        map_value(map, place + 2u),
        map_value(map, place + 3u),
    );
}

// Values that lookups of this invocation met and that are not finite.
var<private> sanitised: u32;

// The finite one of two neighbours, the stencil's middle ones on a diagonal, in place of an interpolation that met a value that is not; at
// the last `direction`, with nothing gathered. They are loaded whether they are needed or not: software rasterisers walk both ways of every
// branch, so a careful search would cost every lookup as much again. Compilers see that the rows have them already where the places are written
// as the rows write them.
fn substitute_map(map: u32, middle_row: u32, upper_row: u32, direction: vec3f) -> vec4f {
    let below = map_value(map, middle_row + 1u);
    let above = map_value(map, upper_row + 2u);
    return select(select(vec4f(direction, 0.0), above, all_finite(above)), below, all_finite(below));
}

// A map of unit vectors at a direction, cubic: the unit vector there, and in w what was gathered on the way from it.
fn map_at(map: u32, direction: vec3f, cells: u32) -> vec4f {
    return map_between(map, cell_point(direction, cells), direction);
}

// Where the center of a cell of another grid is, beyond the panel's edge or within: on all grids of the same panels its place is known.
// Halo cells of a coarser grid than the one looked up are not allowed.
fn center_of(cell: vec2i, panel: u32, other_cells: u32, cells: u32) -> CellPoint {
    let at = (vec2f(cell) + 0.5) * f32(cells) / f32(other_cells) - 0.5;
    // No stencil reaches beyond the halo.
    let base = clamp(floor(at), vec2f(1.0 - f32(HALO)), vec2f(f32(cells + HALO) - 3.0));
    return CellPoint(padded_index(panel, i32(base.x), i32(base.y), cells), cells + 2u * HALO, at - base);
}

// A map at the center of a cell of another grid, numbered like an invocation of a pass over `other_cells` with the halo included.
fn map_at_cell(map: u32, id: vec3u, other_cells: u32, direction: vec3f, cells: u32) -> vec4f {
    return map_between(map, center_of(vec2i(id.xy) - i32(HALO), id.z, other_cells, cells), direction);
}

fn map_between(map: u32, at: CellPoint, direction: vec3f) -> vec4f {
    let wi = cubic_weights(at.t.x);
    let wj = cubic_weights(at.t.y);
    let first = at.place - at.stride - 1u;
    let middle = first + at.stride;
    let upper = first + 2u * at.stride;
    let found = weighted(
        wj,
        map_row(map, first, wi),
        map_row(map, middle, wi),
        map_row(map, upper, wi),
        map_row(map, first + 3u * at.stride, wi),
    );
    return sanitised_map(map, found, vec2u(middle, upper), direction);
}

// What was interpolated in a map as a unit vector, or what stands in for it.
fn sanitised_map(map: u32, interpolated: vec4f, middle_rows: vec2u, direction: vec3f) -> vec4f {
    sanitised += select(1u, 0u, all_finite(interpolated));
    let stand_in = substitute_map(map, middle_rows.x, middle_rows.y, direction);
    let found = select(stand_in, interpolated, all_finite(interpolated));
    // A map torn to opposite directions has no direction left.
    let length = length(found.xyz);
    return vec4f(select(direction, found.xyz / length, length > 1e-6), found.w);
}

// A row of a stencil at the first of two places along it, and at the second.
struct QuadRow {
    first: vec4f,
    second: vec4f,
}

fn map_quad_row(map: u32, place: u32, first: vec4f, second: vec4f) -> QuadRow {
    let a = map_value(map, place);
    let b = map_value(map, place + 1u);
    let c = map_value(map, place + 2u);
    let d = map_value(map, place + 3u);
    return QuadRow(weighted(first, a, b, c, d), weighted(second, a, b, c, d));
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
    let first = at.place - at.stride - 1u;
    let middle = vec2u(first + at.stride, first + 2u * at.stride);
    let a = map_quad_row(map, first, left, right);
    let b = map_quad_row(map, middle.x, left, right);
    let c = map_quad_row(map, middle.y, left, right);
    let d = map_quad_row(map, first + 3u * at.stride, left, right);
    return array(
        sanitised_map(map, weighted(below, a.first, b.first, c.first, d.first), middle, direction),
        sanitised_map(map, weighted(below, a.second, b.second, c.second, d.second), middle, direction),
        sanitised_map(map, weighted(above, a.first, b.first, c.first, d.first), middle, direction),
        sanitised_map(map, weighted(above, a.second, b.second, c.second, d.second), middle, direction),
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
        -near * middle * (t - 3.0) / 120.0,
        near * far * (t - 2.0) / 24.0,
        -(t - 1.0) * middle * far / 12.0,
        t * middle * far / 12.0,
        -near * far * (t + 1.0) / 24.0,
        near * middle * (t + 2.0) / 120.0,
    );
}

// A row of a tracer's stencil, less a reference.
fn tracer_row(place: u32, w: array<f32, 6>, reference: f32) -> f32 {
    var row = w[0] * (tracer_value(place) - reference) + w[1] * (tracer_value(place + 1u) - reference);
    if (TAPS > 2u) {
        row += w[2] * (tracer_value(place + 2u) - reference) + w[3] * (tracer_value(place + 3u) - reference);
    }
    if (TAPS > 4u) {
        row += w[4] * (tracer_value(place + 4u) - reference) + w[5] * (tracer_value(place + 5u) - reference);
    }
    return row;
}

// A tracer at a direction. What is interpolated is the difference from the nearest cell below, so that constants stay what they are
// to the last bit. Where a value of the stencil is not finite a neighbour's is the next best, and at last 0.
fn tracer_at(direction: vec3f, cells: u32) -> f32 {
    let at = cell_point(direction, cells);
    let wi = lagrange_weights(at.t.x);
    let wj = lagrange_weights(at.t.y);
    // Cells before the middle two. Their places are written as the rows write them, so that compilers see that they are loaded already.
    let before = TAPS / 2u - 1u;
    let first = at.place - before * (at.stride + 1u);
    let reference = tracer_value(first + before * at.stride + before);
    var total = wj[0] * tracer_row(first, wi, reference) + wj[1] * tracer_row(first + at.stride, wi, reference);
    if (TAPS > 2u) {
        total += wj[2] * tracer_row(first + 2u * at.stride, wi, reference) +
            wj[3] * tracer_row(first + 3u * at.stride, wi, reference);
    }
    if (TAPS > 4u) {
        total += wj[4] * tracer_row(first + 4u * at.stride, wi, reference) +
            wj[5] * tracer_row(first + 5u * at.stride, wi, reference);
    }
    let above = tracer_value(first + (before + 1u) * at.stride + (before + 1u));
    if (LIMITER == 1u) {
        let across = tracer_value(first + before * at.stride + (before + 1u)) - reference;
        let up = tracer_value(first + (before + 1u) * at.stride + before) - reference;
        let low = min(min(0.0, above - reference), min(across, up));
        let high = max(max(0.0, above - reference), max(across, up));
        total = select(total, clamp(total, low, high), is_finite(total));
    }
    sanitised += select(1u, 0u, is_finite(total));
    let neighbour = select(select(0.0, above, is_finite(above)), reference, is_finite(reference));
    return select(neighbour, reference + total, is_finite(total));
}
