// What stands behind everything: one colour, or the environment itself.

import package::camera::view::{View, view_ray, pixel_angle};
import package::light::environment::{Light, backdrop_radiance};
import package::light::lamps::Lamp;
import package::light::stored::storable;
import package::light::water::{crossing, upward};

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var backdrop_map: texture_cube<f32>;
@group(0) @binding(3) var backdrop_sampler: sampler;
@group(0) @binding(4) var<uniform> lamps: array<Lamp, 12>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn backdrop(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let ray = view_ray(view, position.xy);
    let behind = backdrop_radiance(backdrop_map, backdrop_sampler, light, upward(ray), pixel_angle(view, ray));
    return vec4f(storable(light.seen * (crossing(1.0, ray.z, ray) * behind)), 1.0);
}
