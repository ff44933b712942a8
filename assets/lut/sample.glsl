// Linear BT.2020 colour that a film reflects of white light. `lut` holds the channels R, G, B of the EXR file as they are, filters linearly
// and clamps. cos_theta is that of the angle in air, 0 to 1; thickness_nm 0 to LUT_MAX_NM.
const vec2 LUT_SIZE = vec2(@COLUMNS@.0, @ROWS@.0);
const float LUT_MAX_NM = @MAX_NM@;
const float LUT_INDEX = @INDEX@;

vec3 film_reflection(sampler2D lut, float cos_theta, float thickness_nm) {
    float cos_t = sqrt(1.0 - (1.0 - cos_theta * cos_theta) / (LUT_INDEX * LUT_INDEX));
    float r_s = (cos_theta - LUT_INDEX * cos_t) / (cos_theta + LUT_INDEX * cos_t);
    float r_p = (LUT_INDEX * cos_theta - cos_t) / (LUT_INDEX * cos_theta + cos_t);
    float peak_s = 2.0 * r_s / (1.0 + r_s * r_s);
    float peak_p = 2.0 * r_p / (1.0 + r_p * r_p);
    float path = 1.5 * thickness_nm * cos_t / LUT_MAX_NM;
    float row = 2.0 * path / (0.5 + sqrt(0.25 + 4.0 * path));
    vec2 uv = (vec2(sqrt(cos_theta), row) * (LUT_SIZE - 1.0) + 0.5) / LUT_SIZE;
    return 0.5 * (peak_s * peak_s + peak_p * peak_p) * textureLod(lut, uv, 0.0).rgb;
}
