// Advances the backward flow map by one step: map(x) = where the liquid now at x was when the tracer was last remapped.
// One invocation a cell. Velocities are tangential by construction and positions are renormalised: no pole, no panel.

import package::film::wind::{FLOW, FLOW_PRESCRIBED, WindMoment, wind_velocity};
import package::sphere::cubed::{HALO, cubic_stencil, locate, padded_index, panel_direction};

const MAX_WAVES: u32 = 32u;
const MAX_VORTICES: u32 = 64u;

// Stream function gain.x sin(k . x + phase), with k in xyz and the phase in w.
struct Wave {
    k_phase: vec4f,
    gain: vec4f,
}

// Stream function gain.x exp(sharpness (centre . x - 1)), with the centre in xyz and the sharpness in w.
struct Vortex {
    centre_sharpness: vec4f,
    gain: vec4f,
}

// One step. Mirrors `StepUniform` in src/gpu/film.rs.
struct Step {
    // Columns take the test wind's frame to the world.
    frame: mat3x3f,
    // The wind at the start, middle and end of the backward step.
    moments: array<WindMoment, 3>,
    // Angular speed of the wind's solid turn about its frame's z axis.
    turn_rad_s: f32,
    dt_s: f32,
    cells: u32,
    // 1 right after a remap, when the map is the identity and there is nothing to look up.
    map_is_identity: u32,
    waves_count: u32,
    vortices_count: u32,
    waves: array<Wave, 32>,
    vortices: array<Vortex, 64>,
}

@group(0) @binding(0) var<uniform> step: Step;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read> map_before: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> map_after: array<vec4f>;

// u = x cross grad(psi): free of divergence whatever psi is.
fn prescribed_velocity(x: vec3f) -> vec3f {
    var gradient = vec3f(0.0);
    for (var w = 0u; w < min(step.waves_count, MAX_WAVES); w++) {
        let k_phase = step.waves[w].k_phase;
        gradient += step.waves[w].gain.x * cos(dot(k_phase.xyz, x) + k_phase.w) * k_phase.xyz;
    }
    for (var v = 0u; v < min(step.vortices_count, MAX_VORTICES); v++) {
        let centre_sharpness = step.vortices[v].centre_sharpness;
        let bell = exp(centre_sharpness.w * (dot(centre_sharpness.xyz, x) - 1.0));
        gradient += step.vortices[v].gain.x * centre_sharpness.w * bell * centre_sharpness.xyz;
    }
    return cross(x, gradient);
}

fn test_wind(x: vec3f, stage: u32) -> vec3f {
    return step.frame * wind_velocity(x * step.frame, step.moments[stage], step.turn_rad_s);
}

// A prescribed flow is frozen at the middle of the step, where the midpoint rule is of second order.
fn backtrace_midpoint(x: vec3f) -> vec3f {
    let middle = normalize(x - 0.5 * step.dt_s * prescribed_velocity(x));
    return normalize(x - step.dt_s * prescribed_velocity(middle));
}

// The classic Runge-Kutta of fourth order.
fn backtrace_runge_kutta(x: vec3f) -> vec3f {
    let dt = step.dt_s;
    let k1 = test_wind(x, 0u);
    let k2 = test_wind(normalize(x - 0.5 * dt * k1), 1u);
    let k3 = test_wind(normalize(x - 0.5 * dt * k2), 1u);
    let k4 = test_wind(normalize(x - dt * k3), 2u);
    return normalize(x - dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
}

fn map_at(x: vec3f) -> vec3f {
    let stencil = cubic_stencil(locate(x, step.cells), step.cells);
    var total = vec3f(0.0);
    for (var j = 0u; j < 4u; j++) {
        let row = stencil.first + j * stencil.stride;
        total += stencil.wj[j] * (stencil.wi.x * map_before[row].xyz + stencil.wi.y * map_before[row + 1u].xyz +
            stencil.wi.z * map_before[row + 2u].xyz + stencil.wi.w * map_before[row + 3u].xyz);
    }
    return normalize(total);
}

@compute @workgroup_size(64)
fn advance_map(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= step.cells) {
        return;
    }
    let tangent = vec2f(tangents[id.x + HALO], tangents[id.y + HALO]);
    let x = normalize(panel_direction(id.z, tangent));
    var origin: vec3f;
    if (FLOW == FLOW_PRESCRIBED) {
        origin = backtrace_midpoint(x);
    } else {
        origin = backtrace_runge_kutta(x);
    }
    if (step.map_is_identity == 0u) {
        origin = map_at(origin);
    }
    map_after[padded_index(id.z, i32(id.x), i32(id.y), step.cells)] = vec4f(origin, 0.0);
}
