// What other bubbles do to light: they are seen in a bubble's mirror, and they dim what its walls reflect.
//
// The pass that draws bubbles declares what this reads: `bubble`, `others`, its `part` of their `lists`, `films` with their `point_sampler`, the table,
// the light, and the functions `surroundings` and `from_round`.

import package::light::stokes::{Stokes, past_wall, turn_between, turned, unpolarised};
import package::optics::film_colour::reflection_at;
import package::optics::shares::{s_part, share_of_s};
import package::optics::table::FilmPoint;
import package::sphere::others::{Chord, OtherBubble, chord_through, other_nm, place_on};
import package::sphere::path::Path;

// 1: walls of other bubbles lie between those of the bubble, which then adds to `picture_so_far`.
override AMONG_OTHERS: u32;
// 1: light that a wall of another bubble mirrors inside has passed the wall opposite. 0: it comes straight from the surroundings.
override OPPOSITE_WALLS: u32;

// A bubble that a ray meets: its number and where.
struct Meeting {
    number: u32,
    chord: Chord,
}

// Farther than any bubble.
const FAR_M: f32 = 1e30;

// Light from a direction, as seen at a point of the unit sphere: from the surroundings, through the two nearest bubbles on the way and with what
// those mirror of them. Its polarisation refers to an axis across the direction.
fn mirrored_light(point: vec3f, direction: vec3f, axis: vec3f, footprint: f32) -> Stokes {
    let origin_m = bubble.to_center_m + bubble.radius_m * from_round(point);
    var first = Meeting(0u, Chord(FAR_M, FAR_M, 0.0));
    var second = first;
    for (var k = 0u; k < part.mirrored; k++) {
        let number = lists[part.first_other + k];
        let met = Meeting(number, chord_through(others[number], origin_m, direction));
        if (met.chord.far_m > 0.0 && met.chord.near_m < second.chord.near_m) {
            second = met;
            if (met.chord.near_m < first.chord.near_m) {
                second = first;
                first = met;
            }
        }
    }
    var seen = unpolarised(surroundings(direction, footprint));
    for (var k = next_wall(first, second, 0u); k < 4u; k = next_wall(first, second, k + 1u)) {
        let met = met_at(first, second, k);
        let place = place_on(others[met.number], origin_m + wall_distance_m(met, k) * direction);
        let turn = turn_to_wall(axis, direction, place);
        let wall = OtherWall(met.number, place, direction, met.chord.cos_theta, is_far(k));
        seen = turned(past_other_wall(wall, turned(seen, turn), footprint), vec2f(turn.x, -turn.y));
    }
    return seen;
}

// The turn from an axis across a direction to that of the wall's s light, at a point of the unit sphere. Straight through the middle there is no plane of
// incidence, and s and p light are the same.
fn turn_to_wall(axis: vec3f, direction: vec3f, place: vec3f) -> vec2f {
    let across = cross(direction, place);
    return turn_between(axis, across / max(length(across), 1e-9), direction);
}

// A wall of another bubble, looked at along a direction, at a point of its unit sphere.
struct OtherWall {
    number: u32,
    place: vec3f,
    direction: vec3f,
    cos_theta: f32,
    is_far: bool,
}

// Light from behind a wall after it, with what the wall mirrors. Its polarisation refers to the plane of incidence.
fn past_other_wall(wall: OtherWall, behind: Stokes, footprint: f32) -> Stokes {
    let mirrored = mirrored_by_wall(wall, reflect(wall.direction, wall.place), footprint);
    let film = FilmPoint(wall.cos_theta, other_nm(films, point_sampler, others[wall.number], wall.place), 0.0);
    let mean = reflected_light(film, vec3f(1.0));
    let reflected = reflected_light(film, mirrored - behind.i);
    return past_wall(behind, mirrored, reflected, mean, half_difference(film, mean));
}

// Light that a wall mirrors from a direction. That from inside has passed the wall opposite, with what that one reflects.
fn mirrored_by_wall(wall: OtherWall, direction: vec3f, footprint: f32) -> vec3f {
    let from_outside = surroundings(direction, footprint);
    if (OPPOSITE_WALLS == 0u || !wall.is_far) {
        return from_outside;
    }
    let opposite = wall.place + 2.0 * wall.cos_theta * direction;
    let film = FilmPoint(wall.cos_theta, other_nm(films, point_sampler, others[wall.number], opposite), 0.0);
    return from_outside + reflected_light(film, surroundings(reflect(direction, opposite), footprint) - from_outside);
}

// The walls of the two nearest bubbles from behind: the far wall of the second, its near wall, then those of the first.
fn met_at(first: Meeting, second: Meeting, wall: u32) -> Meeting {
    var met = second;
    if (wall > 1u) {
        met = first;
    }
    return met;
}

