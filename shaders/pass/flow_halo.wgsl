// Fills the halo of a field in one dispatch of one workgroup for each film, which are stored one after the other: the cells beyond an edge,
// then those beyond a corner, which read the edges. On grids as coarse as the flow's a second dispatch would cost more than idle lanes.

import package::sphere::cubed::HALO;
import package::sphere::halo::HaloEntry;

const LANES: u32 = 256u;

@group(0) @binding(0) var<storage, read> entries: array<HaloEntry>;
@group(0) @binding(1) var<storage, read_write> scalar: array<f32>;
@group(0) @binding(1) var<storage, read_write> pair: array<vec2f>;
@group(0) @binding(1) var<storage, read_write> velocity: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> velocity_ahead: array<vec4f>;

// Entries of edges come first; all the rest are corners.
fn edges() -> u32 {
    return arrayLength(&entries) - 24u * HALO * HALO;
}

fn fill_scalar(first: u32, entry: u32) {
    var total = 0.0;
    for (var k = 0u; k < 4u; k++) {
        total += entries[entry].weights[k] * scalar[first + entries[entry].sources[k]];
    }
    scalar[first + entries[entry].cell] = total;
}

fn fill_pair(first: u32, entry: u32) {
    var total = vec2f(0.0);
    for (var k = 0u; k < 4u; k++) {
        total += entries[entry].weights[k] * pair[first + entries[entry].sources[k]];
    }
    pair[first + entries[entry].cell] = total;
}

// Within the range of what it is interpolated from.
fn fill_bounded(first: u32, entry: u32) {
    var total = 0.0;
    var low = scalar[first + entries[entry].sources[0]];
    var high = low;
    for (var k = 0u; k < 4u; k++) {
        let value = scalar[first + entries[entry].sources[k]];
        total += entries[entry].weights[k] * value;
        low = min(low, value);
        high = max(high, value);
    }
    scalar[first + entries[entry].cell] = clamp(total, low, high);
}

fn fill_velocities(first: u32, entry: u32) {
    var total = vec4f(0.0);
    var total_ahead = vec4f(0.0);
    for (var k = 0u; k < 4u; k++) {
        total += entries[entry].weights[k] * velocity[first + entries[entry].sources[k]];
        total_ahead += entries[entry].weights[k] * velocity_ahead[first + entries[entry].sources[k]];
    }
    velocity[first + entries[entry].cell] = total;
    velocity_ahead[first + entries[entry].cell] = total_ahead;
}

@compute @workgroup_size(256)
fn halo_of_scalar(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let first = group.x * (arrayLength(&scalar) / groups.x);
    for (var entry = lane; entry < edges(); entry += LANES) {
        fill_scalar(first, entry);
    }
    storageBarrier();
    for (var entry = edges() + lane; entry < arrayLength(&entries); entry += LANES) {
        fill_scalar(first, entry);
    }
}

@compute @workgroup_size(256)
fn halo_of_pair(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let first = group.x * (arrayLength(&pair) / groups.x);
    for (var entry = lane; entry < edges(); entry += LANES) {
        fill_pair(first, entry);
    }
    storageBarrier();
    for (var entry = edges() + lane; entry < arrayLength(&entries); entry += LANES) {
        fill_pair(first, entry);
    }
}

@compute @workgroup_size(256)
fn halo_of_thickness(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let first = group.x * (arrayLength(&scalar) / groups.x);
    for (var entry = lane; entry < edges(); entry += LANES) {
        fill_bounded(first, entry);
    }
    storageBarrier();
    for (var entry = edges() + lane; entry < arrayLength(&entries); entry += LANES) {
        fill_bounded(first, entry);
    }
}

@compute @workgroup_size(256)
fn halo_of_velocities(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let first = group.x * (arrayLength(&velocity) / groups.x);
    for (var entry = lane; entry < edges(); entry += LANES) {
        fill_velocities(first, entry);
    }
    storageBarrier();
    for (var entry = edges() + lane; entry < arrayLength(&entries); entry += LANES) {
        fill_velocities(first, entry);
    }
}
