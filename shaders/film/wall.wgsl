// The film of the bubble that a pass draws: how thick it is at a point of its wall.
//
// The pass declares what this reads: `bubble`, `film` with its balance, map and tracer, the `point_sampler` of these, and the hole.

import package::film::control::balanced;
import package::film::hole::{HOLE_MERIDIANS, angle_from, meridian_of, mixed, pierced};
import package::film::shown::film_at;
import package::light::water::upward;
import package::sphere::lookup::{gather_place, map_at, tracer_at};

// 1: the film has one thickness everywhere, and no field is read.
override UNIFORM_FILM: u32;
// 1: cells are larger than pixels, and the film is looked up through its flow map at each of them.
override MAGNIFIED: u32;
// 1: the bubble bursts, and its film has a hole.
override BURST: u32;
// 1: the film has skins of soap on both faces.
override SKINS: u32;
// 1: the film ends at a ring.
override ON_RING: u32;

fn map_texel(unused: u32, texel: vec2u, panel: u32) -> vec4f {
    return textureLoad(film_map, texel, panel, 0);
}

fn tracer_texels(texel: vec2u, panel: u32) -> vec4f {
    return textureGather(0, film_tracer, point_sampler, gather_place(texel, bubble.tracer_cells), panel);
}

// The tracer of the last remap, through the flow map: as sharp as what is known of the film.
fn film_through_map(direction: vec3f) -> f32 {
    let origin = map_at(0u, direction, bubble.map_cells).xyz;
    return balanced(tracer_at(origin, bubble.tracer_cells), film_balance);
}

// Thickness at a point of the unit sphere. `is_early`: the wall is the front wall or the first inside. Later walls show so little that their film is
// never looked up through the flow map, which costs far more.
fn thickness_nm(place: vec3f, is_early: bool) -> f32 {
    if (ON_RING == 1u && place.z < bubble.rim_z) {
        return 0.0;
    }
    let point = upward(place);
    var thickness_nm = bubble.thickness_nm;
    if (UNIFORM_FILM == 0u) {
        let direction = bubble.to_film * point;
        if (MAGNIFIED == 1u && is_early) {
            thickness_nm = film_through_map(direction);
        } else {
            thickness_nm = film_at(film, point_sampler, direction, bubble.cells);
        }
    }
    thickness_nm *= bubble.thickness_factor;
    thickness_nm = max(thickness_nm - bubble.evaporated_nm, min(thickness_nm, bubble.black_nm));
    if (BURST == 1u) {
        return with_hole(bubble.to_film * point, thickness_nm);
    }
    return thickness_nm;
}

fn with_hole(direction: vec3f, thickness_nm: f32) -> f32 {
    let middle = hole_middle.xyz;
    let meridian = meridian_of(direction, middle);
    let low = hole_rim[u32(meridian) % HOLE_MERIDIANS];
    let high = hole_rim[(u32(meridian) + 1u) % HOLE_MERIDIANS];
    return pierced(mixed(low, high, fract(meridian)), angle_from(direction, middle), thickness_nm);
}

// The thickness of the plain film that looks like the one at a point of the unit sphere.
fn optical_nm(direction: vec3f, is_early: bool) -> f32 {
    let nm = thickness_nm(direction, is_early);
    if (SKINS == 0u) {
        return nm;
    }
    return nm + bubble.extra_nm * min(nm / bubble.skins_nm, 1.0);
}
