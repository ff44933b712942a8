// Bakes the lookup table of what single walls reflect: for each texel the sum over the light's spectrum, divided by the
// greatest reflectance at its angle so that interpolation and rounding spend their precision where the eye does. Layers: what is seen of
// white light, or of each primary; of s and p light together, or first of s and then of p.

import package::optics::airy::{Reflectances, damped_reflectances, film_reflectances, max_reflectance, n_cos_refracted};
import package::optics::quadrature::QuadratureSample;
import package::optics::table::{TableAxes, film_of_texel};

// As in optics/film_colour.wgsl.
override COLOURED: u32;
override POLARISED: u32;
// 1: some film of the table has fringes too narrow for the samples of the spectrum.
override FADES: u32;

// Mirrors `BakeUniform` in src/gpu/passes/bake_table.rs.
struct Bake {
    axes: TableAxes,
    first_row: u32,
    // Phase, in radians, by which fringes may move from one sample of the spectrum to the next without losing contrast.
    resolved_step: f32,
    // Number of samples in use; the rest are zero.
    wavelengths: u32,
}

@group(0) @binding(0) var<uniform> bake: Bake;
@group(0) @binding(1) var<uniform> samples: array<QuadratureSample, 512>;
@group(0) @binding(2) var table: texture_storage_2d_array<rgba32float, write>;

const TAU: f32 = 6.2831853;

// Rows that an invocation bakes: four, as vectors have it. They share their angle, and so most of the work.
override ROWS: u32;

// What is seen of light that the films of these rows reflect, a column each: of each primary, or of white light as `red`.
struct Seen {
    red: mat4x3f,
    green: mat4x3f,
    blue: mat4x3f,
}

fn add(seen: ptr<function, Seen>, response: mat3x3f, reflectances: vec4f) {
    if (COLOURED == 0u) {
        (*seen).red += outer(response[0] + response[1] + response[2], reflectances);
        return;
    }
    (*seen).red += outer(response[0], reflectances);
    (*seen).green += outer(response[1], reflectances);
    (*seen).blue += outer(response[2], reflectances);
}

fn outer(colour: vec3f, factors: vec4f) -> mat4x3f {
    return mat4x3f(colour * factors.x, colour * factors.y, colour * factors.z, colour * factors.w);
}

fn store(texel: vec2u, first: u32, seen: mat4x3f) {
    textureStore(table, texel, first, vec4f(seen[0], 1.0));
    textureStore(table, texel + vec2u(0u, 1u), first, vec4f(seen[1], 1.0));
    textureStore(table, texel + vec2u(0u, 2u), first, vec4f(seen[2], 1.0));
    textureStore(table, texel + vec2u(0u, 3u), first, vec4f(seen[3], 1.0));
}

fn store_all(texel: vec2u, first: u32, scale: f32, seen: Seen) {
    store(texel, first, scale * seen.red);
    if (COLOURED == 1u) {
        store(texel, first + 1u, scale * seen.green);
        store(texel, first + 2u, scale * seen.blue);
    }
}

// Reflectances of the part of the spectrum that a sample stands for. Fringes that move by much of a turn within it fade to their mean before
// sums over samples would show them as colours that are not there.
fn sample_reflectances(sample: QuadratureSample, cos_theta: f32, thickness_nm: vec4f) -> Reflectances {
    if (FADES == 0u) {
        return film_reflectances(sample.index, cos_theta, thickness_nm, sample.wavelength_nm);
    }
    let turns = 2.0 * n_cos_refracted(sample.index, cos_theta) / sample.wavelength_nm * thickness_nm;
    let excess = max(TAU * sample.width_nm / sample.wavelength_nm * turns - bake.resolved_step, vec4f(0.0));
    let coherence = exp(-excess * excess);
    return damped_reflectances(sample.index, cos_theta, thickness_nm, sample.wavelength_nm, coherence);
}

@compute @workgroup_size(64)
fn bake_table(@builtin(global_invocation_id) id: vec3u) {
    let texel = vec2u(id.x, bake.first_row + ROWS * id.y);
    if (any(texel >= vec2u(bake.axes.size))) {
        return;
    }
    // Rows beyond the last are stored nowhere.
    let row = vec2f(0.0, 1.0);
    let film = film_of_texel(bake.axes, vec2f(texel));
    let thickness_nm = vec4f(
        film.thickness_nm,
        film_of_texel(bake.axes, vec2f(texel) + row).thickness_nm,
        film_of_texel(bake.axes, vec2f(texel) + 2.0 * row).thickness_nm,
        film_of_texel(bake.axes, vec2f(texel) + 3.0 * row).thickness_nm,
    );
    var s: Seen;
    var p: Seen;
    for (var k = 0u; k < bake.wavelengths; k++) {
        let r = sample_reflectances(samples[k], film.cos_theta, thickness_nm);
        if (POLARISED == 1u) {
            add(&s, samples[k].response, r.s);
            add(&p, samples[k].response, r.p);
        } else {
            add(&s, samples[k].response, 0.5 * (r.s + r.p));
        }
    }
    // A film of index 1 reflects nothing, and nothing divided by the floor stays nothing.
    let scale = 1.0 / max(max_reflectance(bake.axes.index, film.cos_theta), 1e-30);
    store_all(texel, 0u, scale, s);
    if (POLARISED == 1u) {
        store_all(texel, select(1u, 3u, COLOURED == 1u), scale, p);
    }
}
