// From scene radiance to what a display shows: exposure, tone curve, gamut, dither, sRGB encoding. Each happens once, here.

import package::colour::display::{dithered, encode_srgb, into_gamut, tone_curve};

// Mirrors `TonemapUniform` in src/gpu/passes/tonemap.rs.
struct Tonemap {
    // White balance, linear BT.2020.
    balance: mat3x3f,
    // From linear BT.2020 to the display's linear RGB.
    to_display: mat3x3f,
    // From the display's linear RGB to XYZ relative to its white, and back.
    to_xyz: mat3x3f,
    from_xyz: mat3x3f,
    // Factor on radiance, of which the linear picture has taken a part already.
    exposure: f32,
    // Seed of the dither; its amplitude in steps of the 8-bit display, 0 for none.
    dither_seed: u32,
    dither_steps: f32,
}

@group(0) @binding(0) var<uniform> tonemap: Tonemap;
@group(0) @binding(1) var radiance: texture_2d<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn tonemapped(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let exposed = tonemap.exposure * (tonemap.balance * textureLoad(radiance, pixel, 0).rgb);
    var toned = tone_curve(max(exposed, vec3f(0.0)));
    toned.linear = tonemap.to_display * toned.linear;
    let display = into_gamut(toned, tonemap.to_xyz, tonemap.from_xyz);
    return vec4f(dithered(encode_srgb(display), pixel, tonemap.dither_seed, tonemap.dither_steps), 1.0);
}
