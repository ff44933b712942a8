// The circle of confusion: what a lens makes of a point that is out of focus.

const PI: f32 = 3.141592653589793;
const GOLDEN_ANGLE: f32 = 2.399963229728653;

// Side in pixels of a sample's box, where side x side samples share the area of a circle of confusion and of the pixel.
fn sample_width(confusion_pixels: f32, side: u32) -> f32 {
    return sqrt(PI * confusion_pixels * confusion_pixels + 1.0) / f32(side);
}

// From this number of places on the spiral is turned from pixel to pixel. Fewer are for circles of few pixels, whose places lie close together anyway.
const TURNED: u32 = 16u;

// The k-th of a number of places that fill the unit circle evenly, on a spiral (Vogel 1979). What would be seen as a few images of an outline, each apart,
// is seen as a fine grain where the spiral is turned by interleaved gradient noise (Jimenez 2014). Pixels that share derivatives share a turn.
fn in_circle(k: u32, count: u32, pixel: vec2f) -> vec2f {
    let noise = fract(52.9829189 * fract(dot(floor(0.5 * pixel), vec2f(0.06711056, 0.00583715))));
    let turn = GOLDEN_ANGLE * f32(k) + select(0.0, 2.0 * PI * noise, count >= TURNED);
    return sqrt((f32(k) + 0.5) / f32(count)) * vec2f(cos(turn), sin(turn));
}
