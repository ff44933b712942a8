// Analytic coverage of a pixel by a sphere's outline, which in perspective is an ellipse.

import package::camera::view::View;
import package::sphere::axes::perpendicular;

struct Silhouette {
    // Part of the sample's square inside the outline, 0 to 1.
    coverage: f32,
    // Unit ray through the middle of the covered part: the sample itself where it is covered whole.
    inside: vec3f,
}

// `to_center_m` leads from the eye, which is outside, to the center. `plane` is the sample's point on the plane one metre before the eye, relative to the eye;
// `width` is the side of its square in pixels.
// The distance to the outline is measured as an angle, asin(R/D) minus the angle to the center, and divided by how fast that angle
// changes from pixel to pixel.
fn silhouette(view: View, to_center_m: vec3f, radius_m: f32, plane: vec3f, width: f32) -> Silhouette {
    let distance = length(to_center_m);
    let to_center = to_center_m / distance;
    let ray = normalize(plane);
    // The part of the ray across the axis to the center; its length is the sine of the angle between them.
    let across = ray - dot(ray, to_center) * to_center;
    let sine = length(across);
    let sin_limb = radius_m / distance;
    let cos_limb = sqrt(1.0 - sin_limb * sin_limb);
    // asin(sin_limb) - asin(sine), by the sine of the difference: exact at the limb, where it matters.
    var inward = sin_limb * dot(ray, to_center) - cos_limb * sine;
    if (dot(ray, to_center) <= 0.0) {
        return Silhouette(0.0, ray);
    }
    // Unit vector along which the ray turns away from the center, and its rate per pixel along x and y. Straight at the center all directions
    // lead away from it.
    let outward = select(across / max(sine, 1e-9), perpendicular(ray), sine < 1e-9);
    let turn = normalize(outward - dot(outward, ray) * ray);
    let rate = vec2f(dot(turn, view.right), dot(turn, view.up)) * view.pixel_height / length(plane);
    let pixel = max(length(rate), 1e-12) * width;
    let depth = inward / pixel + 0.5;
    let coverage = clamp(depth, 0.0, 1.0);
    if (coverage >= 1.0) {
        return Silhouette(1.0, ray);
    }
    // A partly covered sample is shaded at the middle of what it covers, half of `depth` inside the outline.
    let limb = sin_limb * outward + cos_limb * to_center;
    let step_in = 0.5 * coverage * pixel;
    let inside = normalize(limb - step_in * (cos_limb * outward - sin_limb * to_center));
    return Silhouette(coverage, inside);
}
