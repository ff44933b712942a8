//! Lines of sight: from places in the picture to directions and back. A place is right and up from the picture's middle, in heights of the picture.

use glam::{DVec2, DVec3};

use crate::scene::Camera;

/// Nearest distance along the camera's direction at which something has a place in the picture, m.
const NEAREST_M: f64 = 1e-6;

/// Height of the picture at a distance of one along the camera's direction.
#[must_use]
pub fn height(camera: &Camera) -> f64 {
    2.0 * (0.5 * camera.fov_y_rad()).tan()
}

/// The direction of the line of sight through a place in the picture.
#[must_use]
pub fn ray(camera: &Camera, place: DVec2) -> DVec3 {
    (camera.forward() + height(camera) * (place.x * camera.right() + place.y * camera.up())).normalize()
}

/// How far a point is in front of the eye, along the camera's direction, m.
#[must_use]
pub fn depth_m(camera: &Camera, point_m: DVec3) -> f64 {
    (point_m - camera.eye()).dot(camera.forward())
}

/// The place of a point in the picture; `None` for one behind the eye.
#[must_use]
pub fn place(camera: &Camera, point_m: DVec3) -> Option<DVec2> {
    let from_eye = point_m - camera.eye();
    let depth_m = depth_m(camera, point_m);
    let across = DVec2::new(from_eye.dot(camera.right()), from_eye.dot(camera.up()));
    (depth_m > NEAREST_M).then(|| across / (depth_m * height(camera)))
}

/// The outline of a sphere in the picture: the middle and the radius of a circle. `None` for one behind the eye or around it.
#[must_use]
pub fn outline(camera: &Camera, center_m: DVec3, radius_m: f64) -> Option<(DVec2, f64)> {
    let distance_m = center_m.distance(camera.eye());
    let middle = place(camera, center_m).filter(|_| distance_m > radius_m)?;
    // As of a sphere straight ahead: off the axis its outline is an ellipse, a little longer.
    Some((middle, radius_m / (distance_m * distance_m - radius_m * radius_m).sqrt() / height(camera)))
}

/// How far along a line, in units of its direction of length 1, the point of it lies that is nearest to a line of sight. `None` if the two are within
/// a degree or so of one another's direction, or if the nearest point is behind the eye.
///
/// With w from the eye to the line's origin, a its direction and r the line of sight, |w + t a − s r| is least at t = ((a·r)(r·w) − a·w)/(1 − (a·r)²)
/// and s = r·w + t a·r.
#[must_use]
pub fn nearest_on_line(eye_m: DVec3, ray: DVec3, origin_m: DVec3, axis: DVec3) -> Option<f64> {
    /// 1 − cos² of a degree.
    const PARALLEL: f64 = 3e-4;
    let (w, cos) = (origin_m - eye_m, axis.dot(ray));
    let sin_squared = 1.0 - cos * cos;
    if sin_squared < PARALLEL {
        return None;
    }
    let along = (cos * ray.dot(w) - axis.dot(w)) / sin_squared;
    (ray.dot(w) + along * cos > 0.0).then_some(along)
}

/// Where a line of sight meets a plane, m; `None` if it is within a degree of lying in it, or leads away from it.
#[must_use]
pub fn on_plane(eye_m: DVec3, ray: DVec3, origin_m: DVec3, normal: DVec3) -> Option<DVec3> {
    const LEVEL: f64 = 0.0175;
    let slope = normal.dot(ray);
    let along_m = normal.dot(origin_m - eye_m) / slope;
    (slope.abs() > LEVEL && along_m > 0.0).then(|| eye_m + along_m * ray)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_rays_agree() {
        let camera = Camera { azimuth_deg: 33.0, elevation_deg: 20.0, ..Camera::default() };
        for at in [DVec2::ZERO, DVec2::new(0.4, -0.3), DVec2::new(-1.0, 0.5)] {
            let point_m = camera.eye() + 0.7 * ray(&camera, at);
            assert!(place(&camera, point_m).is_some_and(|found| found.distance(at) < 1e-12), "{at}");
        }
        assert_eq!(place(&camera, camera.eye() - camera.forward()), None);
        assert_eq!(place(&camera, camera.eye()), None);
    }

    #[test]
    fn the_nearest_point_of_a_line_is_found() {
        let eye_m = DVec3::new(5.0, 0.0, 0.0);
        let toward = |point: DVec3| (point - eye_m).normalize();
        for along in [-0.5, 0.0, 1.5] {
            let found = nearest_on_line(eye_m, toward(DVec3::new(0.0, along, 0.3)), DVec3::ZERO, DVec3::Y);
            // The line of sight passes the axis above the point where it would meet it.
            assert!(
                found.is_some_and(|found| (found - along).abs() < 0.01 * along.abs() + 1e-12),
                "{along}: {found:?}"
            );
        }
        let origin_m = DVec3::new(0.1, 0.2, -0.3);
        let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        let found = nearest_on_line(eye_m, toward(origin_m + 0.7 * axis), origin_m, axis);
        assert!(found.is_some_and(|found| (found - 0.7).abs() < 1e-12), "{found:?}");
    }

    #[test]
    fn lines_that_cannot_be_told_have_no_nearest_point() {
        let eye_m = DVec3::new(5.0, 0.0, 0.0);
        assert_eq!(nearest_on_line(eye_m, DVec3::NEG_X, DVec3::ZERO, DVec3::X), None, "along the line of sight");
        let past = DVec3::new(1.0, 0.5, 0.0).normalize();
        assert_eq!(nearest_on_line(eye_m, past, DVec3::ZERO, DVec3::Y), None, "behind the eye");
        assert_eq!(on_plane(eye_m, past, DVec3::ZERO, DVec3::X), None, "behind the eye");
        assert_eq!(on_plane(eye_m, DVec3::NEG_X, DVec3::ZERO, DVec3::Z), None, "level");
        let met = on_plane(eye_m, DVec3::new(-1.0, 0.0, 0.1).normalize(), DVec3::ZERO, DVec3::X);
        assert!(met.is_some_and(|met| met.distance(DVec3::new(0.0, 0.0, 0.5)) < 1e-12), "{met:?}");
    }
}
