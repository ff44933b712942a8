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

import package::optics::airy::{Reflectances, damped_reflectances, film_reflectances, n_cos_refracted};
import package::optics::quadrature::QuadratureSample;
import package::optics::film_colour::THICKNESSES;
import package::optics::shares::{s_of_colour, share_of_s};

// 1: the quadrature gives everything. 0: it gives the products, and single walls come from the table.
override EVERYTHING: u32;
// How many wavelengths there are. 0: products are products of the table's colours.
override WAVELENGTHS: u32;
// Inner reflections that are followed: 1, 3, 7 or 11.
override INNER: u32;
// 1: light from outside may be polarised, as other bubbles make it that are seen in the first two walls.
override MIRRORS_OTHERS: u32;
// 1: light from behind may be polarised, as bubbles there leave it, and what is polarised of the picture is kept for bubbles in front.
override TRACKS_POLARISATION: u32;
// 1: there are films that the wavelengths are too few for.
override THICK: u32;

// Four hits in a row, and the steps of light that their reflectances are factors on, as columns.
struct Hits {
    walls_nm: vec4f,
    // Width of the thicknesses that the sample spans at each hit, in nm; read where THICKNESSES is more than 1.
    spread_nm: vec4f,
    steps: mat4x3f,
}

// Hits beyond the eleventh inner reflection, where light that grazes the film still has a part left.
const FURTHER: u32 = 12u;

// All hits of a ray. The first four steps are E0 - B, E1 - B, E2 - E1 and E3 - E2; where INNER is 3 or 7 the later hits are not read.
struct Walls {
    first: Hits,
    second: Hits,
    third: Hits,
    // By how much more the first four steps are of s light than of p light; read where MIRRORS_OTHERS or TRACKS_POLARISATION is 1.
    polarised: mat4x3f,
    // Steps of light at further hits, where the film is taken to be as thick as at the last one: at grazing they lie close together.
    further: array<vec3f, 12>,
}

