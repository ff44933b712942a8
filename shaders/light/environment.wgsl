// The light around the bubble, and what stands straight behind it.

// Mirrors `LightUniform` in src/gpu/draw.rs. All colours are linear BT.2020.
struct Light {
    // Colour that the environment's radiance is multiplied with: intensity and the illuminant's white.
    gain: vec3f,
    // Angle between neighbouring texels at the centre of a face of the environment's finest level.
    texel_angle: f32,
    // Radiance of the backdrop where it is a colour.
    backdrop: vec3f,
    // 1 where the backdrop is the environment.
    backdrop_is_environment: f32,
    // The illuminant's white: the film's colours are given relative to it.
    white: vec3f,
    // cos and sin of the environment's turn about the vertical are turn_cos here and turn_sin below.
    turn_cos: f32,
    turn_sin: f32,
}

// Radiance from a direction, filtered over a cone of the given angle.
fn environment_radiance(
    environment: texture_cube<f32>,
    environment_sampler: sampler,
    light: Light,
    direction: vec3f,
    footprint: f32,
) -> vec3f {
    let turned = vec3f(
        light.turn_cos * direction.x + light.turn_sin * direction.y,
        light.turn_cos * direction.y - light.turn_sin * direction.x,
        direction.z,
    );
    let level = log2(max(footprint / light.texel_angle, 1.0));
    return light.gain * textureSampleLevel(environment, environment_sampler, turned, level).rgb;
}

fn backdrop_radiance(
    environment: texture_cube<f32>,
    environment_sampler: sampler,
    light: Light,
    direction: vec3f,
    footprint: f32,
) -> vec3f {
    if (light.backdrop_is_environment == 0.0) {
        return light.backdrop;
    }
    return environment_radiance(environment, environment_sampler, light, direction, footprint);
}
