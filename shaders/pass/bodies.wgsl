// What is at a film: the wire of a ring, the foot of a bubble on a bath, where water climbs, the drop that hangs from a bubble, the rim of a hole, and
// the droplets that fly off it. Each is drawn in two halves: what lies beyond the bubble's center is drawn before the bubble, which shows it through its
// film, and the rest after it. No film mirrors them, and they mirror no film.

import package::film::hole::{HOLE_MERIDIANS, Rim, TAU, meridian_axes};
import package::camera::view::{View, clip_position, pixel_angle, view_plane};
import package::light::environment::{Light, environment_radiance};
import package::light::lamps::Lamp;
import package::light::stored::storable;
import package::light::water::{WATER_INDEX, crossing, upward};
import package::optics::airy::surface_reflectance;
import package::sphere::axes::perpendicular;

// Straight pieces that a wire is drawn in.
override WIRE_SIDES: u32;
// 1: what lies beyond the bubble's center. 0: the rest.
override IS_FAR: u32;
// What is drawn. 0: a wire. 1: the foot of a bubble. 2: the rim of a hole. 3: a drop. 4: droplets.
override KIND: u32;

// Mirrors `BodyValue` in src/gpu/passes/bodies.rs.
struct Body {
    // From the eye to the bubble's center.
    to_center_m: vec3f,
    // Radius of the rim, which is level.
    rim_m: f32,
    // From the eye to the middle of the rim.
    to_rim_m: vec3f,
    // Radius of the wire, or of the foot.
    wire_m: f32,
    // Takes directions of the film to the world.
    to_world: mat3x3f,
    // Radius of the bubble.
    radius_m: f32,
}

