// One ring of a bubble's disc: an exact sphere traced at each pixel. Front reflection, transmission, back wall, inner reflections, each
// wall with the thickness at its own hit.

import package::camera::view::{View, clip_position, pixel_angle, view_plane, view_ray};
import package::film::control::Balance;
import package::film::hole::{Rim, TAU};
import package::light::environment::{Light, backdrop_radiance, environment_radiance};
import package::light::lamps::Lamp;
import package::light::others::{AMONG_OTHERS, passed_others};
import package::light::polarisation::{mean_polarisation, path_polarisation, picture_axis, polarisation_behind};
import package::light::polarisation::{sample_behind, sample_polarisation};
import package::light::stokes::{packed, turn_between, turned, unpolarised};
import package::light::stored::storable;
import package::light::water::{crossing, past_meniscus, upward};
import package::optics::airy::surface_reflectance;
import package::optics::quadrature::QuadratureSample;
import package::optics::film_colour::film_reflection;
import package::optics::table::{FilmPoint, TableAxes};
import package::optics::walls::{EVERYTHING, FURTHER, Hits, INNER, TRACKS_POLARISATION, WAVELENGTHS, Walls};
import package::optics::walls::{product_of_colours, resolved, wavelength_radiance};
import package::sphere::axes::perpendicular;
import package::sphere::hits::{first_hits, four_hits};
import package::sphere::hops::{Followed, Hop, followed, left_before, mirrored};
import package::sphere::others::OtherBubble;
import package::sphere::path::{Path, PixelPart, WHOLE_PIXEL, footprint, polarisation_along, spanned_angles};
import package::sphere::samples::{OUT_OF_FOCUS, pixel_radiance};
import package::sphere::trace::{eye_is_inside, from_round, outline, path_along, to_round};

// 1: there may be bubbles behind the bubble, and `picture_behind` shows them. 0: nothing is behind it but the backdrop.
override OVER_OTHERS: u32;

// Mirrors `BubbleUniform` in src/gpu/passes/bubble.rs.
struct Bubble {
    // From the eye to the center.
    to_center_m: vec3f,
    radius_m: f32,
    // Inner and outer edge of the ring: cos and sin of the angle to the direction of the center.
    inner: vec2f,
    outer: vec2f,
    // Thickness of a uniform film, in nm.
    thickness_nm: f32,
    // Cells along a panel's edge, of the film and of its tracer.
    cells: u32,
    tracer_cells: u32,
    // What has evaporated from the whole film, in nm.
    evaporated_nm: f32,
    // Takes directions of the world to the film, which may turn as a whole.
    to_film: mat3x3f,
    // Takes the unit sphere to the bubble's wall, over the radius, and the inverse.
    stretch: mat3x3f,
    unstretch: mat3x3f,
    // The thickness at which evaporation ends, in nm.
    black_nm: f32,
    // What the film's skins add to the thickness of a plain film that looks like it, and the thickness of both, in nm.
    extra_nm: f32,
    skins_nm: f32,
    // Cells along a panel's edge of the film's map.
    map_cells: u32,
    // Height of the ring that the film ends at, over the radius.
    rim_z: f32,
    // How much thicker the bubble is than the film shows.
    thickness_factor: f32,
    // Sides of the polygons around the ring's edges.
    sides: u32,
    // Radius of the circle of confusion, in pixels.
    confusion_pixels: f32,
}

