// Radiance as the linear picture stores it.

// 1: as f32. 0: as half floats, whose infinities would become NaN further on.
override FULL_PRECISION: u32;

const MAX_HALF: f32 = 65504.0;

// Radiance that the picture's format can hold: what is too bright keeps its hue. It is far beyond white there.
fn storable(radiance: vec3f) -> vec3f {
    if (FULL_PRECISION == 1u) {
        return radiance;
    }
    let peak = max(radiance.r, max(radiance.g, radiance.b));
    return radiance * min(1.0, MAX_HALF / max(peak, 1.0));
}
