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

// Factors on the steps E0 - B, E1 - B and E2 - E1.
fn step_factors(r: vec3f) -> vec3f {
    let through = (1.0 - r.x) * r.y;
    if (EVERYTHING == 1u) {
        return vec3f(r.x, through, through * r.z);
    }
    return vec3f(0.0, through - r.y, through * r.z);
}

// Factors on the steps E3 - E2, E4 - E3 and E5 - E4, from the factor before them.
fn deep_factors(before: f32, r: vec3f) -> vec3f {
    return before * vec3f(r.x, r.x * r.y, r.x * r.y * r.z);
}

// One band's part of L - B, in light of that band: steps are the columns E0 - B, E1 - B, E2 - E1.
fn band_radiance(band: Band, cos_theta: f32, walls_nm: vec3f, steps: mat3x3f, polarisation: vec2f) -> vec3f {
    let r = film_reflectances(band.index, cos_theta, walls_nm, band.wavelength_nm);
    let factors = polarisation.x * step_factors(r.s) + polarisation.y * step_factors(r.p);
    return band.response * (steps * factors);
}

// The same for three more inner reflections, whose light matters at the rim alone.
fn deep_band_radiance(
    band: Band,
    cos_theta: f32,
    walls_nm: vec3f,
    deep_nm: vec3f,
    deep_steps: mat3x3f,
    polarisation: vec2f,
) -> vec3f {
    let near = film_reflectances(band.index, cos_theta, walls_nm, band.wavelength_nm);
    let far = film_reflectances(band.index, cos_theta, deep_nm, band.wavelength_nm);
    let factors = polarisation.x * deep_factors(step_factors(near.s).z, far.s)
        + polarisation.y * deep_factors(step_factors(near.p).z, far.p);
    return band.response * (deep_steps * factors);
}