// The bubble's part of `lists`: the first, how many whose walls lie between its own, and with those that it mirrors only. They are no uniforms:
// lavapipe compiles a shader anew for each value of a uniform that a loop depends on. All else is: where llvmpipe takes derivatives, it reads zeros
// from storage for pixels beside a triangle.
// Mirrors `ListPart` in src/gpu/passes/bubble.rs.
struct ListPart {
    first_other: u32,
    among: u32,
    mirrored: u32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var environment: texture_cube<f32>;
@group(0) @binding(3) var environment_sampler: sampler;
@group(0) @binding(4) var<uniform> bubble: Bubble;
@group(0) @binding(5) var<uniform> axes: TableAxes;
@group(0) @binding(6) var table: texture_2d_array<u32>;
@group(0) @binding(7) var<uniform> lamps: array<Lamp, 12>;
@group(0) @binding(8) var film: texture_2d_array<f32>;
@group(0) @binding(9) var<uniform> quadrature: array<QuadratureSample, 256>;
@group(0) @binding(10) var<uniform> film_balance: Balance;
@group(0) @binding(11) var film_map: texture_2d_array<f32>;
@group(0) @binding(12) var film_tracer: texture_2d_array<f32>;
@group(0) @binding(13) var<storage, read> hole_middle: vec4f;
@group(0) @binding(14) var<storage, read> hole_rim: array<Rim>;
@group(0) @binding(15) var picture_behind: texture_2d<f32>;
@group(0) @binding(16) var picture_so_far: texture_2d<f32>;
@group(0) @binding(17) var<storage, read> others: array<OtherBubble>;
@group(0) @binding(18) var<storage, read> lists: array<u32>;
@group(0) @binding(19) var films: texture_2d_array<f32>;
@group(0) @binding(20) var<storage, read> part: ListPart;
// The environment as it is seen behind the bubbles.
@group(0) @binding(21) var backdrop_map: texture_cube<f32>;
@group(0) @binding(22) var backdrop_sampler: sampler;
// What is polarised of `picture_behind`: see light/polarisation.wgsl.
@group(0) @binding(23) var polarised_behind: texture_2d<u32>;
@group(0) @binding(24) var point_sampler: sampler;

// A corner of the polygon around an edge of the ring.
fn corner(number: u32, edge: vec2f) -> vec4f {
    let to_center = normalize(to_round(bubble.to_center_m));
    let right = perpendicular(to_center);
    let up = cross(right, to_center);
    let turn = TAU * f32(number % bubble.sides) / f32(bubble.sides);
    let ray = edge.x * to_center + edge.y * (cos(turn) * right + sin(turn) * up);
    return clip_position(view, from_round(ray));
}

// A strip between two polygons around the direction to the center, or the whole of the outer one, in a strip to and fro across it. Rings that share
// an edge compute its vertices alike, so that every pixel belongs to one of them.
@vertex
fn ring(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let half = index >> 1u;
    let is_odd = (index & 1u) == 1u;
    if (bubble.inner.y == 0.0) {
        return corner(select(half, bubble.sides - 1u - half, is_odd), bubble.outer);
    }
    return corner(half, select(bubble.inner, bubble.outer, is_odd));
}

// The whole picture: what a bubble covers from inside.
@vertex
fn everywhere(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn backdrop(direction: vec3f, footprint: f32) -> vec3f {
    return backdrop_radiance(backdrop_map, backdrop_sampler, light, upward(direction), footprint);
}

// Light from what is drawn behind the bubble, at a position in the picture.
fn drawn_light(position: vec2f) -> vec3f {
    return light.unseen * textureLoad(picture_behind, vec2u(position), 0).rgb;
}

// What is seen beside the bubble: what is drawn already, the backdrop, or what the bath mirrors of it.
fn beside(direction: vec3f, footprint: f32, position: vec2f) -> vec3f {
    if (AMONG_OTHERS == 1u) {
        return textureLoad(picture_so_far, vec2u(position), 0).rgb;
    }
    if (OVER_OTHERS == 1u) {
        return textureLoad(picture_behind, vec2u(position), 0).rgb;
    }
    return light.seen * (crossing(1.0, direction.z, direction) * backdrop(direction, footprint));
}

fn surroundings(direction: vec3f, footprint: f32) -> vec3f {
    return environment_radiance(environment, environment_sampler, light, upward(direction), footprint);
}

fn dimmed(steps: mat4x3f, first: vec3f, later: vec3f) -> mat4x3f {
    return mat4x3f(first * steps[0], later * steps[1], later * steps[2], later * steps[3]);
}

// The backdrop behind a sample, which has its own place in focus: samples of a bubble out of focus all see it along the pixel's ray.
fn backdrop_behind(path: Path) -> vec3f {
    if (OUT_OF_FOCUS == 1u) {
        let ray = view_ray(view, path.position);
        return backdrop(ray, pixel_angle(view, ray));
    }
    return backdrop(path.direction, sqrt(path.pixel.x * path.pixel.y));
}

// The ray straight through, which heads for the back wall.
fn straight_through(path: Path, is_inside: bool) -> Followed {
    let back = path.foot + path.half_chord * path.round;
    let front_z = path.foot.z - path.half_chord * path.round.z;
    let start_z = select(front_z, -bubble.to_center_m.z, is_inside);
    let left = select(left_before(path), 1.0, is_inside) * crossing(start_z, back.z, path.direction)
        * past_meniscus(back.z, bubble.radius_m);
    var behind = vec3f(0.0);
    if (OVER_OTHERS == 1u) {
        // What is drawn already has crossed the bath's level.
        let front = select(past_meniscus(front_z, bubble.radius_m), 1.0, is_inside);
        behind = front * past_meniscus(back.z, bubble.radius_m) * drawn_light(path.position);
    } else {
        behind = left * crossing(back.z, path.direction.z, path.direction) * backdrop_behind(path);
    }
    return Followed(Hop(back, path.direction), 0.0, left, behind);
}

// What is seen along a ray: see optics/walls.wgsl.
fn film_radiance(path: Path, is_inside: bool) -> vec3f {
    let shares = polarisation_along(path, light.polariser);
    let through = straight_through(path, is_inside);
    let behind = through.light;
    let first = first_hits(path, is_inside, through);
    let across = path.across / max(length(path.across), 1e-9);
    let passed = passed_others(path, across);
    var walls: Walls;
    walls.first = first.four.hits;
    walls.first.steps = dimmed(first.four.hits.steps, passed.front, passed.back);
    walls.polarised = dimmed(first.polarised, passed.front, passed.back)
        + dimmed(first.four.hits.steps, passed.front_excess, passed.back_excess);
    var polarised = unpolarised(vec3f(0.0));
    var turn = vec2f(1.0, 0.0);
    if (TRACKS_POLARISATION == 1u) {
        sample_behind = polarisation_behind(path.position);
        turn = turn_between(picture_axis(path.direction), across, path.direction);
        polarised = turned(sample_behind, turn);
        let of_light = light.unseen * polarised.q;
        walls.polarised[0] -= passed.front * of_light;
        walls.polarised[1] -= passed.back * of_light;
    }
    var last = first.four.last;
    if (INNER > 3u) {
        let second = four_hits(path, last, 1u);
        walls.second = second.hits;
        walls.second.steps = dimmed(walls.second.steps, passed.back, passed.back);
        last = second.last;
    }
    if (INNER > 7u) {
        let third = four_hits(path, last, 2u);
        walls.third = third.hits;
        walls.third.steps = dimmed(walls.third.steps, passed.back, passed.back);
        last = third.last;
        for (var k = 0u; k < FURTHER; k++) {
            let next = followed(path, last);
            walls.further[k] = passed.back * (next.light - last.light);
            last = next;
        }
    }
    // One reflection more, by the mean reflectance over all thicknesses, of s light, which outlasts p: no lookup of a film.
    let r2 = surface_reflectance(axes.index, path.cos_theta).x;
    let more = 2.0 * r2 / (1.0 + r2) * passed.back * (followed(path, last).light - last.light);
    if (INNER == 1u) {
        walls.first.steps[1] += more;
    } else if (INNER == 3u) {
        walls.first.steps[3] += more;
    } else if (INNER == 7u) {
        walls.second.steps[3] += more;
    } else {
        walls.further[FURTHER - 1u] += more;
    }
    // What is there already: the bubble adds how it differs from the light straight behind.
    var radiance = light.seen * behind;
    if (AMONG_OTHERS == 1u) {
        radiance = textureLoad(picture_so_far, vec2u(path.position), 0).rgb;
    }
    if (WAVELENGTHS == 0u) {
        return radiance + light.scale * colour_products(path, walls.first);
    }
    var seen = vec3f(0.0);
    let products = resolved(walls, quadrature[0].gap_nm);
    for (var k = 0u; k < WAVELENGTHS; k++) {
        seen += wavelength_radiance(quadrature[k], path.cos_theta, products, shares);
    }
    if (TRACKS_POLARISATION == 1u) {
        sample_polarisation = path_polarisation(path, products, polarised, turn);
    }
    if (EVERYTHING == 0u) {
        let nm = walls.first.walls_nm;
        let spread = walls.first.spread_nm;
        seen += wall_reflection(path, nm.x, spread.x, shares, walls.first.steps[0])
            + wall_reflection(path, nm.y, spread.y, shares, walls.first.steps[1]);
    }
    return radiance + light.scale * seen;
}

// The part of L - B by the table's colours of the first walls.
fn colour_products(path: Path, hits: Hits) -> vec3f {
    let white = quadrature[0].response * vec3f(1.0);
    let over_white = 1.0 / white;
    let unpolarised = vec2f(0.5);
    var colours = mat4x3f();
    colours[0] = wall_reflection(path, hits.walls_nm.x, hits.spread_nm.x, unpolarised, over_white);
    colours[1] = wall_reflection(path, hits.walls_nm.y, hits.spread_nm.y, unpolarised, over_white);
    if (INNER > 1u) {
        colours[2] = wall_reflection(path, hits.walls_nm.z, hits.spread_nm.z, unpolarised, over_white);
        colours[3] = wall_reflection(path, hits.walls_nm.w, hits.spread_nm.w, unpolarised, over_white);
    }
    return white * product_of_colours(axes.index, path.cos_theta, colours, hits.steps);
}

fn wall_reflection(path: Path, nm: f32, spread_nm: f32, polarisation: vec2f, step: vec3f) -> vec3f {
    return film_reflection(table, axes, FilmPoint(path.cos_theta, nm, spread_nm), polarisation, step);
}

// What is seen of the bubble along a ray that is known to meet it.
fn bubble_radiance(direction: vec3f, part: PixelPart, position: vec2f) -> vec3f {
    return film_radiance(path_along(direction, part, position), eye_is_inside());
}

struct Shaded {
    @location(0) radiance: vec4f,
    // Written where TRACKS_POLARISATION is 1.
    @location(1) polarisation: vec4u,
}

@fragment
fn shade(@builtin(position) position: vec4f) -> Shaded {
    let radiance = vec4f(storable(pixel_radiance(position.xy)), 1.0);
    let polarised = mean_polarisation();
    return Shaded(radiance, packed(polarised.q, polarised.u));
}

// The yardstick of the frame's cost: a plain mirror with one filtered environment lookup.
@fragment
fn shade_mirror(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let plane = view_plane(view, position.xy);
    let edge = outline(plane, 1.0);
    let behind = beside(normalize(plane), view.pixel_height, position.xy);
    if (edge.coverage <= 0.0) {
        return vec4f(storable(behind), 1.0);
    }
    let path = path_along(edge.inside, WHOLE_PIXEL, position.xy);
    let direction = mirrored(path, path.foot - path.half_chord * path.round);
    let shown = light.seen * surroundings(direction, footprint(spanned_angles(path, direction, 2.0)));
    return vec4f(storable(mix(behind, shown, edge.coverage)), 1.0);
}
