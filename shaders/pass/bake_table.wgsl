// Bakes the lookup table of film colours: for each texel the spectral sum over 421 wavelengths, one layer a polarisation,
// divided by the greatest reflectance at its angle so that half floats and filtering spend their precision where the eye does.

import package::optics::airy::{film_reflectance, max_reflectance};
import package::optics::table::{TableAxes, film_of_texel};

// One wavelength. Mirrors `SpectralSample` in src/gpu/bake_table.rs.
struct SpectralSample {
    // Linear BT.2020 colour that a perfect mirror would reflect of this wavelength's share of the light.
    colour: vec3f,
    // Refractive index of the film.
    index: f32,
}

// Mirrors `BakeUniform` in src/gpu/bake_table.rs.
struct Bake {
    axes: TableAxes,
    first_row: u32,
    first_wavelength_nm: f32,
    wavelength_step_nm: f32,
}

@group(0) @binding(0) var<uniform> bake: Bake;
@group(0) @binding(1) var<storage, read> samples: array<SpectralSample>;
@group(0) @binding(2) var table: texture_storage_2d_array<rgba16float, write>;

@compute @workgroup_size(64)
fn bake_table(@builtin(global_invocation_id) id: vec3u) {
    let texel = vec2u(id.x, bake.first_row + id.y);
    if (any(texel >= vec2u(bake.axes.size))) {
        return;
    }
    let film = film_of_texel(bake.axes, vec2f(texel));
    var s = vec3f(0.0);
    var p = vec3f(0.0);
    for (var k = 0u; k < arrayLength(&samples); k++) {
        let wavelength_nm = bake.first_wavelength_nm + f32(k) * bake.wavelength_step_nm;
        let r = film_reflectance(samples[k].index, film.cos_theta, film.thickness_nm, wavelength_nm);
        s += r.x * samples[k].colour;
        p += r.y * samples[k].colour;
    }
    let scale = max_reflectance(bake.axes.index, film.cos_theta);
    textureStore(table, texel, 0u, vec4f(s / scale, 1.0));
    textureStore(table, texel, 1u, vec4f(p / scale, 1.0));
}
