// A photograph behind the bubbles: what they leave of it, channel by channel, and what they add. The f64 truth is `radiance` in
// src/verify/reference.rs.

import package::camera::view::{View, view_ray};
import package::light::stored::storable;
import package::light::water::crossing;

// Mirrors `PlateUniform` in src/gpu/passes/lay_plate.rs.
struct Laying {
    // From linear BT.2020 to BT.709, in which the photograph is, and back.
    to_plate: mat3x3f,
    from_plate: mat3x3f,
    // What is seen of white light from behind where there are no bubbles, linear BT.709.
    white: vec3f,
    // Factor on the photograph: exposure of the linear picture.
    exposure: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> laying: Laying;
@group(0) @binding(2) var added: texture_2d<f32>;
@group(0) @binding(3) var through: texture_2d<f32>;
@group(0) @binding(4) var plate: texture_2d<f32>;

// Channels of white light below this part of the strongest tell nothing.
const FAINT: f32 = 0.05;

// The part of white light that is left in each channel: `transmittance` in src/physics/colour/transmittance.rs.
fn transmittance(left: vec3f, white: vec3f) -> vec3f {
    let of_sum = dot(left, vec3f(1.0)) / dot(white, vec3f(1.0));
    let faint = FAINT * max(white.r, max(white.g, white.b));
    return select(vec3f(of_sum), left / white, white > vec3f(faint));
}

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn lay_plate(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let ray = view_ray(view, position.xy);
    // A bath dims white light too: what stands behind it is its own picture, not what it mirrors.
    let white = crossing(1.0, ray.z, ray) * laying.white;
    let left = transmittance(laying.to_plate * textureLoad(through, pixel, 0).rgb, white);
    let behind = laying.exposure * (laying.from_plate * (left * textureLoad(plate, pixel, 0).rgb));
    return vec4f(storable(textureLoad(added, pixel, 0).rgb + behind), 1.0);
}
