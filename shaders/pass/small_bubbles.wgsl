// Small bubbles, all of one layer at once: each pixel goes through the bubbles of its tile, the farthest first, and lays what a bubble reflects
// over what is behind it. A bubble is round and whole, and three of its walls are looked up in the table; light that is reflected inside more
// than twice follows the mean over all thicknesses.

import package::camera::circle::{in_circle, sample_width};
import package::camera::view::{View, pixel_angle, view_plane};
import package::light::environment::{Light, environment_radiance};
import package::light::lamps::Lamp;
import package::light::stored::storable;
import package::optics::airy::{max_reflectance, surface_reflectance};
import package::optics::film_colour::{COLOURED, POLARISED};
import package::optics::shares::between_walls;
import package::optics::table::{FilmPoint, TableAxes, TablePlace, table_colour, table_place};
import package::sphere::others::{OtherBubble, chord_through, other_nm};
import package::sphere::path::{Path, WHOLE_PIXEL, footprint, polarisation_along, spanned_angles};
import package::sphere::silhouette::silhouette;

// Side of a tile in pixels.
override TILE: u32;
// Samples along each side of a pixel.
override SAMPLES: u32;
// 1: some bubbles are out of focus. Each sample passes the lens at a place of its own, and is filtered over its part of the circle of confusion.
override OUT_OF_FOCUS: u32;

// 1: light that is reflected three times inside is looked up too.
override THRICE: u32;
// 1: a bubble is a mirror with one environment lookup, the yardstick of the frame's cost.
override YARDSTICK: u32;

