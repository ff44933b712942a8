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

// Factors on the steps E0 - B, E1 - B, E2 - E1 and E3 - E2, from the reflectances at four hits.
fn step_factors(r: vec4f) -> vec4f {
    let through = (1.0 - r.x) * r.y;
    let factors = vec4f(r.x, through, through * r.z, through * r.z * r.w);
    if (EVERYTHING == 1u) {
        return factors;
    }
    return factors - vec4f(r.x, r.y, 0.0, 0.0);
}

// Factors on the next four steps, from the factor before them and the next four hits.
fn deep_factors(before: f32, r: vec4f) -> vec4f {
    let first = before * r.x;
    let second = first * r.y;
    let third = second * r.z;
    return vec4f(first, second, third, third * r.w);
}

// One band's part of L - B, in light of that band; the steps are columns.
fn band_radiance(band: Band, cos_theta: f32, walls_nm: vec4f, steps: mat4x3f, polarisation: vec2f) -> vec3f {
    let r = film_reflectances(band.index, cos_theta, walls_nm, band.wavelength_nm);
    let factors = polarisation.x * step_factors(r.s) + polarisation.y * step_factors(r.p);
    return band.response * (steps * factors);
}

// The same with four more inner reflections.
fn deep_band_radiance(
    band: Band,
    cos_theta: f32,
    walls_nm: vec4f,
    steps: mat4x3f,
    deep_nm: vec4f,
    deep_steps: mat4x3f,
    polarisation: vec2f,
) -> vec3f {
    let r = film_reflectances(band.index, cos_theta, walls_nm, band.wavelength_nm);
    let deep = film_reflectances(band.index, cos_theta, deep_nm, band.wavelength_nm);
    let s = step_factors(r.s);
    let p = step_factors(r.p);
    let more = polarisation.x * deep_factors(s.w, deep.s) + polarisation.y * deep_factors(p.w, deep.p);
    return band.response * (steps * (polarisation.x * s + polarisation.y * p) + deep_steps * more);
}