// A droplet. Mirrors `Droplet` in src/gpu/passes/bodies.rs.
struct Droplet {
    // The meridian of the hole on which it leaves the rim, as a turn, and the angle from the hole's middle there.
    turn: f32,
    leaves_rad: f32,
    radius_m: f32,
    // How fast it flies over how fast the rim moves.
    speed: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var environment: texture_cube<f32>;
@group(0) @binding(3) var environment_sampler: sampler;
@group(0) @binding(4) var<uniform> lamps: array<Lamp, 12>;
// No uniform, for llvmpipe crashes at loops over lamps where others of its branches depend on one.
@group(0) @binding(5) var<storage, read> body: Body;
@group(0) @binding(6) var picture_behind: texture_2d<f32>;
@group(0) @binding(7) var<storage, read> hole_middle: vec4f;
@group(0) @binding(8) var<storage, read> hole_rim: array<Rim>;
@group(0) @binding(9) var<storage, read> droplets: array<Droplet>;

fn surroundings(direction: vec3f, footprint: f32) -> vec3f {
    let far = environment_radiance(environment, environment_sampler, light, upward(direction), footprint);
    return light.seen * (crossing(1.0, direction.z, direction) * far);
}

struct BodyPoint {
    @builtin(position) position: vec4f,
    // From the eye to the thread's axis or to the droplet's middle.
    @location(0) middle_m: vec3f,
    // Along the thread's axis, not of unit length.
    @location(1) along: vec3f,
    // Radius of the thread or of the droplet.
    @location(2) radius_m: f32,
}

// Whether a place, from the eye, belongs to the half that is drawn.
fn is_drawn(place_m: vec3f, ray: vec3f) -> bool {
    return (dot(place_m - body.to_center_m, ray) > 0.0) == (IS_FAR == 1u);
}

// ---- Threads, the wire, the foot and the rim of a hole: ribbons along them that face the eye, on which they are shaded as round as they are.

// Part of light that steel reflects, and the angle that its grain spreads it over.
const STEEL: f32 = 0.5;
const GRAIN_RAD: f32 = 0.3;

// A place on a thread's axis, from the eye, the direction of the axis there, not of unit length, and the thread's radius.
struct Axis {
    point_m: vec3f,
    along: vec3f,
    radius_m: f32,
}

fn wire_axis(turn: f32) -> Axis {
    let outward = vec3f(cos(turn), sin(turn), 0.0);
    return Axis(body.to_rim_m + body.rim_m * outward, vec3f(-outward.y, outward.x, 0.0), body.wire_m);
}

// A place on the rim of the hole on a meridian, from the eye, and in w the rim's radius.
fn rim_place(meridian: u32) -> vec4f {
    let rim = hole_rim[meridian % HOLE_MERIDIANS];
    let turn = TAU * f32(meridian) / f32(HOLE_MERIDIANS);
    let axes = meridian_axes(hole_middle.xyz);
    let middle_rad = 0.5 * (rim.outer_rad + rim.inner_rad);
    let along = cos(turn) * axes[0] + sin(turn) * axes[1];
    let place = body.to_world * (cos(middle_rad) * hole_middle.xyz + sin(middle_rad) * along);
    // Opposite of where the hole began the rim runs together, and what it has gathered is no thread any more.
    let width_rad = min(rim.outer_rad - rim.inner_rad, 0.03) * (1.0 - smoothstep(2.7, 3.1, rim.outer_rad));
    return vec4f(body.to_center_m + body.radius_m * place, 0.5 * body.radius_m * max(width_rad, 1e-6));
}

// Unit vector across a thread and the line of sight.
fn across(along: vec3f, ray: vec3f) -> vec3f {
    let across = cross(along, ray);
    return across / max(length(across), 1e-9);
}

// A vertex of a ribbon at one of its ends.
fn edge_of(axis: Axis, is_right: bool) -> BodyPoint {
    // A pixel more on both sides, for the edges are smooth.
    let half_m = 1.1 * axis.radius_m + view.pixel_height * length(axis.point_m);
    let edge_m = axis.point_m + select(-half_m, half_m, is_right) * across(normalize(axis.along), normalize(axis.point_m));
    return BodyPoint(clip_position(view, edge_m), axis.point_m, axis.along, axis.radius_m);
}

// Strips are of pieces, each with its first and its last vertex twice, so that those of the other half can be left out: corners in order.
fn corner_of(index: u32) -> u32 {
    return clamp(index % 6u, 1u, 4u) - 1u;
}

fn left_out() -> BodyPoint {
    return BodyPoint(vec4f(2.0, 2.0, 0.0, 1.0), vec3f(0.0), vec3f(0.0), 1.0);
}

// A corner of a square that faces the eye.
fn square_around(middle_m: vec3f, half_m: f32, corner: u32) -> BodyPoint {
    let right = perpendicular(middle_m);
    let up = cross(right, normalize(middle_m));
    let side = vec2f(vec2u(corner & 1u, corner >> 1u)) * 2.0 - 1.0;
    let corner_m = middle_m + half_m * (side.x * right + side.y * up);
    return BodyPoint(clip_position(view, corner_m), middle_m, vec3f(0.0), half_m);
}

// What a pixel shows of a body: light from it, and the part of the pixel that it covers.
struct Part {
    seen: vec3f,
    coverage: f32,
}

fn along_wire(index: u32) -> BodyPoint {
    let piece = f32(index / 6u);
    let middle_m = wire_axis(TAU * (piece + 0.5) / f32(WIRE_SIDES)).point_m;
    if (!is_drawn(middle_m, normalize(middle_m))) {
        return left_out();
    }
    let corner = corner_of(index);
    return edge_of(wire_axis(TAU * (piece + f32(corner >> 1u)) / f32(WIRE_SIDES)), (corner & 1u) == 1u);
}

fn along_hole(index: u32) -> BodyPoint {
    let corner = corner_of(index);
    let meridian = index / 6u + HOLE_MERIDIANS;
    let middle_m = 0.5 * (rim_place(meridian).xyz + rim_place(meridian + 1u).xyz);
    if (!is_drawn(middle_m, normalize(middle_m))) {
        return left_out();
    }
    let at = meridian + (corner >> 1u);
    let place = rim_place(at);
    let along = rim_place(at + 1u).xyz - rim_place(at - 1u).xyz;
    return edge_of(Axis(place.xyz, along, place.w), (corner & 1u) == 1u);
}

// Where a pixel sees a thread: the part of it that is covered, the outward normal there, and how many radii it is wide.
struct OnThread {
    ray: vec3f,
    coverage: f32,
    normal: vec3f,
    pixel: f32,
}

fn on_thread(point: BodyPoint) -> OnThread {
    let ray = normalize(view_plane(view, point.position.xy));
    let aside = across(normalize(point.along), ray);
    let offset = -dot(point.middle_m, aside) / point.radius_m;
    let pixel = pixel_angle(view, ray) * length(point.middle_m) / point.radius_m;
    let coverage = clamp((1.0 - abs(offset)) / pixel + 0.5, 0.0, min(1.0, 2.0 / pixel));
    let facing = cross(aside, normalize(point.along));
    let toward_eye = select(facing, -facing, dot(facing, ray) > 0.0);
    let inside = clamp(offset, -0.98, 0.98);
    return OnThread(ray, coverage, inside * aside + sqrt(1.0 - inside * inside) * toward_eye, pixel);
}

fn thread(point: BodyPoint) -> Part {
    let at = on_thread(point);
    if (KIND == 0u) {
        return Part(at.coverage * STEEL * surroundings(reflect(at.ray, at.normal), GRAIN_RAD), at.coverage);
    }
    return Part(at.coverage * round_water(at.ray, at.normal, at.pixel), at.coverage);
}

// Light through a ball or a thread of water, from where a ray enters it. `pixel` is the width of a pixel over the radius.
fn round_water(ray: vec3f, normal: vec3f, pixel: f32) -> vec3f {
    let inside = refract(ray, normal, 1.0 / WATER_INDEX);
    // Where it leaves: straight on across the round section.
    let exit = normal - 2.0 * dot(normal, inside) * inside;
    let leaving = refract(inside, -normalize(exit), WATER_INDEX);
    return with_mirrored(ray, normal, leaving, min(2.0 * pixel, 1.0));
}

// Light that leaves water in a direction, and what its surface mirrors where the ray enters.
fn with_mirrored(ray: vec3f, normal: vec3f, leaving: vec3f, footprint: f32) -> vec3f {
    let mirrored = 0.5 * dot(surface_reflectance(WATER_INDEX, -dot(ray, normal)), vec2f(1.0));
    return mix(surroundings(leaving, footprint), surroundings(reflect(ray, normal), footprint), mirrored);
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

fn drop_middle_m() -> vec3f {
    return body.to_rim_m - vec3f(0.0, 0.0, DROP_RIM * body.rim_m);
}

fn around_drop(index: u32) -> BodyPoint {
    return square_around(drop_middle_m(), 1.2 * DROP_HEIGHT * body.rim_m, index);
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
    return with_mirrored(ray, normal, leaving, footprint);
}

fn drop(position: vec2f) -> Part {
    let middle_m = drop_middle_m();
    var seen = vec3f(0.0);
    var covered = 0.0;
    for (var k = 0u; k < SAMPLES * SAMPLES; k++) {
        let offset = (vec2f(vec2u(k % SAMPLES, k / SAMPLES)) + 0.5) / f32(SAMPLES);
        let ray = normalize(view_plane(view, floor(position) + offset));
        let met = chord(-middle_m / body.rim_m, ray);
        let place = -middle_m / body.rim_m + met.enter * ray;
        if (met.enter < met.leave && met.enter > 0.0 && is_drawn(body.rim_m * place + middle_m, ray)) {
            // A curved surface turns what it mirrors by twice its own turn.
            let footprint = 2.0 * pixel_angle(view, ray) * (1.0 + met.enter) / f32(SAMPLES);
            seen += drop_light(ray, place, met.enter_normal, footprint);
            covered += 1.0;
        }
    }
    let samples = f32(SAMPLES * SAMPLES);
    return Part(seen / samples, covered / samples);
}

// ---- Spray: droplets leave the rim of a hole along the sphere and fly on straight, at a part of the rim's mean speed.

fn around_droplet(index: u32) -> BodyPoint {
    let droplet = droplets[index / 6u];
    let meridian = droplet.turn * f32(HOLE_MERIDIANS);
    let low = hole_rim[u32(meridian) % HOLE_MERIDIANS].outer_rad;
    let high = hole_rim[(u32(meridian) + 1u) % HOLE_MERIDIANS].outer_rad;
    let rim_rad = mix(low, high, fract(meridian));
    let axes = meridian_axes(hole_middle.xyz);
    let along = cos(TAU * droplet.turn) * axes[0] + sin(TAU * droplet.turn) * axes[1];
    let leaves = vec2f(cos(droplet.leaves_rad), sin(droplet.leaves_rad));
    let start = leaves.x * hole_middle.xyz + leaves.y * along;
    let ahead = leaves.x * along - leaves.y * hole_middle.xyz;
    let flown = droplet.speed * (rim_rad - droplet.leaves_rad);
    let middle_m = body.to_center_m + body.radius_m * (body.to_world * (start + flown * ahead));
    if (flown <= 0.0 || !is_drawn(middle_m, normalize(middle_m))) {
        return left_out();
    }
    let half_m = 1.1 * droplet.radius_m + view.pixel_height * length(middle_m);
    var point = square_around(middle_m, half_m, corner_of(index));
    point.radius_m = droplet.radius_m;
    return point;
}

fn droplet(point: BodyPoint) -> Part {
    let ray = normalize(view_plane(view, point.position.xy));
    let aside = (dot(point.middle_m, ray) * ray - point.middle_m) / point.radius_m;
    let pixel = pixel_angle(view, ray) * length(point.middle_m) / point.radius_m;
    // Those of less than a pixel cover a part of it.
    let inside = clamp((1.0 - length(aside)) / pixel + 0.5, 0.0, 1.0);
    let coverage = inside * min(1.0, 3.14159265 / (pixel * pixel));
    let offset = aside * min(1.0, 0.95 / max(length(aside), 1e-6));
    let normal = offset - sqrt(max(1.0 - dot(offset, offset), 0.0)) * ray;
    return Part(coverage * round_water(ray, normal, pixel), coverage);
}

@vertex
fn corner(@builtin(vertex_index) index: u32) -> BodyPoint {
    if (KIND < 2u) {
        return along_wire(index);
    }
    if (KIND == 2u) {
        return along_hole(index);
    }
    if (KIND == 3u) {
        return around_drop(index);
    }
    return around_droplet(index);
}

@fragment
fn shade(point: BodyPoint) -> @location(0) vec4f {
    var part: Part;
    if (KIND < 3u) {
        part = thread(point);
    } else if (KIND == 3u) {
        part = drop(point.position.xy);
    } else {
        part = droplet(point);
    }
    let behind = textureLoad(picture_behind, vec2u(point.position.xy), 0).rgb;
    return vec4f(storable(part.seen + (1.0 - part.coverage) * behind), 1.0);
}
