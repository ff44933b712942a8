// What a lens and a film do to the linear picture before it is shown: glare, vignetting, grain. What they are stands in
// `physics/picture/finish.rs`.

import package::colour::display::{hash, uniform_of};

// Mirrors `FinishUniform` in src/gpu/passes/finish.rs.
struct Finish {
    // Part of light that goes to this level of glare, or of all levels.
    share: f32,
    // 1: a coarser level is added. 0: there is none.
    coarser: f32,
    // Stops that the corners lose.
    vignetting_ev: f32,
    // Grain of a radiance that is exposed as 1, relative.
    grain: f32,
    // Factor that exposes the picture.
    exposure: f32,
    grain_seed: u32,
}

// The largest half float.
const MAX_HALF: f32 = 65504.0;

@group(0) @binding(0) var<uniform> finish: Finish;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var halves: texture_2d<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn at_pixel(level: texture_2d<f32>, pixel: vec2i) -> vec4f {
    let last = vec2i(textureDimensions(level)) - 1;
    return textureLoad(level, clamp(pixel, vec2i(0), last), 0);
}

// The picture at half its size: weights 1, 3, 3, 1 along each axis.
@fragment
fn halved(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let corner = 2 * vec2i(position.xy) - 1;
    var sum = vec4f(0.0);
    for (var k = 0; k < 16; k++) {
        let tap = vec2i(k % 4, k / 4);
        let inner = vec2i((tap + 1) / 2 % 2);
        sum += f32((1 + 2 * inner.x) * (1 + 2 * inner.y)) * at_pixel(picture, corner + tap);
    }
    return sum / 64.0;
}

// The halves at twice their size, interpolated.
fn doubled(position: vec2f) -> vec4f {
    let place = 0.5 * position - 0.5;
    let corner = vec2i(floor(place));
    let weight = fract(place);
    let above = mix(at_pixel(halves, corner), at_pixel(halves, corner + vec2i(1, 0)), weight.x);
    let below = mix(at_pixel(halves, corner + vec2i(0, 1)), at_pixel(halves, corner + vec2i(1, 1)), weight.x);
    return mix(above, below, weight.y);
}

// A level's share, with those of all coarser ones.
@fragment
fn spread(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let own = finish.share * textureLoad(picture, vec2i(position.xy), 0);
    return own + finish.coarser * doubled(position.xy);
}

// About normal, of variance 1.
fn normal_noise(pixel: vec2u) -> f32 {
    var bits = hash(pixel.x + hash(pixel.y + hash(finish.grain_seed)));
    var sum = 0.0;
    for (var k = 0; k < 4; k++) {
        sum += uniform_of(bits) - 0.5;
        bits = hash(bits);
    }
    return 1.7320508 * sum;
}

@fragment
fn finished(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let sharp = textureLoad(picture, vec2i(position.xy), 0);
    let lit = (1.0 - finish.share) * sharp.rgb + finish.coarser * doubled(position.xy).rgb;
    let size = vec2f(textureDimensions(picture));
    let out = (position.xy - 0.5 * size) / length(0.5 * size);
    let passed = exp2(-finish.vignetting_ev * dot(out, out)) * lit;
    // Of the luminance of BT.2020: the eye forgives grey grain most.
    let exposed = max(finish.exposure * dot(passed, vec3f(0.2627, 0.678, 0.0593)), 1e-3);
    let grained = max(1.0 + finish.grain * normal_noise(vec2u(position.xy)) / sqrt(exposed), 0.0);
    return vec4f(min(grained * passed, vec3f(MAX_HALF)), sharp.a);
}
