// Linear BT.2020 colour that a soap film reflects of white light. `lut_sampler` filters linearly and clamps. cos_theta is the cosine of the
// angle in air, 0 to 1; thickness_nm is 0 to LUT_MAX_NM.
#include <metal_stdlib>
using namespace metal;

constant float2 LUT_SIZE = float2(@COLUMNS@.0, @ROWS@.0);
constant float LUT_MAX_NM = @MAX_NM@;
constant float LUT_INDEX = @INDEX@;
// Set to 1.0 if the loader turned the rows over, so that the file's first row is at v = 1.
constant float LUT_TURNED = 0.0;

// cos_theta in the range of the table.
float film_cos(float cos_theta) {
    return clamp(cos_theta, 0.0, 1.0);
}

// Cosine of the angle inside the film.
float film_cos_inside(float c) {
    return sqrt(1.0 - (1.0 - c * c) / (LUT_INDEX * LUT_INDEX));
}

// The most that a film reflects at this angle; the table's values are parts of it.
float film_max_reflectance(float cos_theta) {
    float c = film_cos(cos_theta);
    float cos_t = film_cos_inside(c);
    float r_s = (c - LUT_INDEX * cos_t) / max(c + LUT_INDEX * cos_t, 1e-6);
    float r_p = (LUT_INDEX * c - cos_t) / max(LUT_INDEX * c + cos_t, 1e-6);
    float peak_s = 2.0 * r_s / (1.0 + r_s * r_s);
    float peak_p = 2.0 * r_p / (1.0 + r_p * r_p);
    return 0.5 * (peak_s * peak_s + peak_p * peak_p);
}

// Texture coordinates of a film.
float2 film_uv(float cos_theta, float thickness_nm) {
    float c = film_cos(cos_theta);
    float path = 1.5 * max(thickness_nm, 0.0) * film_cos_inside(c) / LUT_MAX_NM;
    float row = min(2.0 * path / (0.5 + sqrt(0.25 + 4.0 * path)), 1.0);
    float2 uv = (float2(sqrt(c), row) * (LUT_SIZE - 1.0) + 0.5) / LUT_SIZE;
    return float2(uv.x, mix(uv.y, 1.0 - uv.y, LUT_TURNED));
}

// In unpolarised light. `lut` holds the EXR file's channels R, G, B (or s.R, s.G, s.B or p.R, p.G, p.B for light of one polarisation).
float3 film_reflection(texture2d<float> lut, sampler lut_sampler, float cos_theta, float thickness_nm) {
    float3 part = lut.sample(lut_sampler, film_uv(cos_theta, thickness_nm), level(0.0)).rgb;
    return film_max_reflectance(cos_theta) * part;
}

// Samples the array texture of a .ktx2 or .bin file. Layer 0 is for unpolarised light, 1 for s, 2 for p.
float3 film_reflection_of_layer(texture2d_array<float> lut, sampler lut_sampler, uint layer, float cos_theta, float thickness_nm) {
    float3 part = lut.sample(lut_sampler, film_uv(cos_theta, thickness_nm), layer, level(0.0)).rgb;
    return film_max_reflectance(cos_theta) * part;
}
