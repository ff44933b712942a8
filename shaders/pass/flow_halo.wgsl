// Fills the halo of a field in one dispatch of one workgroup for each film, which are stored one after the other: the cells beyond an edge,
// then those beyond a corner, which read the edges. On grids as coarse as the flow's a second dispatch would cost more than idle lanes.

import package::sphere::cubed::HALO;
import package::sphere::halo::HaloEntry;

const LANES: u32 = 256u;

@group(0) @binding(0) var<storage, read> entries: array<HaloEntry>;
@group(0) @binding(1) var<storage, read_write> scalar: array<f32>;
@group(0) @binding(2) var<storage, read_write> other: array<f32>;
@group(0) @binding(1) var<storage, read_write> pair: array<vec2f>;
@group(0) @binding(1) var<storage, read_write> velocity: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> velocity_ahead: array<vec4f>;

// Entries of edges come first; all the rest are corners.
fn edges() -> u32 {
    return arrayLength(&entries) - 24u * HALO * HALO;
}

fn fill_scalar(first: u32, entry: u32) {
    let halo = entries[entry];
    let at = first + halo.first;
    scalar[first + halo.cell] = halo.weights.x * scalar[at] + halo.weights.y * scalar[at + halo.step] +
        halo.weights.z * scalar[at + 2u * halo.step] + halo.weights.w * scalar[at + 3u * halo.step];
}

fn fill_two(first: u32, entry: u32) {
    fill_scalar(first, entry);
    let halo = entries[entry];
    let at = first + halo.first;
    other[first + halo.cell] = halo.weights.x * other[at] + halo.weights.y * other[at + halo.step] +
        halo.weights.z * other[at + 2u * halo.step] + halo.weights.w * other[at + 3u * halo.step];
}

fn fill_pair(first: u32, entry: u32) {
    let halo = entries[entry];
    let at = first + halo.first;
    pair[first + halo.cell] = halo.weights.x * pair[at] + halo.weights.y * pair[at + halo.step] +
        halo.weights.z * pair[at + 2u * halo.step] + halo.weights.w * pair[at + 3u * halo.step];
}

// Within the range of what it is interpolated from.
fn fill_bounded(first: u32, entry: u32) {
    let halo = entries[entry];
    let at = first + halo.first;
    let four = vec4f(scalar[at], scalar[at + halo.step], scalar[at + 2u * halo.step], scalar[at + 3u * halo.step]);
    let low = min(min(four.x, four.y), min(four.z, four.w));
    let high = max(max(four.x, four.y), max(four.z, four.w));
    scalar[first + halo.cell] = clamp(dot(halo.weights, four), low, high);
}

fn fill_velocities(first: u32, entry: u32) {
    let halo = entries[entry];
    let at = first + halo.first;
    velocity[first + halo.cell] = halo.weights.x * velocity[at] + halo.weights.y * velocity[at + halo.step] +
        halo.weights.z * velocity[at + 2u * halo.step] + halo.weights.w * velocity[at + 3u * halo.step];
    velocity_ahead[first + halo.cell] = halo.weights.x * velocity_ahead[at] + halo.weights.y * velocity_ahead[at + halo.step] +
        halo.weights.z * velocity_ahead[at + 2u * halo.step] + halo.weights.w * velocity_ahead[at + 3u * halo.step];
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
fn halo_of_two(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let first = group.x * (arrayLength(&scalar) / groups.x);
    for (var entry = lane; entry < edges(); entry += LANES) {
        fill_two(first, entry);
    }
    storageBarrier();
    for (var entry = edges() + lane; entry < arrayLength(&entries); entry += LANES) {
        fill_two(first, entry);
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
