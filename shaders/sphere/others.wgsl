// Other bubbles on the way of a ray: where it meets them, how thick their film is there, and what that leaves of light.

import package::film::shown::film_part_at;
import package::light::water::upward;

// Mirrors `OtherBubble` in src/gpu/passes/bubble.rs. Others are taken to be round, and whole where they burst.
struct OtherBubble {
    // From the eye to the center.
    to_center_m: vec3f,
    radius_m: f32,
    // Takes directions of the world to the film.
    to_film: mat3x3f,
    // Where its film lies in the texture of all films, in texels.
    origin: vec2u,
    // Cells along a panel's edge; 0 for a film of one thickness.
    cells: u32,
    // Thickness of a film of one thickness, in nm.
    thickness_nm: f32,
    // What has evaporated, and the thickness at which evaporation ends, in nm.
    evaporated_nm: f32,
    black_nm: f32,
    // What skins add to the thickness of a plain film that looks like it, and the thickness of both, in nm.
    extra_nm: f32,
    skins_nm: f32,
    // Height of the ring that the film ends at, over the radius.
    rim_z: f32,
    // How much thicker the bubble is than the film shows.
    thickness_factor: f32,
    // Radius of its circle of confusion, in pixels; 0 if it is in focus.
    confusion_pixels: f32,
}

// Where a ray meets a bubble's walls: distances from the ray's origin, and the cosine of incidence. Walls behind the origin have negative
// distances; a bubble that is missed has both there.
struct Chord {
    near_m: f32,
    far_m: f32,
    cos_theta: f32,
}

fn chord_through(other: OtherBubble, origin_m: vec3f, direction: vec3f) -> Chord {
    let to_center = other.to_center_m - origin_m;
    let middle = dot(to_center, direction);
    let aside = to_center - middle * direction;
    let square = other.radius_m * other.radius_m - dot(aside, aside);
    if (square <= 0.0) {
        return Chord(-1.0, -1.0, 0.0);
    }
    let half = sqrt(square);
    return Chord(middle - half, middle + half, half / other.radius_m);
}

// The point of the unit sphere that a place on the wall is.
fn place_on(other: OtherBubble, place_m: vec3f) -> vec3f {
    return (place_m - other.to_center_m) / other.radius_m;
}

// The thickness of the plain film that looks like the one at a point of the unit sphere, in nm.
fn other_nm(films: texture_2d_array<f32>, point_sampler: sampler, other: OtherBubble, place: vec3f) -> f32 {
    if (place.z < other.rim_z) {
        return 0.0;
    }
    var nm = other.thickness_nm;
    if (other.cells > 0u) {
        nm = film_part_at(films, point_sampler, other.to_film * upward(place), other.cells, other.origin);
    }
    nm *= other.thickness_factor;
    nm = max(nm - other.evaporated_nm, min(nm, other.black_nm));
    return nm + other.extra_nm * min(nm / other.skins_nm, 1.0);
}
