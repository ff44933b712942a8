// Light adds up: the sum of the linear pictures of a scene in two lights.

import package::light::stored::storable;

@group(0) @binding(0) var first: texture_2d<f32>;
@group(0) @binding(1) var second: texture_2d<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn add_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    return vec4f(storable(textureLoad(first, pixel, 0).rgb + textureLoad(second, pixel, 0).rgb), 1.0);
}
