// All grids of a multigrid cycle below the finest, by one workgroup for each film: the finest's residual is averaged down to the coarsest,
// solved there, and each grid on the way up interpolates the correction and smooths it. Grids so small are done sooner by one workgroup than
// they are handed out.

import package::flow::operators::area_density;
import package::sphere::cubed::{HALO, padded_index, quotient};
import package::sphere::halo::HaloEntry;

const LANES: u32 = 128u;

// One grid. Mirrors `CoarseLevel` in src/gpu/passes/flow_coarse.rs.
struct Level {
    // Of each sweep.
    weights: vec3f,
    // 1 over the square of the cell angle, 1/rad2.
    per_angle2: f32,
    // Cells along a panel's edge.
    cells: u32,
    // Where its values, tangents and halo entries start in the lists for all grids; of the values, those of the first film.
    field: u32,
    tangent: u32,
    halo: u32,
}

// Mirrors `CoarseSystem` in src/gpu/passes/flow_coarse.rs.
struct Coarse {
    // How many grids, the finest first, of which only the residual is here.
    levels: u32,
    // Values of all films on all grids: the distance from one bank of corrections to the other.
    values: u32,
    shift: f32,
    // Sweeps on the coarsest, an even number.
    sweeps: u32,
    level: array<Level, 12>,
    // Weights of these sweeps.
    coarsest: array<vec4f, 8>,
}

// Of each film.
@group(0) @binding(0) var<storage, read> coarse: array<Coarse>;
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> entries: array<HaloEntry>;
// Right sides.
@group(0) @binding(3) var<storage, read_write> f: array<f32>;
// Two banks of corrections: sweeps read one and write the other, and end in the first.
@group(0) @binding(4) var<storage, read_write> e: array<f32>;

var<workgroup> shares: array<f32, 128>;

// A grid, with where the values of a film start.
fn level_of(film: u32, l: u32) -> Level {
    var level = coarse[film].level[l];
    level.field += film * 6u * side_of(level) * side_of(level);
    return level;
}

struct Cell {
    panel: u32,
    ij: vec2u,
    at: u32,
}

fn cell_of(level: Level, index: u32) -> Cell {
    let row = quotient(index, level.cells);
    let panel = quotient(row, level.cells);
    let ij = vec2u(index - row * level.cells, row - panel * level.cells);
    return Cell(panel, ij, padded_index(panel, i32(ij.x), i32(ij.y), level.cells));
}

fn tangent_of(level: Level, ij: vec2u) -> vec2f {
    return vec2f(tangents[level.tangent + ij.x + HALO], tangents[level.tangent + ij.y + HALO]);
}

fn side_of(level: Level) -> u32 {
    return level.cells + 2u * HALO;
}

fn fill(base: u32, entry: u32) {
    let halo = entries[entry];
    let at = base + halo.first;
    e[base + halo.cell] = halo.weights.x * e[at] + halo.weights.y * e[at + halo.step] +
        halo.weights.z * e[at + 2u * halo.step] + halo.weights.w * e[at + 3u * halo.step];
}

// The innermost ring, which is all that is read of it, and the second on the way to its corners: see `HaloTable`.
fn fill_halo(film: u32, level: Level, lane: u32, bank: u32) {
    let base = bank * coarse[film].values + level.field;
    storageBarrier();
    for (var k = lane; k < 48u * level.cells; k += LANES) {
        fill(base, level.halo + k);
    }
    storageBarrier();
    if (lane < 24u) {
        fill(base, level.halo + 24u * HALO * level.cells + lane);
    }
    storageBarrier();
}

// Four cells of a row of corrections, and the cells before and after each.
struct Row {
    before: vec4f,
    here: vec4f,
    after: vec4f,
}

fn row_of(at: u32) -> Row {
    let here = vec4f(e[at], e[at + 1u], e[at + 2u], e[at + 3u]);
    return Row(vec4f(e[at - 1u], here.xyz), here, vec4f(here.yzw, e[at + 4u]));
}

// A sweep over a grid; `mean` is left out of the right side.
struct Sweep {
    per_angle2: f32,
    shift: f32,
    weight: f32,
    mean: f32,
}

// What a sweep makes of the middle one of three rows, with these right sides at these tangents: differences of second order.
fn swept(rows: array<Row, 3>, right: vec4f, along: vec4f, across: f32, s: Sweep) -> vec4f {
    let here = rows[1].here;
    let by_aa = rows[1].before + rows[1].after - 2.0 * here;
    let by_bb = rows[0].here + rows[2].here - 2.0 * here;
    let by_ab = (rows[2].after - rows[0].after) - (rows[2].before - rows[0].before);
    // See `CellMetric::laplacian_factors` in src/physics/flow/operators.rs.
    let a = 1.0 / (1.0 + along * along);
    let b = 1.0 / (1.0 + across * across);
    let delta2 = 1.0 + along * along + across * across;
    let by_a = s.per_angle2 * delta2 * a;
    let by_b = s.per_angle2 * b * delta2;
    let found = by_a * by_aa + 0.5 * across * b * along * by_a * by_ab + by_b * by_bb;
    let residual = right - s.mean - found + s.shift * here;
    return here + s.weight * residual / (-2.0 * (by_a + by_b) - s.shift);
}

fn right_sides(at: u32) -> vec4f {
    return vec4f(f[at], f[at + 1u], f[at + 2u], f[at + 3u]);
}

