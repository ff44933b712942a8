// What leaves a film at its rim, done at remaps: it drains between surfaces that do not move, and thin patches take the place of thicker
// film at the rim. What that leaves out of the film is counted. The tracer holds the thickness and what has evaporated of it, as their
// departure from the film's level. The f64 truths are `Drainage` in src/physics/film/properties.rs and src/physics/film/regeneration.rs.
// One invocation per cell, halo included.

import package::film::control::Control;
import package::sphere::cap::{Cap, image};
import package::sphere::cubed::{cell_place, is_cell, panel_direction};
import package::sphere::lookup::{gather_place, sanitised, tracer_at};

const MAX_PATCHES: u32 = 64u;

struct Patch {
    middle: vec3f,
    // Thickness over the thickness of the film around.
    thickness: f32,
    // Ticks since it left.
    age: u32,
}

// Mirrors `DrainUniform` in src/gpu/passes/drain.rs.
struct Drain {
    // Gravity over the radius, 1/s2.
    gravity: vec3f,
    // Times it and the cube of a thickness in nm, the flux of drainage in a tick, nm rad.
    flux: f32,
    // Cells along a panel's edge.
    cells: u32,
    // What the tracer departs from less what has evaporated, and black film, which does not drain, nm.
    remaining_level_nm: f32,
    black_nm: f32,
    // Angle from the lowest point within which what drains is in the drop, as its cosine.
    drop_cos: f32,
    // Where the film ends: see `Cap`.
    rim_z: f32,
    inversion: f32,
    // Radius of a patch, radians.
    patch_radius: f32,
    patches_count: u32,
    patches: array<Patch, 64>,
}

@group(0) @binding(0) var<uniform> drain: Drain;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> control: Control;
@group(0) @binding(3) var tracer: texture_2d_array<f32>;
@group(0) @binding(4) var<storage, read_write> drained: array<f32>;
@group(0) @binding(5) var point_sampler: sampler;

// There is no map here.
fn map_texel(unused: u32, texel: vec2u, panel: u32) -> vec4f {
    return vec4f(0.0);
}

fn tracer_texels(texel: vec2u, panel: u32) -> vec4f {
    return textureGather(0, tracer, point_sampler, gather_place(texel, drain.cells), panel);
}

fn thickness_nm(x: vec3f) -> f32 {
    return tracer_at(x, drain.cells) + drain.remaining_level_nm;
}

// What a place gains by drainage, which has a departure now. Along characteristics, which the flux c h^3 g_t moves at 3 c h^2 g_t, the
// thickness gains 2 c h^3 g.n.
fn gained_nm(x: vec3f, departure: f32) -> f32 {
    let nm = departure + drain.remaining_level_nm;
    if (drain.flux == 0.0 || nm <= drain.black_nm || dot(drain.gravity, x) > drain.drop_cos * length(drain.gravity)) {
        return 0.0;
    }
    let rate = drain.flux * f32(control.ticks_remapped);
    let along = drain.gravity - dot(drain.gravity, x) * x;
    // The middle of the way, for the second order.
    let half_way = normalize(x - 1.5 * rate * nm * nm * along);
    let middle = max(thickness_nm(half_way), drain.black_nm);
    let origin = normalize(x - 3.0 * rate * middle * middle * along);
    let carried = tracer_at(origin, drain.cells) - departure;
    return max(carried + 2.0 * rate * middle * middle * middle * dot(drain.gravity, half_way), drain.black_nm - nm);
}

// What patches that left since the last remap leave of the thickness.
fn left_by_patches(x: vec3f) -> f32 {
    var left = 1.0;
    for (var k = 0u; k < min(drain.patches_count, MAX_PATCHES); k++) {
        let thin = drain.patches[k];
        let away = distance(x, thin.middle) / drain.patch_radius;
        let inside = 1.0 - smoothstep(0.7, 1.3, away);
        left *= select(1.0, 1.0 - inside * (1.0 - thin.thickness), thin.age < control.ticks_remapped);
    }
    return left;
}

@compute @workgroup_size(8, 8)
fn drain_film(@builtin(global_invocation_id) id: vec3u) {
    if (!is_cell(id, drain.cells)) {
        return;
    }
    let place = cell_place(id, drain.cells);
    var x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
    var departure = textureLoad(tracer, id.xy, id.z, 0).r;
    if (x.z < drain.rim_z) {
        x = image(Cap(drain.rim_z, drain.inversion), x);
        departure = tracer_at(x, drain.cells);
    }
    let gained = gained_nm(x, departure);
    let nm = departure + drain.remaining_level_nm + gained;
    // No patch is thinner than black film.
    let lost = min(nm * (1.0 - left_by_patches(x)), max(nm - drain.black_nm, 0.0));
    if (sanitised > 0u) {
        atomicAdd(&control.sanitised, sanitised);
    }
    drained[place] = departure + (gained - lost);
}
