// Tone curve, gamut mapping, encoding and dither of the display. The f64 twin is src/physics/colour/display.rs.

// Radiance at which the curve leaves the straight line, and the radiance that it maps to display white. Both are relative to
// the brightest channel, so the hue of a saturated fringe does not turn.
const SHOULDER: f32 = 0.6;
const WHITE: f32 = 6.0;

// A colour on the tone curve, how much of its chroma it loses for its brightness, and the grey that it would end at.
struct Toned {
    linear: vec3f,
    bleach: f32,
    grey: f32,
}

// Maps the largest channel onto [0, 1]: straight up to SHOULDER (measured values are shown unchanged), then a rational shoulder of
// the same slope that reaches 1 at WHITE. Colours far beyond the shoulder lose chroma as film and eyes do.
fn tone_curve(linear: vec3f) -> Toned {
    let peak = max(linear.r, max(linear.g, linear.b));
    if (peak <= SHOULDER) {
        return Toned(linear, 0.0, 0.0);
    }
    let room = 1.0 - SHOULDER;
    let over = (min(peak, WHITE) - SHOULDER) / room;
    let over_white = (WHITE - SHOULDER) / room;
    let mapped = SHOULDER + room * over * (1.0 + over / (over_white * over_white)) / (1.0 + over);
    return Toned(linear * (mapped / peak), 0.8 * smoothstep(1.0, WHITE, peak), mapped);
}

// Where the curve of CIELAB leaves the cube root for a straight line.
const CURVE_START: f32 = 6.0 / 29.0;

fn lightness_curve(t: vec3f) -> vec3f {
    let root = pow(max(t, vec3f(1e-9)), vec3f(1.0 / 3.0));
    let line = t / (3.0 * CURVE_START * CURVE_START) + 4.0 / 29.0;
    return select(line, root, t > vec3f(CURVE_START * CURVE_START * CURVE_START));
}

fn inverse_curve(f: vec3f) -> vec3f {
    return select(3.0 * CURVE_START * CURVE_START * (f - 4.0 / 29.0), f * f * f, f > vec3f(CURVE_START));
}

fn is_inside(linear: vec3f) -> bool {
    return all(linear >= vec3f(0.0)) && all(linear <= vec3f(1.0));
}

// Halvings of the chroma's range.
const HALVINGS: u32 = 12u;

// Bleaches a colour, in the display's linear RGB, towards its grey, and brings it back into [0, 1] by lowering its chroma just as far as
// needed: both in CIELAB, whose hue stays. The matrices lead from the display's linear RGB to XYZ relative to white, and back.
fn into_gamut(toned: Toned, to_xyz: mat3x3f, from_xyz: mat3x3f) -> vec3f {
    let stays = toned.bleach == 0.0 && is_inside(toned.linear);
    let response = lightness_curve(to_xyz * toned.linear);
    let grey = lightness_curve(vec3f(toned.grey)).y;
    let lightness = clamp(mix(response.y, grey, toned.bleach), 4.0 / 29.0, 1.0);
    let chroma = (1.0 - toned.bleach) * (response - response.y);
    let whole = from_xyz * inverse_curve(lightness + chroma);
    let fits = is_inside(whole);
    // No rounds for colours that need none. Branches around the loop would not spare them on software rasterisers, which go through both sides.
    let rounds = select(HALVINGS, 0u, stays || fits);
    var kept = 0.0;
    var step = 0.5;
    for (var k = 0u; k < rounds; k++) {
        let tried = from_xyz * inverse_curve(lightness + (kept + step) * chroma);
        kept = select(kept, kept + step, is_inside(tried));
        step *= 0.5;
    }
    let reduced = clamp(from_xyz * inverse_curve(lightness + kept * chroma), vec3f(0.0), vec3f(1.0));
    return select(select(reduced, whole, fits), toned.linear, stays);
}

fn encode_srgb(linear: vec3f) -> vec3f {
    let low = 12.92 * linear;
    let high = 1.055 * pow(max(linear, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}

// A well-mixed 32-bit hash (PCG output permutation).
fn hash(value: u32) -> u32 {
    let state = value * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Uniform in [0, 1).
fn uniform_of(bits: u32) -> f32 {
    return f32(bits >> 8u) / 16777216.0;
}

// Adds triangular noise of the given width in 8-bit steps, the same in all channels (the eye forgives grey noise most).
fn dithered(encoded: vec3f, pixel: vec2u, seed: u32, steps: f32) -> vec3f {
    let first = hash(pixel.x + hash(pixel.y + hash(seed)));
    let noise = uniform_of(first) - uniform_of(hash(first));
    return encoded + steps * noise / 255.0;
}