// L - B from colours: an approximation for films that reflect little, white light and no polariser. `colours` are those of the first four
// walls over white, in BT.2020's primaries, mean of s and p: columns that multiply light as the reflectances of one wavelength do.
fn product_of_colours(n: f32, cos_theta: f32, colours: mat4x3f, steps: mat4x3f) -> vec3f {
    let share = share_of_s(n, cos_theta);
    let s0 = s_of_colour(colours[0], share);
    let s1 = s_of_colour(colours[1], share);
    var s = max(1.0 - s0, vec3f(0.0)) * s1;
    var p = max(1.0 - 2.0 * colours[0] + s0, vec3f(0.0)) * (2.0 * colours[1] - s1);
    var light = steps[0] * colours[0] + 0.5 * steps[1] * (s + p);
    if (INNER > 1u) {
        let s2 = s_of_colour(colours[2], share);
        s *= s2;
        p *= 2.0 * colours[2] - s2;
        light += 0.5 * steps[2] * (s + p);
        let s3 = s_of_colour(colours[3], share);
        s *= s3;
        p *= 2.0 * colours[3] - s3;
        light += 0.5 * steps[3] * (s + p);
    }
    return light;
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

// Walls whose products the wavelengths resolve. White light shows fringes of thin walls, and of the difference between two walls however thick
// (Brewster's fringes); where walls, or no wall and the thinnest, are further apart than any of these fringes reach, it shows none, and
// such a gap is closed up to `gap_nm`. What no fringe can tell apart stays so, and thickness stays continuous.
fn resolved(walls: Walls, gap_nm: f32) -> Walls {
    if (THICK == 0u) {
        return walls;
    }
    let levels = sorted(walls.first.walls_nm);
    var thinner = walls;
    thinner.first.walls_nm = closed_up(walls.first.walls_nm, levels, gap_nm);
    thinner.second.walls_nm = closed_up(walls.second.walls_nm, levels, gap_nm);
    thinner.third.walls_nm = closed_up(walls.third.walls_nm, levels, gap_nm);
    return thinner;
}

// Thicknesses without what lies more than `gap_nm` above the next of the levels, which rise, or above zero.
fn closed_up(nm: vec4f, levels: vec4f, gap_nm: f32) -> vec4f {
    let kept_nm = min(vec4f(levels.yzw - levels.xyz, gap_nm), vec4f(gap_nm));
    var thinner_nm = min(nm, vec4f(min(levels.x, gap_nm)));
    for (var k = 0u; k < 4u; k++) {
        thinner_nm += clamp(nm - levels[k], vec4f(0.0), vec4f(kept_nm[k]));
    }
    return thinner_nm;
}

// The same numbers, rising.
fn sorted(numbers: vec4f) -> vec4f {
    let low = min(numbers.xz, numbers.yw);
    let high = max(numbers.xz, numbers.yw);
    let inner = vec2f(max(low.x, low.y), min(high.x, high.y));
    return vec4f(min(low.x, low.y), min(inner.x, inner.y), max(inner.x, inner.y), max(high.x, high.y));
}

// Reflectances at four hits.
fn wall_reflectances(sample: QuadratureSample, cos_theta: f32, hits: Hits) -> Reflectances {
    if (THICKNESSES == 1u) {
        return film_reflectances(sample.index, cos_theta, hits.walls_nm, sample.wavelength_nm);
    }
    // Of a Gaussian as wide as the box of thicknesses: its variance is w^2 / 12, and contrast falls by exp(-delta^2 / 2).
    let turns = 2.0 * n_cos_refracted(sample.index, cos_theta) / sample.wavelength_nm * hits.spread_nm;
    let coherence = exp(-1.645 * turns * turns);
    return damped_reflectances(sample.index, cos_theta, hits.walls_nm, sample.wavelength_nm, coherence);
}

// The part of L - B at one wavelength, in light of that wavelength.
fn wavelength_radiance(sample: QuadratureSample, cos_theta: f32, walls: Walls, polarisation: vec2f) -> vec3f {
    let r = wall_reflectances(sample, cos_theta, walls.first);
    var s = polarisation.x * first_factors(r.s);
    var p = polarisation.y * first_factors(r.p);
    var light = walls.first.steps * (s + p - polarisation.x * table_factors(r.s) - polarisation.y * table_factors(r.p));
    if (MIRRORS_OTHERS == 1u || TRACKS_POLARISATION == 1u) {
        light += walls.polarised * (s - p);
    }
    if (INNER > 3u) {
        let r = wall_reflectances(sample, cos_theta, walls.second);
        s = later_factors(s.w, r.s);
        p = later_factors(p.w, r.p);
        light += walls.second.steps * (s + p);
    }
    if (INNER > 7u) {
        let r = wall_reflectances(sample, cos_theta, walls.third);
        s = later_factors(s.w, r.s);
        p = later_factors(p.w, r.p);
        light += walls.third.steps * (s + p);
        var left = vec2f(s.w, p.w);
        for (var k = 0u; k < FURTHER; k++) {
            left *= vec2f(r.s.w, r.p.w);
            light += walls.further[k] * (left.x + left.y);
        }
    }
    return sample.response * light;
}

// What walls do to polarised light from behind at one wavelength, and what they polarise, as changes of Stokes' parameters q and u along the plane of
// incidence. `turned` is u of the light from behind. Of the hits the first four count: later ones, near grazing, reflect s and p light alike.
fn wavelength_polarisation(sample: QuadratureSample, cos_theta: f32, walls: Walls, turned: vec3f) -> mat2x3f {
    let r = wall_reflectances(sample, cos_theta, walls.first);
    let s = 0.5 * first_factors(r.s);
    let p = 0.5 * first_factors(r.p);
    let q = walls.first.steps * (s - p) + walls.polarised * (s + p);
    // s and p light that pass a film stay nearly in phase.
    let u = -turned * (s.x + p.x + s.y + p.y);
    return mat2x3f(sample.response * q, sample.response * u);
}
