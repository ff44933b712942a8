// Linear BT.2020 colour that a film reflects of white light. `lut` holds the channels R, G, B of the EXR file as they are; `lut_sampler`
// filters linearly and clamps. cos_theta is that of the angle in air, 0 to 1; thickness_nm 0 to LUT_MAX_NM.
const LUT_SIZE: vec2f = vec2f(@COLUMNS@.0, @ROWS@.0);
const LUT_MAX_NM: f32 = @MAX_NM@;
const LUT_INDEX: f32 = @INDEX@;

fn film_reflection(lut: texture_2d<f32>, lut_sampler: sampler, cos_theta: f32, thickness_nm: f32) -> vec3f {
    let cos_t = sqrt(1.0 - (1.0 - cos_theta * cos_theta) / (LUT_INDEX * LUT_INDEX));
    let r_s = (cos_theta - LUT_INDEX * cos_t) / (cos_theta + LUT_INDEX * cos_t);
    let r_p = (LUT_INDEX * cos_theta - cos_t) / (LUT_INDEX * cos_theta + cos_t);
    let peak_s = 2.0 * r_s / (1.0 + r_s * r_s);
    let peak_p = 2.0 * r_p / (1.0 + r_p * r_p);
    let path = 1.5 * thickness_nm * cos_t / LUT_MAX_NM;
    let row = 2.0 * path / (0.5 + sqrt(0.25 + 4.0 * path));
    let uv = (vec2f(sqrt(cos_theta), row) * (LUT_SIZE - 1.0) + 0.5) / LUT_SIZE;
    return 0.5 * (peak_s * peak_s + peak_p * peak_p) * textureSampleLevel(lut, lut_sampler, uv, 0.0).rgb;
}