fn store(at: u32, four: vec4f) {
    e[at] = four.x;
    e[at + 1u] = four.y;
    e[at + 2u] = four.z;
    e[at + 3u] = four.w;
}

// A damped Jacobi sweep from one bank to the other. A lane does four cells of each of two rows at a time: they share most of what they read.
// Where these do not divide a panel, the last ones overlap others, with the same answer.
fn sweep(film: u32, level: Level, lane: u32, bank: u32, weight: f32, mean: f32) {
    let side = side_of(level);
    let read_from = bank * coarse[film].values;
    let written_to = (1u - bank) * coarse[film].values;
    let s = Sweep(level.per_angle2, coarse[film].shift, weight, mean);
    let eights = (level.cells + vec2u(3u, 1u)) / vec2u(4u, 2u);
    for (var k = lane; k < 6u * eights.x * eights.y; k += LANES) {
        let row = quotient(k, eights.x);
        let panel = quotient(row, eights.y);
        let ij = min(vec2u(4u, 2u) * vec2u(k - row * eights.x, row - panel * eights.y), vec2u(level.cells) - vec2u(4u, 2u));
        let at = level.field + padded_index(panel, i32(ij.x), i32(ij.y), level.cells);
        let p = read_from + at;
        let q = written_to + at;
        let a = row_of(p - side);
        let b = row_of(p);
        let c = row_of(p + side);
        let d = row_of(p + 2u * side);
        let t = level.tangent + ij + HALO;
        let along = vec4f(tangents[t.x], tangents[t.x + 1u], tangents[t.x + 2u], tangents[t.x + 3u]);
        store(q, swept(array(a, b, c), right_sides(at), along, tangents[t.y], s));
        store(q + side, swept(array(b, c, d), right_sides(at + side), along, tangents[t.y + 1u], s));
    }
    fill_halo(film, level, lane, 1u - bank);
}

// The finer grid's right side, sampled bilinearly within each panel: where grids nest, means of four.
fn average(fine: Level, level: Level, lane: u32) {
    let ratio = f32(fine.cells) / f32(level.cells);
    let side = side_of(fine);
    for (var k = lane; k < 6u * level.cells * level.cells; k += LANES) {
        let cell = cell_of(level, k);
        let place = (vec2f(cell.ij) + 0.5) * ratio - 0.5;
        let first = clamp(floor(place), vec2f(0.0), vec2f(f32(fine.cells) - 2.0));
        let t = clamp(place - first, vec2f(0.0), vec2f(1.0));
        let at = fine.field + padded_index(cell.panel, i32(first.x), i32(first.y), fine.cells);
        f[level.field + cell.at] = mix(mix(f[at], f[at + 1u], t.x), mix(f[at + side], f[at + side + 1u], t.x), t.y);
    }
    storageBarrier();
}

// The coarser grid's correction, bilinearly, into the second bank.
fn interpolate(film: u32, below: Level, level: Level, lane: u32) {
    let side = side_of(below);
    for (var k = lane; k < 6u * level.cells * level.cells; k += LANES) {
        let cell = cell_of(level, k);
        let place = (vec2f(cell.ij) + 0.5) * f32(below.cells) / f32(level.cells) - 0.5;
        let t = place - floor(place);
        let at = below.field + padded_index(cell.panel, i32(floor(place.x)), i32(floor(place.y)), below.cells);
        e[coarse[film].values + level.field + cell.at] = mix(mix(e[at], e[at + 1u], t.x), mix(e[at + side], e[at + side + 1u], t.x), t.y);
    }
    fill_halo(film, level, lane, 1u);
}

// The mean of a grid's right side.
fn mean_of(level: Level, lane: u32) -> f32 {
    var sums = vec2f(0.0);
    for (var k = lane; k < 6u * level.cells * level.cells; k += LANES) {
        let cell = cell_of(level, k);
        let area = area_density(tangent_of(level, cell.ij));
        sums += area * vec2f(f[level.field + cell.at], 1.0);
    }
    let total = sum_of(sums.x, lane);
    return total / sum_of(sums.y, lane);
}

// The sum of every lane's share.
fn sum_of(share: f32, lane: u32) -> f32 {
    workgroupBarrier();
    shares[lane] = share;
    for (var half = LANES / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if (lane < half) {
            shares[lane] += shares[lane + half];
        }
    }
    workgroupBarrier();
    return shares[0];
}

fn solve_coarsest(film: u32, level: Level, lane: u32) {
    let mean = mean_of(level, lane);
    for (var k = lane; k < 6u * side_of(level) * side_of(level); k += LANES) {
        e[level.field + k] = 0.0;
    }
    storageBarrier();
    for (var k = 0u; k < coarse[film].sweeps; k++) {
        sweep(film, level, lane, k % 2u, coarse[film].coarsest[k / 4u][k % 4u], mean);
    }
}

@compute @workgroup_size(128)
fn flow_coarse(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let film = group.x;
    let levels = coarse[film].levels;
    for (var l = 1u; l < levels; l++) {
        average(level_of(film, l - 1u), level_of(film, l), lane);
    }
    solve_coarsest(film, level_of(film, levels - 1u), lane);
    for (var l = levels - 1u; l > 1u; l--) {
        let level = level_of(film, l - 1u);
        interpolate(film, level_of(film, l), level, lane);
        sweep(film, level, lane, 1u, level.weights.x, 0.0);
        sweep(film, level, lane, 0u, level.weights.y, 0.0);
        sweep(film, level, lane, 1u, level.weights.z, 0.0);
    }
}
