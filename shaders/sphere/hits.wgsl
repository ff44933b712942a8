// The hits of a ray on the walls of a bubble, four at a time: how thick the film is at each, and the steps of light that its reflectance is a factor on.
//
// The pass that draws bubbles declares what this reads: `axes` and `bubble`.

import package::film::wall::optical_nm;
import package::light::others::mirrored_light;
import package::light::stokes::{Stokes, unpolarised};
import package::light::strips::reflected_surroundings;
import package::light::water::crossing;
import package::optics::airy::cos_refracted;
import package::optics::film_colour::THICKNESSES;
import package::optics::walls::{Hits, INNER, MIRRORS_OTHERS};
import package::sphere::hops::{Followed, followed, left_before, mirrored, reflected_inside};
import package::sphere::path::{Path, footprint, spanned_angles};
import package::sphere::samples::REFINED_SAMPLES;

// How the optical path in the film changes from pixel to pixel at four hits in a row, in nm.
struct Slopes {
    across: vec4f,
    down: vec4f,
}

// Those of the last sample that all pixels took.
var<private> slopes: array<Slopes, 3>;

// Width of the thicknesses that a sample spans at some four hits, in nm: the change of the path in the film, which angles have a part in, over the
// part of the pixel.
@diagnostic(off, derivative_uniformity)
fn spread_nm(path: Path, walls_nm: vec4f, four: u32) -> vec4f {
    if (THICKNESSES == 1u) {
        return vec4f(0.0);
    }
    let cos_t = cos_refracted(axes.index, path.cos_theta);
    if (REFINED_SAMPLES == 0u || path.part.is_everywhere) {
        let path_nm = cos_t * walls_nm;
        slopes[four] = Slopes(dpdx(path_nm), dpdy(path_nm));
    }
    let slope = slopes[four];
    let line = path.part.line;
    let along = path.part.size.x * (line.x * slope.across + line.y * slope.down);
    let beside = path.part.size.y * (line.x * slope.down - line.y * slope.across);
    return sqrt(along * along + beside * beside) / cos_t;
}

// Four hits more, and where the ray is after them.
struct FourHits {
    hits: Hits,
    last: Followed,
}

// The first four, and by how much more their steps are of s light than of p light.
struct FirstHits {
    four: FourHits,
    polarised: mat4x3f,
}

fn four_hits(path: Path, at: Followed, four: u32) -> FourHits {
    let a = followed(path, at);
    let b = followed(path, a);
    let c = followed(path, b);
    let d = followed(path, c);
    let walls_nm = vec4f(
        optical_nm(at.hop.point, false),
        optical_nm(a.hop.point, false),
        optical_nm(b.hop.point, false),
        optical_nm(c.hop.point, false),
    );
    let steps = mat4x3f(a.light - at.light, b.light - a.light, c.light - b.light, d.light - c.light);
    return FourHits(Hits(walls_nm, spread_nm(path, walls_nm, four), steps), d);
}

// The first four hits: the front wall, which there is none of from inside the bubble, and three inside, or one.
fn first_hits(path: Path, is_inside: bool, at: Followed) -> FirstHits {
    let behind = at.light;
    let front = path.foot - path.half_chord * path.round;
    let outward = mirrored(path, front);
    var last = reflected_inside(path, at);
    let seen = outer_and_first(path, MirroredRays(front, outward, at.hop.point, last.hop.direction), is_inside);
    let from_first = last.light * seen[1].q;
    last.light *= seen[1].i;
    var polarised = mat4x3f(vec3f(0.0), from_first, -from_first, vec3f(0.0));
    var walls_nm = vec4f(0.0, optical_nm(at.hop.point, true), 0.0, 0.0);
    var steps = mat4x3f(vec3f(0.0), last.light - behind, vec3f(0.0), vec3f(0.0));
    if (INNER > 1u) {
        let a = last;
        let b = followed(path, a);
        last = followed(path, b);
        walls_nm.z = optical_nm(a.hop.point, false);
        walls_nm.w = optical_nm(b.hop.point, false);
        steps[2] = b.light - a.light;
        steps[3] = last.light - b.light;
    }
    if (!is_inside) {
        walls_nm.x = optical_nm(front, true);
        let left = left_before(path) * crossing(front.z, outward.z, outward);
        steps[0] = left * seen[0].i - behind;
        polarised[0] = left * seen[0].q;
    }
    return FirstHits(FourHits(Hits(walls_nm, spread_nm(path, walls_nm, 0u), steps), last), polarised);
}

// The outer reflection and the first inner one: where they are, and where light goes from there.
struct MirroredRays {
    front: vec3f,
    outward: vec3f,
    back: vec3f,
    inward: vec3f,
}

// Light from both, with other bubbles in it. Its polarisation refers to the plane of incidence: s light has its field across.
fn outer_and_first(path: Path, rays: MirroredRays, is_inside: bool) -> array<Stokes, 2> {
    if (MIRRORS_OTHERS == 0u) {
        let outer = reflected_surroundings(path, rays.outward, 2.0);
        return array(unpolarised(outer), unpolarised(reflected_surroundings(path, rays.inward, -2.0)));
    }
    let outer = footprint(spanned_angles(path, rays.outward, 2.0));
    let first = footprint(spanned_angles(path, rays.inward, -2.0));
    let across = path.across / max(length(path.across), 1e-9);
    var seen = array(unpolarised(vec3f(0.0)), unpolarised(vec3f(0.0)));
    // In a loop, so that its code stands once.
    for (var k = select(0u, 1u, is_inside); k < 2u; k++) {
        let is_first = k == 1u;
        let point = select(rays.front, rays.back, is_first);
        let direction = select(rays.outward, rays.inward, is_first);
        seen[k] = mirrored_light(point, direction, across, select(outer, first, is_first));
    }
    return seen;
}