// The bubbles of a tile in `lists`.
// Mirrors `SmallTile` in src/gpu/passes/small_bubbles.rs.
struct Tile {
    first: u32,
    end: u32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var environment: texture_cube<f32>;
@group(0) @binding(3) var environment_sampler: sampler;
@group(0) @binding(4) var<uniform> axes: TableAxes;
@group(0) @binding(5) var table: texture_2d_array<u32>;
@group(0) @binding(6) var<uniform> lamps: array<Lamp, 12>;
@group(0) @binding(7) var films: texture_2d_array<f32>;
@group(0) @binding(8) var<storage, read> bubbles: array<OtherBubble>;
@group(0) @binding(9) var<storage, read> lists: array<u32>;
@group(0) @binding(10) var<storage, read> tiles: array<Tile>;
@group(0) @binding(11) var picture_behind: texture_2d<f32>;
@group(0) @binding(12) var point_sampler: sampler;

// The whole picture, of which the pass draws the tiles that have bubbles.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// A sample of a pixel: its point on the plane one metre before the eye, relative to the eye, its width in pixels, and where it passes the lens, over the
// lens's radius.
struct Sample {
    plane: vec3f,
    width: f32,
    in_lens: vec2f,
}

// The widest circle of confusion of which each sample's part is no larger than the bubble: its radius over the bubble's and the samples along a side.
const MOST_CONFUSION: f32 = 0.5;

// The sample as a bubble of the list meets it.
fn through_lens(sample: Sample, number: u32) -> Sample {
    if (OUT_OF_FOCUS == 0u || bubbles[number].confusion_pixels == 0.0) {
        return sample;
    }
    let radius_pixels = bubbles[number].radius_m / (length(bubbles[number].to_center_m) * view.pixel_height);
    let most = MOST_CONFUSION * f32(SAMPLES) * radius_pixels;
    let confusion_pixels = min(bubbles[number].confusion_pixels, most);
    let offset = confusion_pixels * view.pixel_height * sample.in_lens;
    let plane = sample.plane + offset.x * view.right - offset.y * view.up;
    return Sample(plane, sample_width(confusion_pixels, SAMPLES), sample.in_lens);
}

// The first bubble of a tile from a place in the list on that a sample may show: most of the list is missed, and what is costly is done for the
// rest alone.
fn next_seen(sample: Sample, first: u32, end: u32) -> u32 {
    for (var k = first; k < end; k++) {
        let number = lists[k];
        let seen = through_lens(sample, number);
        let ray = normalize(seen.plane);
        let to_center_m = bubbles[number].to_center_m;
        let along_m = dot(to_center_m, ray);
        let aside_m = to_center_m - along_m * ray;
        let reach_m = bubbles[number].radius_m + seen.width * view.pixel_height * along_m;
        if (along_m > 0.0 && dot(aside_m, aside_m) < reach_m * reach_m) {
            return k;
        }
    }
    return end;
}

// A ray through a bubble, as wide as a part of a pixel.
fn path_through(bubble: OtherBubble, direction: vec3f, pixel: f32) -> Path {
    let eye = -bubble.to_center_m / bubble.radius_m;
    let foot = eye - dot(eye, direction) * direction;
    let cos_theta = sqrt(max(1.0 - dot(foot, foot), 0.0));
    let distance = length(eye);
    return Path(
        direction,
        direction,
        foot,
        cos_theta,
        cos_theta,
        vec2f(pixel),
        abs(dot(eye, direction)) / max(cos_theta, 1e-3),
        length(foot) / distance,
        -eye / distance,
        cross(direction, foot),
        vec2f(0.0),
        WHOLE_PIXEL,
    );
}

fn surroundings(path: Path, direction: vec3f, turns: f32) -> vec3f {
    let width = footprint(spanned_angles(path, direction, turns));
    return environment_radiance(environment, environment_sampler, light, direction, width);
}

// What a wall makes of light: a column for each primary.
fn wall_colours(path: Path, nm: f32) -> mat3x3f {
    let place = table_place(axes, FilmPoint(path.cos_theta, nm, 0.0));
    let shares = polarisation_along(path, light.polariser);
    let scale = max_reflectance(axes.index, path.cos_theta) * light.scale;
    var columns = primaries(place, 0u);
    if (POLARISED == 1u) {
        columns = shares.x * columns + shares.y * primaries(place, select(1u, 3u, COLOURED == 1u));
    }
    return mat3x3f(scale * columns[0], scale * columns[1], scale * columns[2]);
}

fn primaries(place: TablePlace, first: u32) -> mat3x3f {
    let red = table_colour(table, place, first);
    if (COLOURED == 0u) {
        return mat3x3f(vec3f(red.r, 0.0, 0.0), vec3f(0.0, red.g, 0.0), vec3f(0.0, 0.0, red.b));
    }
    let green = table_colour(table, place, first + 1u);
    let blue = table_colour(table, place, first + 2u);
    return mat3x3f(red, green, blue);
}

// What is seen along a ray that meets a bubble, with what is seen behind it.
fn through_bubble(bubble: OtherBubble, path: Path, behind: vec3f) -> vec3f {
    let front = path.foot - path.cos_theta * path.direction;
    let back = path.foot + path.cos_theta * path.direction;
    let outward = path.direction + 2.0 * path.cos_theta * front;
    let seen_outward = surroundings(path, outward, 2.0);
    if (YARDSTICK == 1u) {
        return light.seen * seen_outward;
    }
    let inward = path.direction - 2.0 * path.cos_theta * back;
    let next = back + 2.0 * path.cos_theta * inward;
    let twice = inward - 2.0 * path.cos_theta * next;
    let thrice = twice - 2.0 * path.cos_theta * (next + 2.0 * path.cos_theta * twice);
    let light_behind = light.unseen * behind;
    let seen_inward = surroundings(path, inward, -2.0);
    let seen_twice = surroundings(path, twice, -4.0);
    var more = vec3f(0.0);
    if (THRICE == 1u) {
        // One reflection more, by the mean reflectance over all thicknesses of s light, which outlasts p.
        let r2 = surface_reflectance(axes.index, path.cos_theta).x;
        more = 2.0 * r2 / (1.0 + r2) * (surroundings(path, thrice, -6.0) - seen_twice);
    }
    let outer = wall_colours(path, other_nm(films, point_sampler, bubble, front));
    let inner = wall_colours(path, other_nm(films, point_sampler, bubble, back));
    let third = wall_colours(path, other_nm(films, point_sampler, bubble, next));
    // Colours over white are the walls' reflectances for each primary of the picture.
    let ones = vec3f(1.0);
    let over_white = 1.0 / (light.seen * ones);
    let between = between_walls(
        axes.index,
        path.cos_theta,
        over_white * (outer * ones),
        over_white * (inner * ones),
        over_white * (third * ones),
    );
    return behind + outer * (seen_outward - light_behind) + between.passed * (inner * (seen_inward - light_behind))
        + between.reflected * (inner * (seen_twice - seen_inward + more));
}

// One sample of a tile's bubbles.
fn sample_radiance(sample: Sample, tile: Tile, backdrop: vec3f) -> vec3f {
    let pixel = pixel_angle(view, normalize(sample.plane));
    var seen = backdrop;
    var k = next_seen(sample, tile.first, tile.end);
    while (k < tile.end) {
        let bubble = bubbles[lists[k]];
        let aim = through_lens(sample, lists[k]);
        let edge = silhouette(view, bubble.to_center_m, bubble.radius_m, aim.plane, aim.width);
        let path = path_through(bubble, edge.inside, aim.width * pixel);
        seen = mix(seen, through_bubble(bubble, path, seen), edge.coverage);
        k = next_seen(sample, k + 1u, tile.end);
    }
    return seen;
}

@fragment
fn small_bubbles(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let place = pixel / TILE;
    let tile = tiles[place.y * ((u32(view.width) + TILE - 1u) / TILE) + place.x];
    let behind = textureLoad(picture_behind, pixel, 0);
    let width = 1.0 / f32(SAMPLES);
    var total = vec3f(0.0);
    for (var k = 0u; k < SAMPLES * SAMPLES; k++) {
        let offset = (vec2f(vec2u(k % SAMPLES, k / SAMPLES)) + 0.5) * width;
        let sample = Sample(view_plane(view, vec2f(pixel) + offset), width, in_circle(k, SAMPLES * SAMPLES, vec2f(pixel)));
        total += sample_radiance(sample, tile, behind.rgb);
    }
    return vec4f(storable(total * width * width), 1.0);
}
