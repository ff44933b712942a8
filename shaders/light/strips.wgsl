// Reflections of the surroundings that are longer than wide.
//
// The pass that draws bubbles declares what this reads: the light, `environment`, and the function `surroundings`.

import package::light::environment::{in_environment, map_radiance};
import package::light::lamps::lamps_radiance;
import package::light::water::upward;
import package::sphere::path::{Path, footprint, spanned_angles};

// Lookups of the surroundings in a reflection, at most.
override ENVIRONMENT_TAPS: u32;
// How many times as long as wide what a lookup of the surroundings is filtered over may be.
const MAX_TAP_ASPECT: f32 = 2.0;
// How many times as wide as a square of equal variance the filter of a lookup is. A trilinear filter falls off more slowly than the box that a pixel
// averages over, and is nearest to the box, by mean square, where it is wider. That is worth 1 dB in the picture of a room.
const FILTER_WIDENING: f32 = 1.4;
// Inner reflections that take several lookups. Each more costs a tenth of a frame, and adds 1 dB to the picture of a room.
const STRIP_REFLECTIONS: f32 = 3.0;

// Light from the surroundings along a reflection, averaged over what the sample spans of them: towards the limb a strip in the plane of incidence,
// which lookups stand along. All of them share what is seen of the film, which changes less across a pixel. Lamps have soft edges of their own, and
// are filtered once. `turns` is how often the reflection turns by the angle of incidence as the ray does: 2 outside, -2 for each reflection inside.
fn reflected_surroundings(path: Path, direction: vec3f, turns: f32) -> vec3f {
    let angles = spanned_angles(path, direction, turns);
    if (ENVIRONMENT_TAPS == 1u || turns < -2.0 * STRIP_REFLECTIONS) {
        return surroundings(direction, footprint(angles));
    }
    let taps = clamp(ceil(angles.x / (MAX_TAP_ASPECT * max(angles.y, 1e-9))), 1.0, f32(ENVIRONMENT_TAPS));
    let part = vec2f(angles.x / taps, angles.y);
    let width = FILTER_WIDENING * footprint(part);
    // Straight through the middle there is no plane of incidence, and one lookup.
    let along = cross(path.across / max(length(path.across), 1e-9), direction);
    var sum = vec3f(0.0);
    for (var k = 0.0; k < taps; k += 1.0) {
        let turn = (k + 0.5 - 0.5 * taps) * part.x;
        let towards = in_environment(light, upward(cos(turn) * direction + sin(turn) * along));
        sum += map_radiance(environment, environment_sampler, light, towards, width);
    }
    let middle = in_environment(light, upward(direction));
    return light.gain * (sum / taps + lamps_radiance(middle, 0.0, footprint(angles)));
}
