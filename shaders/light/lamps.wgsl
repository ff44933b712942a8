// Small bright sources before the environment, which no texel blurs. The f64 truth is src/physics/environment/lamp.rs.
//
// The pass declares `lamps`.

// How many there are.
override LAMPS: u32;

// Half width of a soft edge that is as blurred as pixels of width 1: the root of 5/12.
const EDGE_PER_FOOTPRINT: f32 = 0.645497;

// A flat lamp that faces the scene: a rectangle with round corners, in lengths as of a lamp one away.
// Mirrors `LampUniform` in src/gpu/passes/backdrop.rs.
struct Lamp {
    towards: vec3f,
    // Half the width of its soft edge.
    edge: f32,
    right: vec3f,
    corner: f32,
    up: vec3f,
    area: f32,
    radiance: vec3f,
    half_size: vec2f,
}

// Area of such a rectangle with its soft edge.
fn box_area(half_size: vec2f, corner: f32, edge: f32) -> f32 {
    return 4.0 * half_size.x * half_size.y - 0.858407346 * corner * corner + 0.628318531 * edge * edge;
}

// Radiance of a lamp from a direction, spread over cones of a half angle (its tangent) and filtered over a footprint.
fn lamp_radiance(lamp: Lamp, direction: vec3f, defocus: f32, footprint: f32) -> vec3f {
    let facing = dot(direction, lamp.towards);
    let place = vec2f(dot(direction, lamp.right), dot(direction, lamp.up)) / max(facing, 1e-6);
    let from_lens = min(defocus, min(lamp.half_size.x, lamp.half_size.y));
    let edge = max(length(vec3f(lamp.edge, from_lens, EDGE_PER_FOOTPRINT * footprint)), 1e-6);
    let corner = max(max(lamp.corner, defocus), edge);
    let half_size = max(lamp.half_size, vec2f(corner));
    let outside = abs(place) - half_size + corner;
    let distance = length(max(outside, vec2f(0.0))) + min(max(outside.x, outside.y), 0.0) - corner;
    let cover = select(0.0, 1.0 - smoothstep(-edge, edge, distance), facing > 0.0);
    return cover * lamp.area / box_area(half_size, corner, edge) * lamp.radiance;
}

// Radiance of all lamps.
fn lamps_radiance(direction: vec3f, defocus: f32, footprint: f32) -> vec3f {
    var sum = vec3f(0.0);
    if (LAMPS > 0u) {
        for (var k = 0u; k < LAMPS; k++) {
            sum += lamp_radiance(lamps[k], direction, defocus, footprint);
        }
    }
    return sum;
}
