// The Laplacian of the stream function that a pass works on, which it declares as `psi: array<f32>` in padded storage, with the grid's
// `tangents: array<f32>`. Four cells of each of two rows are done together: they share most of what they read, and reading is what a pass costs.

import package::sphere::cubed::{HALO, padded_index};

// Four cells of a row and their neighbours along it: the cells 2 and 1 before each, itself, and 1 and 2 after.
struct Row {
    before2: vec4f,
    before: vec4f,
    here: vec4f,
    after: vec4f,
    after2: vec4f,
}

fn row_of(at: u32) -> Row {
    let a = vec4f(psi[at - 2u], psi[at - 1u], psi[at], psi[at + 1u]);
    let b = vec4f(psi[at + 2u], psi[at + 3u], psi[at + 4u], psi[at + 5u]);
    return Row(a, vec4f(a.yzw, b.x), vec4f(a.zw, b.xy), vec4f(a.w, b.xyz), b);
}

struct FourCells {
    here: vec4f,
    laplacian: vec4f,
    // Factor of the cells' own values in it.
    own: vec4f,
}

// The middle one of five rows, at these tangents along and across it, with 1 over the square of the cell angle.
fn four_cells(rows: array<Row, 5>, along: vec4f, across: f32, per_angle2: f32) -> FourCells {
    let here = rows[2].here;
    let by_aa = 16.0 * (rows[2].before + rows[2].after) - (rows[2].before2 + rows[2].after2) - 30.0 * here;
    let by_bb = 16.0 * (rows[1].here + rows[3].here) - (rows[0].here + rows[4].here) - 30.0 * here;
    // Slopes across the rows, of eight cells, in twelfths over the cell angle.
    let early = 8.0 * (rows[3].before2 - rows[1].before2) - (rows[4].before2 - rows[0].before2);
    let late = 8.0 * (rows[3].after2 - rows[1].after2) - (rows[4].after2 - rows[0].after2);
    let by_ab = 8.0 * (vec4f(early.w, late.xyz) - vec4f(early.yzw, late.x)) - (late - early);
    // See `CellMetric::laplacian_factors` in src/physics/flow/operators.rs.
    let a = 1.0 / (1.0 + along * along);
    let b = 1.0 / (1.0 + across * across);
    let delta2 = 1.0 + along * along + across * across;
    let by_a = per_angle2 / 12.0 * delta2 * a;
    let by_b = per_angle2 / 12.0 * b * delta2;
    let found = by_a * by_aa + across * b / 6.0 * along * by_a * by_ab + by_b * by_bb;
    return FourCells(here, found, -30.0 * (by_a + by_b));
}

// An invocation's cells, four of each of two rows, and where each four begin in storage.
struct EightCells {
    at: vec2u,
    rows: array<FourCells, 2>,
}

// Where eight cells do not divide a panel, the last ones overlap others, with the same answer.
fn eight_cells(id: vec3u, cells: u32, per_angle2: f32) -> EightCells {
    let first = min(vec2u(4u, 2u) * id.xy, vec2u(cells) - vec2u(4u, 2u));
    let k = first + HALO;
    let side = cells + 2u * HALO;
    let at = padded_index(id.z, i32(first.x), i32(first.y), cells);
    let along = vec4f(tangents[k.x], tangents[k.x + 1u], tangents[k.x + 2u], tangents[k.x + 3u]);
    return EightCells(vec2u(at, at + side), two_rows(at, side, along, vec2f(tangents[k.y], tangents[k.y + 1u]), per_angle2));
}

// Four cells of each of two rows from a place in storage, whose rows are `side` long.
fn two_rows(at: u32, side: u32, along: vec4f, across: vec2f, per_angle2: f32) -> array<FourCells, 2> {
    let a = row_of(at - 2u * side);
    let b = row_of(at - side);
    let c = row_of(at);
    let d = row_of(at + side);
    let e = row_of(at + 2u * side);
    let f = row_of(at + 3u * side);
    return array(
        four_cells(array(a, b, c, d, e), along, across.x, per_angle2),
        four_cells(array(b, c, d, e, f), along, across.y, per_angle2),
    );
}
