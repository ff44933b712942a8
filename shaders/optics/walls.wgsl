// Composition of the walls that one ray meets. On a sphere every hit has the same angle and the same plane of incidence,
// so s and p light never mix and each wall multiplies them separately.

import package::optics::film_colour::Polarised;

fn scaled(a: Polarised, k: vec3f) -> Polarised {
    return Polarised(a.s * k, a.p * k);
}

fn sum(a: Polarised, b: Polarised) -> Polarised {
    return Polarised(a.s + b.s, a.p + b.p);
}

fn product(a: Polarised, b: Polarised) -> Polarised {
    return Polarised(a.s * b.s, a.p * b.p);
}

// What a wall lets through: T = 1 - R, a film absorbs nothing.
fn transmitted(reflected: Polarised) -> Polarised {
    return Polarised(1.0 - reflected.s, 1.0 - reflected.p);
}

fn unpolarised(a: Polarised) -> vec3f {
    return 0.5 * (a.s + a.p);
}
