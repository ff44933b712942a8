// Composition of the walls that one ray meets. On a sphere every hit has the same angle and the same plane of incidence, so s and p
// light never mix and each wall multiplies them separately. With R0, R1, ... the reflectances at the hits in order and B, E0, E1, ... the
// radiance straight behind, along the outer reflection and after each inner one,
//
//   L = R0 E0 + T0 T1 B + T0 R1 T2 E1 + T0 R1 R2 T3 E2 + ...
//     = B + R0 (E0 - B) + T0 R1 ((E1 - B) + R2 ((E2 - E1) + R3 ((E3 - E2) + ...)))
//
// In the second form each new hit adds one product, what is cut off stays with the last direction, and in even light every step is zero:
// the bubble vanishes exactly. R0 (E0 - B) and R1 (E1 - B) are single walls, which a table can hold; the rest are products of
// reflectances, which must be formed wavelength by wavelength.

import package::optics::airy::{Reflectances, film_reflectances};
import package::optics::band::Band;

// 1: the sum over bands gives everything. 0: it gives the products, and single walls come from the table.
override EVERYTHING: u32;
// How many bands there are.
override BANDS: u32;
// Inner reflections that are followed: 3, 7 or 11.
override INNER: u32;

// Four hits in a row, and the steps of light that their reflectances are factors on, as columns.
struct Hits {
    walls_nm: vec4f,
    steps: mat4x3f,
}

// All hits of a ray. The first four steps are E0 - B, E1 - B, E2 - E1 and E3 - E2; where INNER is 3 or 7 the later hits are not read.
struct Walls {
    first: Hits,
    second: Hits,
    third: Hits,
}

// Factors on the first four steps, from the reflectances at the first four hits.
fn first_factors(r: vec4f) -> vec4f {
    let through = (1.0 - r.x) * r.y;
    return vec4f(r.x, through, through * r.z, through * r.z * r.w);
}

// Factors on the next four steps, from the factor before them and the next four hits.
fn later_factors(before: f32, r: vec4f) -> vec4f {
    let first = before * r.x;
    let second = first * r.y;
    let third = second * r.z;
    return vec4f(first, second, third, third * r.w);
}

// What the table gives of the first four.
fn table_factors(r: vec4f) -> vec4f {
    return select(vec4f(r.xy, 0.0, 0.0), vec4f(0.0), EVERYTHING == 1u);
}

// One band's part of L - B, in light of that band.
fn band_radiance(band: Band, cos_theta: f32, walls: Walls, polarisation: vec2f) -> vec3f {
    let r = film_reflectances(band.index, cos_theta, walls.first.walls_nm, band.wavelength_nm);
    var s = polarisation.x * first_factors(r.s);
    var p = polarisation.y * first_factors(r.p);
    var light = walls.first.steps * (s + p - polarisation.x * table_factors(r.s) - polarisation.y * table_factors(r.p));
    if (INNER > 3u) {
        let r = film_reflectances(band.index, cos_theta, walls.second.walls_nm, band.wavelength_nm);
        s = later_factors(s.w, r.s);
        p = later_factors(p.w, r.p);
        light += walls.second.steps * (s + p);
    }
    if (INNER > 7u) {
        let r = film_reflectances(band.index, cos_theta, walls.third.walls_nm, band.wavelength_nm);
        light += walls.third.steps * (later_factors(s.w, r.s) + later_factors(p.w, r.p));
    }
    return band.response * light;
}
