// Whether the map has become too distorted to go on with, and the arguments of the dispatches that then remap: zero workgroups if it has not.

import package::film::control::Control;
import package::sphere::cubed::HALO;

// Mirrors `DecideUniform` in src/gpu/passes/decide_remap.rs.
struct Decide {
    // Cells along a panel's edge.
    cells: u32,
    // Angle between neighbouring cells, radians.
    cell_angle: f32,
    // Error of interpolating the map, in cells, at which it is remapped.
    error_limit: f32,
    // Ticks since the last decision, and the maximum between two remaps.
    ticks: u32,
    latest_ticks: u32,
    // Workgroups of a pass over the tracer's texels, and of its sum.
    tracer_groups: vec3u,
    sum_groups: u32,
    // Workgroups of a pass over the map's texels, and of one over the tracer's, two by two.
    map_groups: vec3u,
    quad_groups: vec3u,
}

// Arguments of indirect dispatches: passes over the tracer's texels, its sum, the sum of the parts, passes over the map's texels, and over
// the tracer's, two by two.
struct Arguments {
    tracer_groups: array<u32, 3>,
    sum_groups: array<u32, 3>,
    one_group: array<u32, 3>,
    map_groups: array<u32, 3>,
    quad_groups: array<u32, 3>,
}

@group(0) @binding(0) var<uniform> decide: Decide;
@group(0) @binding(1) var<storage, read_write> control: Control;
@group(0) @binding(2) var map: texture_2d_array<f32>;
@group(0) @binding(3) var<storage, read_write> arguments: Arguments;

var<workgroup> worst: atomic<u32>;

fn map_at_texel(texel: vec2u, panel: u32) -> vec3f {
    return textureLoad(map, texel, panel, 0).xyz;
}

// Largest error of cubic interpolation along an axis, halfway between cells: 3/128 of the fourth difference.
fn interpolation_error(texel: vec2u, panel: u32, axis: vec2u) -> f32 {
    let fourth = map_at_texel(texel - 2u * axis, panel) + map_at_texel(texel + 2u * axis, panel) -
        4.0 * (map_at_texel(texel - axis, panel) + map_at_texel(texel + axis, panel)) + 6.0 * map_at_texel(texel, panel);
    return 3.0 / 128.0 * length(fourth);
}

// Whether the map turns a cell inside out.
fn is_folded(texel: vec2u, panel: u32) -> bool {
    let here = map_at_texel(texel, panel);
    let across = map_at_texel(texel + vec2u(1u, 0u), panel) - here;
    let up = map_at_texel(texel + vec2u(0u, 1u), panel) - here;
    return dot(cross(across, up), here) <= 0.0;
}

@compute @workgroup_size(64)
fn measure_distortion(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) local: u32) {
    if (local == 0u) {
        atomicStore(&worst, 0u);
    }
    workgroupBarrier();
    // Every other cell both ways: neighbours are distorted alike.
    let cell = 2u * id.xy;
    if (cell.x < decide.cells) {
        let texel = cell + HALO;
        let error =
            max(interpolation_error(texel, id.z, vec2u(1u, 0u)), interpolation_error(texel, id.z, vec2u(0u, 1u)));
        let distortion = error / (decide.error_limit * decide.cell_angle);
        atomicMax(&worst, bitcast<u32>(select(distortion, 2.0, is_folded(texel, id.z))));
    }
    workgroupBarrier();
    if (local == 0u) {
        atomicMax(&control.distortion, atomicLoad(&worst));
    }
}

@compute @workgroup_size(1)
fn decide_remap() {
    control.ticks_since_remap += decide.ticks;
    let is_distorted = bitcast<f32>(atomicLoad(&control.distortion)) > 1.0;
    let remaps = u32(is_distorted || control.ticks_since_remap + decide.ticks > decide.latest_ticks);
    atomicStore(&control.distortion, 0u);
    control.remaps += remaps;
    control.ticks_remapped = select(control.ticks_remapped, control.ticks_since_remap, remaps == 1u);
    control.ticks_since_remap *= 1u - remaps;
    let groups = decide.tracer_groups;
    arguments.tracer_groups = array(groups.x * remaps, groups.y, groups.z);
    arguments.sum_groups = array(decide.sum_groups * remaps, 1u, 1u);
    arguments.one_group = array(remaps, 1u, 1u);
    arguments.map_groups = array(decide.map_groups.x * remaps, decide.map_groups.y, decide.map_groups.z);
    arguments.quad_groups = array(decide.quad_groups.x * remaps, decide.quad_groups.y, decide.quad_groups.z);
}
