// Linear BT.2020 colour that a soap film reflects of white light. `lut_sampler` filters linearly and clamps. cos_theta is the cosine of the
// angle in air, 0 to 1; thickness_nm is 0 to LUT_MAX_NM.
const LUT_SIZE: vec2f = vec2f(@COLUMNS@.0, @ROWS@.0);
const LUT_MAX_NM: f32 = @MAX_NM@;
const LUT_INDEX: f32 = @INDEX@;
// Set to 1.0 if the loader turned the rows over, so that the file's first row is at v = 1.
const LUT_TURNED: f32 = 0.0;

// cos_theta in the range of the table.
fn film_cos(cos_theta: f32) -> f32 {
    return clamp(cos_theta, 0.0, 1.0);
}

// Cosine of the angle inside the film.
fn film_cos_inside(c: f32) -> f32 {
    return sqrt(1.0 - (1.0 - c * c) / (LUT_INDEX * LUT_INDEX));
}

// The most that a film reflects at this angle; the table's values are parts of it.
fn film_max_reflectance(cos_theta: f32) -> f32 {
    let c = film_cos(cos_theta);
    let cos_t = film_cos_inside(c);
    let r_s = (c - LUT_INDEX * cos_t) / max(c + LUT_INDEX * cos_t, 1e-6);
    let r_p = (LUT_INDEX * c - cos_t) / max(LUT_INDEX * c + cos_t, 1e-6);
    let peak_s = 2.0 * r_s / (1.0 + r_s * r_s);
    let peak_p = 2.0 * r_p / (1.0 + r_p * r_p);
    return 0.5 * (peak_s * peak_s + peak_p * peak_p);
}

// Texture coordinates of a film.
fn film_uv(cos_theta: f32, thickness_nm: f32) -> vec2f {
    let c = film_cos(cos_theta);
    let path = 1.5 * max(thickness_nm, 0.0) * film_cos_inside(c) / LUT_MAX_NM;
    let row = min(2.0 * path / (0.5 + sqrt(0.25 + 4.0 * path)), 1.0);
    let uv = (vec2f(sqrt(c), row) * (LUT_SIZE - 1.0) + 0.5) / LUT_SIZE;
    return vec2f(uv.x, mix(uv.y, 1.0 - uv.y, LUT_TURNED));
}

// In unpolarised light. `lut` holds the EXR file's channels R, G, B (or s.R, s.G, s.B or p.R, p.G, p.B for light of one polarisation).
fn film_reflection(lut: texture_2d<f32>, lut_sampler: sampler, cos_theta: f32, thickness_nm: f32) -> vec3f {
    let part = textureSampleLevel(lut, lut_sampler, film_uv(cos_theta, thickness_nm), 0.0).rgb;
    return film_max_reflectance(cos_theta) * part;
}

// Samples the array texture of a .ktx2 or .bin file. Layer 0 is for unpolarised light, 1 for s, 2 for p.
fn film_reflection_of_layer(lut: texture_2d_array<f32>, lut_sampler: sampler, layer: i32, cos_theta: f32, thickness_nm: f32) -> vec3f {
    let part = textureSampleLevel(lut, lut_sampler, film_uv(cos_theta, thickness_nm), layer, 0.0).rgb;
    return film_max_reflectance(cos_theta) * part;
}
