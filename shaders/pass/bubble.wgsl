// One bubble: an exact sphere traced through its bounding quad. Front reflection, transmission, back wall, inner reflections, each
// wall with the thickness at its own hit; what is left after the last wall goes to the last direction, so no energy is lost.

import package::camera::view::{View, pixel_angle, view_plane};
import package::film::control::{Balance, balanced};
import package::light::environment::{Light, backdrop_radiance, environment_radiance};
import package::optics::film_colour::{Polarised, film_colour};
import package::optics::table::{FilmPoint, TableAxes};
import package::optics::walls::{product, scaled, sum, transmitted, unpolarised};
import package::sphere::cubed::{HALO, locate};
import package::sphere::lookup::{map_at, tracer_at};
import package::sphere::silhouette::{Silhouette, silhouette};

// 1: the film has one thickness everywhere, and no field is read.
override UNIFORM_FILM: u32;
// 1: cells are larger than pixels, and the film is looked up through its flow map at each of them.
override MAGNIFIED: u32;
// Samples along each side of a pixel: 1, or more for bubbles of a few pixels, whose film is finer than a pixel.
override SAMPLES: u32;

// Mirrors `BubbleUniform` in src/gpu/draw.rs.
struct Bubble {
    centre_m: vec3f,
    radius_m: f32,
    // Bounding rectangle in clip coordinates: left, bottom, right, top.
    bounds: vec4f,
    // Thickness of a uniform film, in nm.
    thickness_nm: f32,
    // Cells along a panel's edge, of the film and of its tracer.
    cells: u32,
    tracer_cells: u32,
    // What has evaporated from the whole film, in nm, and the thickness at which that ends.
    thinned_nm: f32,
    // Takes directions of the world to the film, which may turn as a whole.
    to_film: mat3x3f,
    black_nm: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var environment: texture_cube<f32>;
@group(0) @binding(3) var environment_sampler: sampler;
@group(0) @binding(4) var<uniform> bubble: Bubble;
@group(0) @binding(5) var<uniform> axes: TableAxes;
@group(0) @binding(6) var table: texture_2d_array<f32>;
@group(0) @binding(7) var table_sampler: sampler;
@group(0) @binding(8) var film: texture_2d_array<f32>;
@group(0) @binding(9) var<uniform> film_balance: Balance;
@group(0) @binding(10) var<storage, read> film_map: array<vec4f>;
@group(0) @binding(11) var<storage, read> film_tracer: array<f32>;

@vertex
fn bounding_quad(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let x = select(bubble.bounds.x, bubble.bounds.z, (index & 1u) == 1u);
    let y = select(bubble.bounds.y, bubble.bounds.w, (index >> 1u) == 1u);
    return vec4f(x, y, 0.0, 1.0);
}

fn film_texel(texel: vec2i, panel: u32) -> f32 {
    return textureLoad(film, texel, panel, 0).r;
}

// The shown film, bilinear between cell centres.
fn film_at(direction: vec3f) -> f32 {
    let at = locate(direction, bubble.cells);
    let base = floor(at.cell);
    let t = at.cell - base;
    // Weighted here: filtering hardware has only 8 bits for its weights, and need not filter this format at all.
    let first = vec2i(base) + i32(HALO);
    let low = mix(film_texel(first, at.panel), film_texel(first + vec2i(1, 0), at.panel), t.x);
    let high = mix(film_texel(first + vec2i(0, 1), at.panel), film_texel(first + vec2i(1, 1), at.panel), t.x);
    return mix(low, high, t.y);
}

fn map_value(unused: u32, place: u32) -> vec4f {
    return film_map[place];
}

fn tracer_value(place: u32) -> f32 {
    return film_tracer[place];
}

// The tracer of the last remap, through the flow map: as sharp as what is known of the film.
fn film_through_map(direction: vec3f) -> f32 {
    let origin = map_at(0u, direction, bubble.cells).xyz;
    return balanced(tracer_at(origin, bubble.tracer_cells), film_balance);
}

// Thickness at a point of the unit sphere.
fn thickness_nm(point: vec3f) -> f32 {
    var thickness_nm = bubble.thickness_nm;
    if (UNIFORM_FILM == 0u) {
        let direction = bubble.to_film * point;
        if (MAGNIFIED == 1u) {
            thickness_nm = film_through_map(direction);
        } else {
            thickness_nm = film_at(direction);
        }
    }
    return max(thickness_nm - bubble.thinned_nm, min(thickness_nm, bubble.black_nm));
}

fn wall(point: vec3f, cos_theta: f32) -> Polarised {
    let reflected = film_colour(table, table_sampler, axes, FilmPoint(cos_theta, thickness_nm(point)));
    return scaled(reflected, 1.0 / light.white);
}

fn backdrop(direction: vec3f, footprint: f32) -> vec3f {
    return backdrop_radiance(environment, environment_sampler, light, direction, footprint);
}

fn surroundings(direction: vec3f, footprint: f32) -> vec3f {
    return environment_radiance(environment, environment_sampler, light, direction, footprint);
}

// A ray and the great circle that all its hits lie on. With the unit sphere at the origin a hit at normal n under direction v has
// v . n = -+cos_theta, a chord has the length 2 cos_theta, and every reflection turns the ray by the same angle.
struct Path {
    direction: vec3f,
    // Foot of the perpendicular from the centre on the ray: |foot| = sin theta.
    foot: vec3f,
    cos_theta: f32,
    // Angle that one pixel spans.
    pixel: f32,
    // Rate at which theta turns as the ray turns, radians a radian.
    theta_rate: f32,
    // sin of the angle between the ray and the direction to the centre.
    sin_view: f32,
}

// Footprint of a reflected direction: its spread in the plane of incidence, where the sphere's curvature widens it, and across,
// where it turns about the axis through the centre. The geometric mean, but no finer than a quarter of the wider one.
fn footprint(path: Path, direction: vec3f, turns: f32) -> f32 {
    let along = path.pixel * abs(1.0 + turns * path.theta_rate);
    let to_centre = normalize(bubble.centre_m - view.eye_m);
    let across = path.pixel * length(cross(direction, to_centre)) / max(path.sin_view, 1e-6);
    return max(sqrt(along * across), 0.25 * max(along, across));
}

// What comes along a ray that is inside the bubble and heads for the wall at `point`.
fn inner_radiance(path: Path, point: vec3f) -> Polarised {
    let chord = 2.0 * path.cos_theta;
    let back = wall(point, path.cos_theta);
    let v1 = path.direction - chord * point;
    let point1 = point + chord * v1;
    let second = wall(point1, path.cos_theta);
    let v2 = v1 - chord * point1;
    let straight = scaled(transmitted(back), backdrop(path.direction, path.pixel));
    let once = scaled(transmitted(second), surroundings(v1, footprint(path, v1, -2.0)));
    let twice = scaled(second, surroundings(v2, footprint(path, v2, -4.0)));
    return sum(straight, product(back, sum(once, twice)));
}

fn outer_radiance(path: Path) -> vec3f {
    let point = path.foot - path.cos_theta * path.direction;
    let v0 = path.direction + 2.0 * path.cos_theta * point;
    let mirrored = surroundings(v0, footprint(path, v0, 2.0));
    let front = wall(point, path.cos_theta);
    let inside = inner_radiance(path, path.foot + path.cos_theta * path.direction);
    return unpolarised(sum(scaled(front, mirrored), product(transmitted(front), inside)));
}

// Geometry of a view ray that meets the sphere.
fn path_along(direction: vec3f) -> Path {
    let eye = (view.eye_m - bubble.centre_m) / bubble.radius_m;
    let foot = eye - dot(eye, direction) * direction;
    let cos_theta = sqrt(max(1.0 - dot(foot, foot), 0.0));
    let distance = length(eye);
    let cos_view = abs(dot(eye, direction)) / distance;
    return Path(
        direction,
        foot,
        cos_theta,
        pixel_angle(view, direction),
        distance * cos_view / max(cos_theta, 1e-3),
        length(foot) / distance,
    );
}

// Radiance of the bubble along the ray through a picture position whose ray is known to meet the sphere.
fn bubble_radiance(direction: vec3f) -> vec3f {
    let path = path_along(direction);
    if (distance(view.eye_m, bubble.centre_m) <= bubble.radius_m) {
        return unpolarised(inner_radiance(path, path.foot + path.cos_theta * direction));
    }
    return outer_radiance(path);
}

// One sample: the bubble as far as it covers the sample's square, the backdrop in the rest.
fn sample_radiance(position: vec2f, width: f32) -> vec3f {
    let plane = view_plane(view, position);
    let edge = silhouette(view, bubble.centre_m, bubble.radius_m, plane, width);
    var radiance = vec3f(0.0);
    if (edge.coverage > 0.0) {
        radiance = bubble_radiance(edge.inside);
    }
    if (edge.coverage < 1.0) {
        let ray = normalize(plane);
        radiance = mix(backdrop(ray, pixel_angle(view, ray)), radiance, edge.coverage);
    }
    return radiance;
}

@fragment
fn shade(@builtin(position) position: vec4f) -> @location(0) vec4f {
    if (SAMPLES == 1u) {
        return vec4f(sample_radiance(position.xy, 1.0), 1.0);
    }
    let corner = floor(position.xy);
    let width = 1.0 / f32(SAMPLES);
    var total = vec3f(0.0);
    for (var k = 0u; k < SAMPLES * SAMPLES; k++) {
        let offset = vec2f(f32(k % SAMPLES) + 0.5, f32(k / SAMPLES) + 0.5) * width;
        total += sample_radiance(corner + offset, width);
    }
    return vec4f(total * width * width, 1.0);
}

// The yardstick of the frame's cost: a plain mirror with one filtered environment lookup.
@fragment
fn shade_mirror(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let plane = view_plane(view, position.xy);
    let edge = silhouette(view, bubble.centre_m, bubble.radius_m, plane, 1.0);
    let behind = backdrop(normalize(plane), view.pixel_height);
    if (edge.coverage <= 0.0) {
        return vec4f(behind, 1.0);
    }
    let path = path_along(edge.inside);
    let point = path.foot - path.cos_theta * path.direction;
    let mirrored = path.direction + 2.0 * path.cos_theta * point;
    return vec4f(mix(behind, surroundings(mirrored, footprint(path, mirrored, 2.0)), edge.coverage), 1.0);
}
