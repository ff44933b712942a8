// How far a film's amount of liquid is from what it must be, and the smallest correction that restores it. What is summed is the
// area-weighted difference from the mean, pairwise: the parts cancel on the way up, so that nothing large is rounded.

import package::film::control::{Balance, Control, is_finite};
import package::sphere::cubed::{padded_index, quotient};

// Mirrors `ConserveUniform` in src/gpu/passes/conserve.rs.
struct Conserve {
    cells: u32,
    // Workgroups that `sum_parts` runs, 256 at most.
    parts: u32,
    // The mean to restore, in two parts: the second is what rounding the first left over.
    mean: f32,
    mean_rest: f32,
    // Bounds that a corrected value must keep; they count where `bounded` is 1.
    low: f32,
    high: f32,
    bounded: u32,
    // What is added to corrected values.
    level: f32,
    // Solid angle of the film.
    film_area: f32,
}

@group(0) @binding(0) var<uniform> conserve: Conserve;
// Solid angles of the cells of one panel, as all panels are alike; of the cells of all panels where a film has a rim.
@group(0) @binding(1) var<storage, read> areas: array<f32>;
@group(0) @binding(2) var<storage, read> field: array<f32>;
@group(0) @binding(3) var<storage, read_write> partial_sums: array<f32, 256>;
@group(0) @binding(4) var<storage, read_write> balance: Balance;
@group(0) @binding(5) var<storage, read_write> control: Control;

var<workgroup> sums: array<f32, 256>;

// Adds the upper half of the sums to the lower half, repeatedly, until `last` sums remain. Each invocation keeps to places that are a
// multiple of `last` apart, so that none has to wait for another: software rasterisers pay for barriers more than for sums.
fn add_halves(first: u32, last: u32, local: u32) {
    if (local >= last) {
        return;
    }
    for (var half = first / 2u; half >= last; half >>= 1u) {
        for (var k = local; k < half; k += last) {
            sums[k] += sums[k + half];
        }
    }
}

// The sum over the workgroup; all invocations must call it.
fn workgroup_sum(value: f32, local: u32) -> f32 {
    sums[local] = value;
    workgroupBarrier();
    add_halves(256u, 16u, local);
    workgroupBarrier();
    add_halves(16u, 1u, local);
    workgroupBarrier();
    return sums[0];
}

@compute @workgroup_size(256)
fn sum_parts(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let panel_cells = conserve.cells * conserve.cells;
    let areas_are_alike = arrayLength(&areas) == panel_cells;
    var sum = 0.0;
    for (var cell = group.x * 256u + local; cell < 6u * panel_cells; cell += conserve.parts * 256u) {
        let panel = quotient(cell, panel_cells);
        let place = cell - panel * panel_cells;
        let j = quotient(place, conserve.cells);
        let i = place - j * conserve.cells;
        let value = field[padded_index(panel, i32(i), i32(j), conserve.cells)];
        if (is_finite(value)) {
            sum += areas[select(cell, place, areas_are_alike)] * ((value - conserve.mean) - conserve.mean_rest);
        }
    }
    let total = workgroup_sum(sum, local);
    if (local == 0u) {
        partial_sums[group.x] = total;
    }
}

// The sum of the parts; all invocations must call it.
fn sum_of_parts(local: u32) -> f32 {
    var sum = 0.0;
    if (local < conserve.parts) {
        sum = partial_sums[local];
    }
    return workgroup_sum(sum, local);
}

// Makes the present amount the one to be conserved from now on.
@compute @workgroup_size(256)
fn count_spared(@builtin(local_invocation_index) local: u32) {
    let excess = sum_of_parts(local);
    if (local == 0u) {
        control.spared_nm = excess / conserve.film_area + control.drained_nm;
    }
}

// Takes what the field lacks for what has left it.
@compute @workgroup_size(256)
fn count_drained(@builtin(local_invocation_index) local: u32) {
    let excess = sum_of_parts(local);
    if (local == 0u) {
        control.drained_nm = control.spared_nm - excess / conserve.film_area;
    }
}

@compute @workgroup_size(256)
fn balance_sum(@builtin(local_invocation_index) local: u32) {
    let excess = sum_of_parts(local) - (control.spared_nm - control.drained_nm) * conserve.film_area;
    if (local != 0u) {
        return;
    }
    if (conserve.bounded == 0u) {
        balance = Balance(-excess / conserve.film_area, 0.0, conserve.level);
        return;
    }
    // Liquid is taken in proportion to what stands above the lower bound, or given in proportion to what is missing to the upper one.
    let bound = select(conserve.high, conserve.low, excess > 0.0);
    let room = abs(conserve.mean - bound) * conserve.film_area + abs(excess);
    let part = select(0.0, clamp(abs(excess) / room, 0.0, 1.0), room > 0.0);
    balance = Balance(part * bound, -part, conserve.level);
}
