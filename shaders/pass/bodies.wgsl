// What a film ends at: the wire of a ring, and the drop that hangs from a bubble. Each is drawn in two halves: what lies beyond the bubble's center
// before the bubble is, which then shows it through its film, and the rest after it. Neither is mirrored by the film, nor mirrors it.

import package::camera::view::{View, clip_position, pixel_angle, view_plane};
import package::light::environment::{Light, environment_radiance};
import package::light::lamps::Lamp;
import package::light::stored::storable;
import package::light::water::WATER_INDEX;
import package::optics::airy::surface_reflectance;
import package::sphere::axes::perpendicular;

const TAU: f32 = 6.2831853;
// Straight pieces that the wire is drawn in.
override WIRE_SIDES: u32;
// 1: what lies beyond the bubble's center. 0: the rest.
override IS_FAR: u32;

// Mirrors `BodyUniform` in src/gpu/passes/bodies.rs.
struct Body {
    // From the eye to the bubble's center.
    to_center_m: vec3f,
    // Radius of the rim, which is level.
    rim_m: f32,
    // From the eye to the middle of the rim.
    to_rim_m: vec3f,
    // Radius of the wire.
    wire_m: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var environment: texture_cube<f32>;
@group(0) @binding(3) var environment_sampler: sampler;
@group(0) @binding(4) var<uniform> lamps: array<Lamp, 12>;
// No uniform, for llvmpipe crashes at loops over lamps where others of its branches depend on one.
@group(0) @binding(5) var<storage, read> body: Body;
@group(0) @binding(6) var picture_behind: texture_2d<f32>;

fn surroundings(direction: vec3f, footprint: f32) -> vec3f {
    return light.seen * environment_radiance(environment, environment_sampler, light, direction, footprint);
}

// Whether a place, from the eye, belongs to the half that is drawn.
fn is_drawn(place_m: vec3f, ray: vec3f) -> bool {
    return (dot(place_m - body.to_center_m, ray) > 0.0) == (IS_FAR == 1u);
}

// ---- The wire: a ribbon along it that faces the eye, on which it is shaded as the round wire that it is.

// Part of light that steel reflects, and the angle that its grain spreads it over.
const STEEL: f32 = 0.5;
const GRAIN_RAD: f32 = 0.3;

struct WirePoint {
    @builtin(position) position: vec4f,
    @location(0) turn: f32,
}

// The wire's axis: the point at a turn, from the eye, and the direction there.
struct Axis {
    point_m: vec3f,
    along: vec3f,
}

fn axis_at(turn: f32) -> Axis {
    let outward = vec3f(cos(turn), sin(turn), 0.0);
    return Axis(body.to_rim_m + body.rim_m * outward, vec3f(-outward.y, outward.x, 0.0));
}

// Unit vector across the wire and the line of sight.
fn across(axis: Axis, ray: vec3f) -> vec3f {
    let across = cross(axis.along, ray);
    return across / max(length(across), 1e-6);
}

// A strip of pieces, each with its first and its last vertex twice, so that those of the other half can be left out.
@vertex
fn ribbon(@builtin(vertex_index) index: u32) -> WirePoint {
    let piece = f32(index / 6u);
    let corner = clamp(index % 6u, 1u, 4u) - 1u;
    let middle_m = axis_at(TAU * (piece + 0.5) / f32(WIRE_SIDES)).point_m;
    if (!is_drawn(middle_m, normalize(middle_m))) {
        return WirePoint(vec4f(2.0, 2.0, 0.0, 1.0), 0.0);
    }
    let turn = TAU * (piece + f32(corner >> 1u)) / f32(WIRE_SIDES);
    let axis = axis_at(turn);
    let ray = normalize(axis.point_m);
    // A pixel more on both sides, for the edges are smooth.
    let half_m = 1.1 * body.wire_m + view.pixel_height * length(axis.point_m);
    let edge_m = axis.point_m + select(-half_m, half_m, (corner & 1u) == 1u) * across(axis, ray);
    return WirePoint(clip_position(view, edge_m), turn);
}

@fragment
fn wire(point: WirePoint) -> @location(0) vec4f {
    let ray = normalize(view_plane(view, point.position.xy));
    let axis = axis_at(point.turn);
    let aside = across(axis, ray);
    let offset = -dot(axis.point_m, aside) / body.wire_m;
    let pixel = pixel_angle(view, ray) * length(axis.point_m) / body.wire_m;
    let coverage = clamp((1.0 - abs(offset)) / pixel + 0.5, 0.0, min(1.0, 2.0 / pixel));
    let facing = cross(aside, axis.along);
    let toward_eye = select(facing, -facing, dot(facing, ray) > 0.0);
    let normal = offset * aside + sqrt(max(1.0 - offset * offset, 0.0)) * toward_eye;
    let seen = STEEL * surroundings(reflect(ray, normalize(normal)), GRAIN_RAD);
    let behind = textureLoad(picture_behind, vec2u(point.position.xy), 0).rgb;
    return vec4f(storable(mix(behind, seen, coverage)), 1.0);
}

// ---- The drop: the part below the rim of a spheroid around the vertical, of water, with a level surface above.

// Its half axes and the height of the rim over its middle, over the rim's radius: the rim is on it, and it is widest below.
const DROP_WIDTH: f32 = 1.1547;
const DROP_HEIGHT: f32 = 1.2;
const DROP_RIM: f32 = 0.6;
// Samples along each side of a pixel.
const SAMPLES: u32 = 3u;
// How often light is reflected inside before it leaves, at most.
const MAX_REFLECTIONS: u32 = 3u;

// A square around it.
@vertex
fn around_drop(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let middle_m = body.to_rim_m - vec3f(0.0, 0.0, DROP_RIM * body.rim_m);
    let right = perpendicular(middle_m);
    let up = cross(right, normalize(middle_m));
    let reach_m = 1.2 * DROP_HEIGHT * body.rim_m;
    let side = vec2f(vec2u(index & 1u, index >> 1u)) * 2.0 - 1.0;
    return clip_position(view, middle_m + reach_m * (side.x * right + side.y * up));
}

// Where a line is in the drop, by the distance along it, and the outward normals there. It misses where `enter` is not before `leave`.
struct Chord {
    enter: f32,
    leave: f32,
    enter_normal: vec3f,
    leave_normal: vec3f,
}

// Of a line from a place over the rim's radius, relative to the drop's middle.
fn chord(place: vec3f, direction: vec3f) -> Chord {
    let shrink = 1.0 / vec3f(DROP_WIDTH, DROP_WIDTH, DROP_HEIGHT);
    let start = shrink * place;
    let along = shrink * direction;
    let square = dot(along, along);
    let middle = -dot(start, along) / square;
    let aside = start + middle * along;
    let left = 1.0 - dot(aside, aside);
    if (left <= 0.0) {
        return Chord(1.0, 0.0, vec3f(0.0), vec3f(0.0));
    }
    let half = sqrt(left / square);
    var found = Chord(
        middle - half,
        middle + half,
        normalize(shrink * (aside - half * along)),
        normalize(shrink * (aside + half * along)),
    );
    let level = (DROP_RIM - place.z) / direction.z;
    if (direction.z < 0.0 && level > found.enter) {
        found.enter = level;
        found.enter_normal = vec3f(0.0, 0.0, 1.0);
    } else if (direction.z > 0.0 && level < found.leave) {
        found.leave = level;
        found.leave_normal = vec3f(0.0, 0.0, 1.0);
    }
    return found;
}

// Light that leaves the drop along a ray that enters it at a place, with what its surface mirrors there.
fn drop_light(ray: vec3f, entry: vec3f, normal: vec3f, footprint: f32) -> vec3f {
    var place = entry;
    var inside = refract(ray, normal, 1.0 / WATER_INDEX);
    var leaving = vec3f(0.0);
    for (var k = 0u; k < MAX_REFLECTIONS; k++) {
        let way = chord(place, inside);
        let left = any(leaving != vec3f(0.0));
        leaving = select(refract(inside, -way.leave_normal, WATER_INDEX), leaving, left);
        place += way.leave * inside;
        inside = reflect(inside, way.leave_normal);
    }
    leaving = select(inside, leaving, any(leaving != vec3f(0.0)));
    let mirrored = 0.5 * dot(surface_reflectance(WATER_INDEX, -dot(ray, normal)), vec2f(1.0));
    return mix(surroundings(leaving, footprint), surroundings(reflect(ray, normal), footprint), mirrored);
}

@fragment
fn drop(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let middle_m = body.to_rim_m - vec3f(0.0, 0.0, DROP_RIM * body.rim_m);
    var seen = vec3f(0.0);
    var covered = 0.0;
    for (var k = 0u; k < SAMPLES * SAMPLES; k++) {
        let offset = (vec2f(vec2u(k % SAMPLES, k / SAMPLES)) + 0.5) / f32(SAMPLES);
        let ray = normalize(view_plane(view, floor(position.xy) + offset));
        let met = chord(-middle_m / body.rim_m, ray);
        let place = -middle_m / body.rim_m + met.enter * ray;
        if (met.enter < met.leave && met.enter > 0.0 && is_drawn(body.rim_m * place + middle_m, ray)) {
            // A curved surface turns what it mirrors by twice its own turn.
            let footprint = 2.0 * pixel_angle(view, ray) * (1.0 + met.enter) / f32(SAMPLES);
            seen += drop_light(ray, place, met.enter_normal, footprint);
            covered += 1.0;
        }
    }
    let behind = textureLoad(picture_behind, vec2u(position.xy), 0).rgb;
    let samples = f32(SAMPLES * SAMPLES);
    return vec4f(storable((seen + (samples - covered) * behind) / samples), 1.0);
}
