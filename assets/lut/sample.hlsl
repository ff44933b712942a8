// Linear BT.2020 colour that a film reflects of white light. `lut` holds the channels R, G, B of the EXR file as they are; `lut_sampler`
// filters linearly and clamps. cos_theta is that of the angle in air, 0 to 1; thickness_nm 0 to LUT_MAX_NM.
static const float2 LUT_SIZE = float2(@COLUMNS@.0, @ROWS@.0);
static const float LUT_MAX_NM = @MAX_NM@;
static const float LUT_INDEX = @INDEX@;

float3 film_reflection(Texture2D<float4> lut, SamplerState lut_sampler, float cos_theta, float thickness_nm) {
    float cos_t = sqrt(1.0 - (1.0 - cos_theta * cos_theta) / (LUT_INDEX * LUT_INDEX));
    float r_s = (cos_theta - LUT_INDEX * cos_t) / (cos_theta + LUT_INDEX * cos_t);
    float r_p = (LUT_INDEX * cos_theta - cos_t) / (LUT_INDEX * cos_theta + cos_t);
    float peak_s = 2.0 * r_s / (1.0 + r_s * r_s);
    float peak_p = 2.0 * r_p / (1.0 + r_p * r_p);
    float path = 1.5 * thickness_nm * cos_t / LUT_MAX_NM;
    float row = 2.0 * path / (0.5 + sqrt(0.25 + 4.0 * path));
    float2 uv = (float2(sqrt(cos_theta), row) * (LUT_SIZE - 1.0) + 0.5) / LUT_SIZE;
    return 0.5 * (peak_s * peak_s + peak_p * peak_p) * lut.SampleLevel(lut_sampler, uv, 0.0).rgb;
}
