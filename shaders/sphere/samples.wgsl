// The samples that a pixel of a bubble is the mean of.
//
// The pass that draws bubbles declares what this reads: `view`, `bubble`, and the functions `bubble_radiance` and `beside`.

import package::camera::circle::{in_circle, sample_width};
import package::camera::view::{pixel_angle, view_plane};
import package::light::polarisation::count_polarisation;
import package::sphere::path::{PixelPart, WHOLE_PIXEL};
import package::sphere::trace::outline;

// Samples along each side of a pixel, or in all where they stand in a line: 1, or more near the outline, and for bubbles of a few pixels, whose film
// is finer than a pixel.
override SAMPLES: u32;
// 1: the samples stand in a line through the pixel's middle, towards the bubble's center, along which a bubble shows most in a pixel.
override IN_LINE: u32;
// 1: the bubble is out of focus. The samples fill the circle of confusion, and each is filtered over its part of it.
override OUT_OF_FOCUS: u32;
// Samples along each side of a pixel that is unlike its neighbours, in place of the one. 0: all pixels have one.
override REFINED_SAMPLES: u32;
// 1: the bubble's outline crosses the ring. 0: the bubble covers all of it.
override OUTLINE: u32;

// A pixel takes more samples if it differs from its neighbours by more than this part of the span from black to white.
const HIGH_CONTRAST: f32 = 0.15;

// Light through a pixel.
fn pixel_radiance(position: vec2f) -> vec3f {
    if (OUT_OF_FOCUS == 1u) {
        return mean_over_circle(position, SAMPLES);
    }
    if (REFINED_SAMPLES > 0u) {
        return refined_radiance(position);
    }
    if (SAMPLES == 1u) {
        return sample_radiance(position, position, WHOLE_PIXEL);
    }
    if (IN_LINE == 1u) {
        return mean_in_line(position, SAMPLES);
    }
    return mean_radiance(position, SAMPLES);
}

// One sample: the bubble as far as it covers the sample's box, what is beside it in the rest. `position` is where the bubble is looked at, `behind` where
// what is behind it is.
fn sample_radiance(position: vec2f, behind: vec2f, part: PixelPart) -> vec3f {
    let plane = view_plane(view, position);
    if (OUTLINE == 0u) {
        let radiance = bubble_radiance(normalize(plane), part, behind);
        count_polarisation(1.0);
        return radiance;
    }
    let edge = outline(plane, part.size.x);
    // Not only where it is covered: derivatives need the neighbours.
    let radiance = bubble_radiance(edge.inside, part, behind);
    count_polarisation(edge.coverage);
    let ray = normalize(view_plane(view, behind));
    return mix(beside(ray, pixel_angle(view, ray), behind), radiance, edge.coverage);
}

// One sample, or the mean over a grid of several where the pixel is unlike its neighbours: a pixel differs from those that it shares derivatives with
// where an edge crosses one of them. All derivatives are taken at the first sample, which all pixels take.
@diagnostic(off, derivative_uniformity)
fn refined_radiance(position: vec2f) -> vec3f {
    let side = max(REFINED_SAMPLES, 1u);
    let width = 1.0 / f32(side);
    var part = WHOLE_PIXEL;
    var place = position;
    var total = vec3f(0.0);
    // In one loop, so that the code of a sample stands once.
    for (var k = 0u; k <= side * side; k++) {
        let radiance = sample_radiance(place, place, part);
        if (k == 0u) {
            if (contrast(radiance) < HIGH_CONTRAST) {
                return radiance;
            }
            part = PixelPart(vec2f(1.0, 0.0), vec2f(width), false);
        } else {
            total += radiance;
        }
        let cell = vec2u(k % side, k / side);
        place = floor(position) + (vec2f(cell) + 0.5) * width;
    }
    return total * width * width;
}

// How much the pixels that share derivatives differ, as they are shown, over the span from black to white: the primary that differs most.
@diagnostic(off, derivative_uniformity)
fn contrast(radiance: vec3f) -> f32 {
    let bounded = max(radiance, vec3f(0.0));
    let shown = sqrt(bounded / (1.0 + bounded));
    let change = fwidth(shown);
    return max(change.x, max(change.y, change.z));
}

// The mean over a grid of samples in a pixel.
fn mean_radiance(position: vec2f, side: u32) -> vec3f {
    let corner = floor(position);
    let width = 1.0 / f32(side);
    var total = vec3f(0.0);
    for (var k = 0u; k < side * side; k++) {
        let place = corner + vec2f(f32(k % side) + 0.5, f32(k / side) + 0.5) * width;
        total += sample_radiance(place, place, PixelPart(vec2f(1.0, 0.0), vec2f(width), true));
    }
    return total * width * width;
}

// The mean over a circle of confusion.
fn mean_over_circle(position: vec2f, side: u32) -> vec3f {
    let radius = bubble.confusion_pixels;
    let width = sample_width(radius, side);
    var total = vec3f(0.0);
    for (var k = 0u; k < side * side; k++) {
        let place = position + radius * in_circle(k, side * side, position);
        total += sample_radiance(place, position, PixelPart(vec2f(1.0, 0.0), vec2f(width), true));
    }
    return total / f32(side * side);
}

// The mean over samples in a line through a pixel's middle. Across any direction a pixel is as wide as its side, by its variance.
fn mean_in_line(position: vec2f, count: u32) -> vec3f {
    let along = outward_in_picture(position);
    let width = 1.0 / f32(count);
    var total = vec3f(0.0);
    for (var k = 0u; k < count; k++) {
        let offset = (f32(k) + 0.5) * width - 0.5;
        let place = position + offset * along;
        total += sample_radiance(place, place, PixelPart(along, vec2f(width, 1.0), true));
    }
    return total * width;
}

// Unit vector in the picture, y down, along which the angle to the bubble's center grows.
fn outward_in_picture(position: vec2f) -> vec2f {
    let ray = normalize(view_plane(view, position));
    let turn = dot(ray, bubble.to_center_m) * ray - bubble.to_center_m;
    let rate = vec2f(dot(turn, view.right), -dot(turn, view.up));
    return rate / max(length(rate), 1e-30);
}
