// Traces one step back: from each cell to where its liquid was when the step began, and what it gathered on the way.
// One invocation per cell, halo included: a cell beyond an edge is a place like any other. Velocities are tangential by
// construction and positions are renormalised, so there is no pole and no panel. A long step is traced in several Runge-Kutta steps: that costs a
// fraction of what composing a map with each of them would, and errs less.

import package::film::prescribed::{MAX_VORTICES, MAX_WAVES, Vortex, Wave, vortex_gradient, wave_gradient};
import package::film::wind::{FLOW, FLOW_PRESCRIBED, WindMoment, wind_divergence, wind_velocity};
import package::sphere::cubed::{is_cell, panel_direction};

// One step. Mirrors `StepUniform` in src/gpu/passes/trace_step.rs.
struct Step {
    // Columns take the test wind's frame to the world.
    frame: mat3x3f,
    // The wind at the start, middle and end of each backward trace, the end of one being the start of the next.
    moments: array<WindMoment, 33>,
    // Angular speed of the wind's solid turn about its frame's z axis.
    turn_rad_s: f32,
    dt_s: f32,
    cells: u32,
    waves_count: u32,
    vortices_count: u32,
    traces: u32,
    // Waves and vortices of the first three moments, each in its own third.
    waves: array<Wave, 96>,
    vortices: array<Vortex, 192>,
}

@group(0) @binding(0) var<uniform> step: Step;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var step_map: texture_storage_2d_array<rgba32float, write>;

// u = x cross grad(psi): free of divergence whatever psi is.
fn prescribed_velocity(x: vec3f, moment: u32) -> vec3f {
    var gradient = vec3f(0.0);
    for (var k = 0u; k < min(step.waves_count, MAX_WAVES); k++) {
        gradient += wave_gradient(step.waves[moment * MAX_WAVES + k], x);
    }
    for (var k = 0u; k < min(step.vortices_count, MAX_VORTICES); k++) {
        gradient += vortex_gradient(step.vortices[moment * MAX_VORTICES + k], x);
    }
    return cross(x, gradient);
}

// Velocity in xyz, divergence in w; of test winds in their own frame.
fn motion(x: vec3f, moment: u32) -> vec4f {
    if (FLOW == FLOW_PRESCRIBED) {
        return vec4f(prescribed_velocity(x, moment), 0.0);
    }
    let wind = step.moments[moment];
    return vec4f(wind_velocity(x, wind, step.turn_rad_s), wind_divergence(x, wind));
}

// The frame that a trace is in, and back to the world.
fn in_frame(x: vec3f) -> vec3f {
    if (FLOW == FLOW_PRESCRIBED) {
        return x;
    }
    return x * step.frame;
}

fn in_world(x: vec3f) -> vec3f {
    if (FLOW == FLOW_PRESCRIBED) {
        return x;
    }
    return step.frame * x;
}

// Way and divergence of a backward trace that starts at x and a moment: the classic Runge-Kutta of fourth order.
fn change(x: vec3f, moment: u32, dt: f32) -> vec4f {
    let k1 = motion(x, moment);
    let k2 = motion(normalize(x - 0.5 * dt * k1.xyz), moment + 1u);
    let k3 = motion(normalize(x - 0.5 * dt * k2.xyz), moment + 1u);
    let k4 = motion(normalize(x - dt * k3.xyz), moment + 2u);
    return dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

@compute @workgroup_size(8, 8)
fn trace_step(@builtin(global_invocation_id) id: vec3u) {
    if (!is_cell(id, step.cells)) {
        return;
    }
    let x = normalize(panel_direction(id.z, vec2f(tangents[id.x], tangents[id.y])));
    let dt = step.dt_s / f32(step.traces);
    // Gathered is the logarithm of the area ratio: how much larger a patch was then than it is now.
    var origin = vec4f(in_frame(x), 0.0);
    for (var trace = 0u; trace < step.traces; trace++) {
        let earlier = origin - change(origin.xyz, 2u * trace, dt);
        origin = vec4f(normalize(earlier.xyz), earlier.w);
    }
    textureStore(step_map, id.xy, id.z, vec4f(in_world(origin.xyz), origin.w));
}
