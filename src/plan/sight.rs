//! What of a bubble can be seen: its place in the picture, and how much of its film pixels tell apart.

use glam::{DVec2, DVec3};

use super::{CameraKey, FilmKey, keys::samples};

/// Radius in pixels below which a film's field cannot be seen: it is drawn with its mean thickness.
pub(super) const SMALLEST_FIELD_PIXELS: f64 = 0.75;

/// Pixels that a cell of a film must span for the film to be looked up at each pixel: below that, a cell is interpolated well enough.
const MAGNIFIED_CELL_PIXELS: f64 = 3.0;
/// Pixels that a cell of a film spans at most, and over how many thicknesses each sample is then a mean: from cell to cell a film may change by more
/// than a fringe.
const CELL_PIXELS_OF_MEANS: [(f64, u32); 2] = [(1.0, 4), (2.0, 2)];

pub(super) fn is_magnified(film: &FilmKey, radius_m: f64, radius_pixels: f64, distance_m: f64) -> bool {
    let FilmKey::Field(field) = film else { return false };
    // From inside, and for the nearest point from outside, the film is nearer than the center.
    let nearest_m = (distance_m - radius_m).abs().max(1e-3 * radius_m);
    let magnification = (distance_m.max(radius_m) / nearest_m).min(16.0);
    field.scheme.keeps_map() && field.cell_angle() * radius_pixels * magnification > MAGNIFIED_CELL_PIXELS
}

/// Thicknesses that a sample is the mean of: several where a pixel spans so much of a film that it may change by much of a fringe across it. Several
/// samples per pixel see that better than a mean which takes the film to change evenly from pixel to pixel. Samples of a bubble that is out of focus
/// span several pixels each.
pub(super) fn thicknesses(film: &FilmKey, radius_pixels: f64, is_sharp: bool) -> u32 {
    let FilmKey::Field(field) = film else { return 1 };
    if !is_sharp {
        return CELL_PIXELS_OF_MEANS[0].1;
    }
    if samples(radius_pixels) > 1 {
        return 1;
    }
    let cell_pixels = field.cell_angle() * radius_pixels;
    CELL_PIXELS_OF_MEANS.into_iter().find(|(most, _)| cell_pixels < *most).map_or(1, |(_, thicknesses)| thicknesses)
}

/// Bounding rectangle of a sphere's outline in clip coordinates, with a margin of a pixel and of what the lens blurs it by, cut to the picture; `None`
/// if it is outside.
pub(super) fn bounds(camera: &CameraKey, size: [u32; 2], center_m: DVec3, radius_m: f64) -> Option<[DVec2; 2]> {
    let offset = center_m - camera.eye_m;
    let depth = offset.dot(camera.forward);
    let half = size.map(|pixels| 0.5 * f64::from(pixels) * camera.pixel_height_m);
    let pixel = DVec2::new(2.0 / f64::from(size[0]), 2.0 / f64::from(size[1]));
    let margin = (1.0 + camera.confusion_pixels(center_m, radius_m)) * pixel;
    // Clip coordinates point up.
    let shift = camera.shift * DVec2::new(pixel.x, -pixel.y);
    let x = span(offset.dot(camera.right), depth, radius_m).map(|x| x / half[0] + shift.x);
    let y = span(offset.dot(camera.up), depth, radius_m).map(|y| y / half[1] + shift.y);
    let low = (DVec2::new(x[0], y[0]) - margin).max(DVec2::NEG_ONE);
    let high = (DVec2::new(x[1], y[1]) + margin).min(DVec2::ONE);
    (low.x < high.x && low.y < high.y).then_some([low, high])
}

/// Where the two lines from the eye that touch a circle cross the line one metre before it: the circle's projection. One that turns to behind the eye
/// crosses it at infinity, on the side of the circle; a circle around the eye covers everything.
fn span(across: f64, depth: f64, radius: f64) -> [f64; 2] {
    let square = across * across + depth * depth - radius * radius;
    if square <= 0.0 {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    let tangent = square.sqrt();
    [-1.0, 1.0].map(|side| {
        let (sine, cosine) = (across * tangent + side * depth * radius, depth * tangent - side * across * radius);
        if cosine > 0.0 { sine / cosine } else { across.signum() * f64::INFINITY }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beside_the_eye_is_seen_only_as_far_as_it_reaches_into_the_picture() {
        let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        // Before the eye, on either side.
        let [left, right] = span(0.0, 2.0, 1.0);
        assert!((right - 3.0_f64.sqrt().recip()).abs() < 1e-12 && left == -right);
        // Beside the eye and behind it, as seen by directions from 15 to 185, from 110 to 230 and from 91 to 131 degrees.
        let circle = |middle_deg: f64, half_deg: f64| {
            let (sine, cosine) = middle_deg.to_radians().sin_cos();
            span(sine, cosine, half_deg.to_radians().sin())
        };
        let [near, far] = circle(100.0, 85.0);
        assert!((near - 15_f64.to_radians().tan()).abs() < 1e-12 && far == high);
        let [far, near] = circle(-100.0, 85.0);
        assert!((near + 15_f64.to_radians().tan()).abs() < 1e-12 && far == low);
        for behind in [circle(170.0, 60.0), circle(111.0, 20.0)] {
            assert_eq!(behind, [high, high]);
        }
        assert_eq!(circle(-170.0, 60.0), [low, low]);
        // The eye is inside.
        assert_eq!(span(0.3, -0.2, 0.5), [low, high]);
    }
}
