// Bakes the lookup table of what single walls reflect: for each texel the spectral sum over all wavelengths of the light, divided by the
// greatest reflectance at its angle so that half floats and filtering spend their precision where the eye does. Layers: what is seen of
// white light, or of each primary; of s and p light together, or first of s and then of p.

import package::optics::airy::{damped_reflectance, film_reflectance, max_reflectance, n_cos_refracted};
import package::optics::quadrature::QuadratureSample;
import package::optics::table::{FilmPoint, TableAxes, film_of_texel};

// As in optics/film_colour.wgsl.
override COLOURED: u32;
override POLARISED: u32;

// Mirrors `BakeUniform` in src/gpu/passes/bake_table.rs.
struct Bake {
    axes: TableAxes,
    first_row: u32,
}

@group(0) @binding(0) var<uniform> bake: Bake;
@group(0) @binding(1) var<storage, read> samples: array<QuadratureSample>;
@group(0) @binding(2) var table: texture_storage_2d_array<rgba16float, write>;

const TAU: f32 = 6.2831853;

// Response to each primary, or to all three together.
fn store(texel: vec2u, first: u32, seen: mat3x3f) {
    if (COLOURED == 0u) {
        textureStore(table, texel, first, vec4f(seen[0] + seen[1] + seen[2], 1.0));
        return;
    }
    for (var k = 0u; k < 3u; k++) {
        textureStore(table, texel, first + k, vec4f(seen[k], 1.0));
    }
}

// Phase, in radians, by which fringes may move from one sample of the spectrum to the next without losing contrast: films of 1.5 um.
const RESOLVED_STEP: f32 = 0.2;

// (R_s, R_p) of the part of the spectrum that a sample stands for. Fringes that move by much of a turn within it fade to their mean before
// sums over samples would show them as colours that are not there.
fn sample_reflectance(sample: QuadratureSample, film: FilmPoint) -> vec2f {
    let path_nm = 2.0 * n_cos_refracted(sample.index, film.cos_theta) * film.thickness_nm;
    let step = TAU * path_nm / sample.wavelength_nm * (sample.width_nm / sample.wavelength_nm);
    if (step <= RESOLVED_STEP) {
        return film_reflectance(sample.index, film.cos_theta, film.thickness_nm, sample.wavelength_nm);
    }
    let excess = (step - RESOLVED_STEP) * (step - RESOLVED_STEP);
    let coherence = exp(-excess * excess);
    return damped_reflectance(sample.index, film.cos_theta, film.thickness_nm, sample.wavelength_nm, coherence);
}

@compute @workgroup_size(64)
fn bake_table(@builtin(global_invocation_id) id: vec3u) {
    let texel = vec2u(id.x, bake.first_row + id.y);
    if (any(texel >= vec2u(bake.axes.size))) {
        return;
    }
    let film = film_of_texel(bake.axes, vec2f(texel));
    var s = mat3x3f();
    var p = mat3x3f();
    for (var k = 0u; k < arrayLength(&samples); k++) {
        let r = sample_reflectance(samples[k], film);
        if (POLARISED == 1u) {
            s += r.x * samples[k].response;
            p += r.y * samples[k].response;
        } else {
            s += (0.5 * (r.x + r.y)) * samples[k].response;
        }
    }
    // A film of index 1 reflects nothing, and nothing divided by the floor stays nothing.
    let scale = 1.0 / max(max_reflectance(bake.axes.index, film.cos_theta), 1e-30);
    store(texel, 0u, scale * s);
    if (POLARISED == 1u) {
        store(texel, select(1u, 3u, COLOURED == 1u), scale * p);
    }
}