// Whether a wall is the far one of its bubble, which is met from inside.
fn is_far(wall: u32) -> bool {
    return (wall & 1u) == 0u;
}

fn wall_distance_m(met: Meeting, wall: u32) -> f32 {
    return select(met.chord.near_m, met.chord.far_m, is_far(wall));
}

// The first wall from one on that lies on the ray: most rays meet none, and what is costly is done for the rest alone. A ray that starts inside a
// bubble meets only its far wall.
fn next_wall(first: Meeting, second: Meeting, from_wall: u32) -> u32 {
    for (var wall = from_wall; wall < 4u; wall++) {
        let distance_m = wall_distance_m(met_at(first, second, wall), wall);
        if (distance_m > 0.0 && distance_m < FAR_M) {
            return wall;
        }
    }
    return 4u;
}

// What a film of another bubble reflects of light, as light.
fn reflected_light(film: FilmPoint, incident: vec3f) -> vec3f {
    return light.unseen * (light.scale * reflection_at(table, axes, film, vec2f(0.5), incident));
}

// What other bubbles leave of light on its way from the bubble's front and back wall: the mean of s and p light, and half of how much more they leave of
// s light.
struct Passed {
    front: vec3f,
    back: vec3f,
    front_excess: vec3f,
    back_excess: vec3f,
}

fn passed_others(path: Path, axis: vec3f) -> Passed {
    var passed = Passed(vec3f(1.0), vec3f(1.0), vec3f(0.0), vec3f(0.0));
    if (AMONG_OTHERS == 0u) {
        return passed;
    }
    var front = array(vec3f(1.0), vec3f(1.0));
    var back = front;
    let middle_m = dot(bubble.to_center_m, path.direction);
    let half_m = path.half_chord * bubble.radius_m;
    var next = next_chord(path.direction, middle_m + half_m, 0u);
    while (next.k < part.among) {
        let other = others[next.number];
        for (var wall = 0u; wall < 2u; wall++) {
            let distance_m = select(next.chord.near_m, next.chord.far_m, wall == 1u);
            let left = wall_left(other, next.chord, distance_m, path.direction, axis);
            let is_before_front = distance_m > 0.0 && distance_m < middle_m - half_m;
            let is_before_back = distance_m > 0.0 && distance_m < middle_m + half_m;
            for (var k = 0u; k < 2u; k++) {
                front[k] *= select(vec3f(1.0), left[k], is_before_front);
                back[k] *= select(vec3f(1.0), left[k], is_before_back);
            }
        }
        next = next_chord(path.direction, middle_m + half_m, next.k + 1u);
    }
    passed.front = 0.5 * (front[0] + front[1]);
    passed.back = 0.5 * (back[0] + back[1]);
    passed.front_excess = 0.5 * (front[0] - front[1]);
    passed.back_excess = 0.5 * (back[0] - back[1]);
    return passed;
}

// A bubble of the cluster that a ray meets before some distance: its place in the list, its number, and where.
struct NextChord {
    k: u32,
    number: u32,
    chord: Chord,
}

// The first such bubble from a place in the list on. Most of the list is missed: what is costly is done for the rest alone.
fn next_chord(direction: vec3f, end_m: f32, first: u32) -> NextChord {
    for (var k = first; k < part.among; k++) {
        let number = lists[part.first_other + k];
        let chord = chord_through(others[number], vec3f(0.0), direction);
        if (chord.far_m > 0.0 && chord.near_m < end_m) {
            return NextChord(k, number, chord);
        }
    }
    return NextChord(part.among, 0u, Chord(-1.0, -1.0, 0.0));
}

// What a wall leaves of light that passes it: of s light and of p light of the bubble, whose s light has its field along an axis.
fn wall_left(other: OtherBubble, chord: Chord, distance_m: f32, direction: vec3f, axis: vec3f) -> array<vec3f, 2> {
    let place = place_on(other, distance_m * direction);
    let film = FilmPoint(chord.cos_theta, other_nm(films, point_sampler, other, place), 0.0);
    let mean = reflected_light(film, vec3f(1.0));
    let of_s = turn_to_wall(axis, direction, place).x * half_difference(film, mean);
    return array(max(1.0 - mean - of_s, vec3f(0.0)), max(1.0 - mean + of_s, vec3f(0.0)));
}

// Half of how much more a film reflects of s light than of p light, from the mean that it reflects.
fn half_difference(film: FilmPoint, mean: vec3f) -> vec3f {
    return mean * (s_part(mean, share_of_s(axes.index, film.cos_theta)) - 1.0);
}
