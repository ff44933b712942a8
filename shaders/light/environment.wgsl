// The light around the bubble, and what stands straight behind it.

import package::light::lamps::lamps_radiance;

// Mirrors `LightUniform` in src/gpu/passes/backdrop.rs. All colours are linear BT.2020. Light is RGB that stands for a spectrum relative to the
// illuminant's (src/physics/colour/uplift.rs); the eye's response to it is a colour.
struct Light {
    // Factor on the environment's radiance.
    gain: vec3f,
    // Angle between neighbouring texels at the center of a face of the environment's finest level.
    texel_angle: f32,
    // Radiance of the backdrop where it is a colour.
    backdrop: vec3f,
    // The same angle as texel_angle, of the map that is seen behind the bubbles.
    backdrop_texel_angle: f32,
    // Factor that makes daylight's white (1, 1, 1), exposed as the linear picture is.
    scale: vec3f,
    // cos and sin of the environment's turn about the vertical are turn_cos here and turn_sin below.
    turn_cos: f32,
    // Direction along which the electric field passes a polariser before the camera.
    polariser: vec3f,
    turn_sin: f32,
    // Matrix from light to its colour under the illuminant, where daylight's white is (1, 1, 1), exposed like the linear picture.
    seen: mat3x3f,
    // The inverse: light that has a colour.
    unseen: mat3x3f,
    // Tangent of the half angle of the cones that the backdrop is spread over.
    defocus: f32,
}

// 1: the environment is seen behind the bubbles. 0: one colour.
override BACKDROP_IS_ENVIRONMENT: u32;

// Light from a direction, filtered over a cone of the given angle.
fn environment_radiance(
    environment: texture_cube<f32>,
    environment_sampler: sampler,
    light: Light,
    direction: vec3f,
    footprint: f32,
) -> vec3f {
    let turned = in_environment(light, direction);
    let far = map_radiance(environment, environment_sampler, light, turned, footprint);
    return light.gain * (far + lamps_radiance(turned, 0.0, footprint));
}

// The map's part of that, before the gain, from a direction in the environment's own axes.
fn map_radiance(
    environment: texture_cube<f32>,
    environment_sampler: sampler,
    light: Light,
    turned: vec3f,
    footprint: f32,
) -> vec3f {
    // A texel of a level, blurred by its own box and by interpolation, has the variance of a box sqrt(3) times as wide.
    let level = log2(max(0.577 * footprint / light.texel_angle, 1.0));
    return textureSampleLevel(environment, environment_sampler, turned, level).rgb;
}

// A direction in the environment's own axes.
fn in_environment(light: Light, direction: vec3f) -> vec3f {
    return vec3f(
        light.turn_cos * direction.x + light.turn_sin * direction.y,
        light.turn_cos * direction.y - light.turn_sin * direction.x,
        direction.z,
    );
}

// What is seen straight behind the bubbles: of the environment a map of its own, which may be out of focus.
fn backdrop_radiance(
    backdrop_map: texture_cube<f32>,
    backdrop_sampler: sampler,
    light: Light,
    direction: vec3f,
    footprint: f32,
) -> vec3f {
    if (BACKDROP_IS_ENVIRONMENT == 0u) {
        return light.backdrop;
    }
    let turned = in_environment(light, direction);
    let level = log2(max(0.577 * footprint / light.backdrop_texel_angle, 1.0));
    let far = textureSampleLevel(backdrop_map, backdrop_sampler, turned, level).rgb;
    return light.gain * (far + lamps_radiance(turned, light.defocus, footprint));
}
