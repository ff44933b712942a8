// Light that may be polarised, by Stokes' parameters of three primaries each (E. Collett, Polarized Light, 1993, ch. 5). Circular polarisation is left
// out: films make little of it.

import package::optics::table::{between_rows, two_rows};

struct Stokes {
    // All of the light.
    i: vec3f,
    // Light whose field is along an axis, less light whose field is at right angles to it. The axis is at right angles to the ray.
    q: vec3f,
    // Light whose field is along the axis turned by 45 degrees, less light whose field is at right angles to that.
    u: vec3f,
}

// What is polarised, in one texel: packed as two rows of the table of film colours are.
fn packed(q: vec3f, u: vec3f) -> vec4u {
    return two_rows(q, u);
}

// The inverse, with light that is not polarised left out.
fn unpacked(texel: vec4u) -> Stokes {
    return Stokes(vec3f(0.0), between_rows(texel, 0.0), between_rows(texel, 1.0));
}

fn unpolarised(light: vec3f) -> Stokes {
    return Stokes(light, vec3f(0.0), vec3f(0.0));
}

// Cosine and sine of twice the angle from one axis at right angles to a direction to another; both are 0 where an axis is 0.
fn turn_between(axis: vec3f, other: vec3f, direction: vec3f) -> vec2f {
    let cosine = dot(axis, other);
    let sine = dot(cross(direction, axis), other);
    return vec2f((cosine - sine) * (cosine + sine), 2.0 * cosine * sine);
}

// The same light, referred to an axis that is turned.
fn turned(light: Stokes, turn: vec2f) -> Stokes {
    return Stokes(light.i, turn.x * light.q + turn.y * light.u, turn.x * light.u - turn.y * light.q);
}

// A wall's light, of which s light has its field along the axis: what comes from behind and passes, and unpolarised light that the wall reflects. The
// reflectances are factors on primaries: the mean of s and p light, and half of their difference. `reflected` is what the wall reflects of the
// unpolarised light, less what it reflects of the light from behind.
fn past_wall(behind: Stokes, mirrored: vec3f, reflected: vec3f, mean: vec3f, half_difference: vec3f) -> Stokes {
    let passed = max(1.0 - mean, vec3f(0.0));
    return Stokes(
        behind.i + reflected - half_difference * behind.q,
        passed * behind.q + half_difference * (mirrored - behind.i),
        passed * behind.u,
    );
}
