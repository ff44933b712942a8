//! How drags, wheels and keys move the camera. Pure: a camera in, a camera out, always within a scene's ranges.

use glam::{DVec2, DVec3};

use crate::scene::{Bubble, Camera};

/// Degrees that a drag over the picture's whole height turns a camera that stands outside.
pub const TURN_DEG: f64 = 180.0;
/// Distances below this share of the reach count as the target itself.
const NEAR: f64 = 0.02;
/// The farthest a target or an eye may go, m.
const FARTHEST_M: f64 = 1000.0;
/// Share of the picture's smaller side that framed bubbles fill.
const FILL: f64 = 0.8;

/// What the pointer did over the picture since the last frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gesture {
    /// Turn about the target, in heights of the picture, to the right and down.
    pub turn: DVec2,
    /// Turn of a camera that follows the pointer, in the same way.
    pub follow: DVec2,
    /// Shift of the picture, in heights of the picture, to the right and down.
    pub shift: DVec2,
    /// Natural logarithm of the magnification.
    pub zoom: f64,
    /// Whether the bubbles shall be framed.
    pub frame: bool,
}

impl Gesture {
    /// Whether it moves the camera on purpose.
    #[must_use]
    pub fn moves(&self) -> bool {
        let Self { turn, shift, zoom, .. } = self;
        *turn != DVec2::ZERO || *shift != DVec2::ZERO || *zoom != 0.0
    }
}

/// Moves a camera by a gesture; see [`framed`] for one that frames the bubbles.
#[must_use]
pub fn moved(camera: &Camera, bubbles: &[Bubble], gesture: &Gesture) -> Camera {
    let turned = turned(camera, is_inside(camera, bubbles), gesture.turn);
    zoomed(&shifted(&turned, gesture.shift), reach_m(bubbles), gesture.zoom)
}

/// Turns the camera about its target. From inside a bubble one holds the wall, which moves with the pointer and against the target.
fn turned(camera: &Camera, inside: bool, turn: DVec2) -> Camera {
    let step = if inside { -camera.fov_y_rad().to_degrees() * turn } else { TURN_DEG * turn };
    Camera {
        azimuth_deg: wrapped(camera.azimuth_deg - step.x),
        elevation_deg: (camera.elevation_deg + step.y).clamp(-90.0, 90.0),
        ..camera.clone()
    }
}

/// Shifts the target across the view so that it follows the pointer.
fn shifted(camera: &Camera, shift: DVec2) -> Camera {
    let height_m = 2.0 * camera.distance_m.max(0.01) * half_fov(camera).tan();
    let offset = height_m * (shift.y * camera.up() - shift.x * camera.right());
    let target = (DVec3::from(camera.target_m) + offset).clamp(DVec3::splat(-FARTHEST_M), DVec3::splat(FARTHEST_M));
    Camera { target_m: target.to_array(), ..camera.clone() }
}

/// Changes the distance by a factor, but so that it can reach zero and leave it again.
fn zoomed(camera: &Camera, reach_m: f64, zoom: f64) -> Camera {
    let near = NEAR * reach_m;
    let distance = (camera.distance_m + near) * (-zoom.clamp(-20.0, 20.0)).exp() - near;
    // The offset alone would leave a distance that is no longer visible but not zero.
    let distance = if zoom > 0.0 && distance < near { 0.0 } else { distance };
    Camera { distance_m: distance.clamp(0.0, FARTHEST_M), ..camera.clone() }
}

/// Stands back along the same line of sight until all spheres, each a center and a radius in m, fill the picture well.
#[must_use]
pub fn framed(camera: &Camera, spheres: &[(DVec3, f64)], aspect: f64) -> Camera {
    let Some((center, radius)) = bounding_sphere(spheres) else { return camera.clone() };
    // A sphere of radius r touches the cone of half angle a at the distance r / sin a.
    let half_angle = (FILL * half_fov(camera).tan() * aspect.min(1.0)).atan();
    let distance_m = (radius / half_angle.sin()).min(FARTHEST_M);
    Camera { target_m: center.to_array(), distance_m, ..camera.clone() }
}

/// Views that people know by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Along the horizon, from +x.
    Front,
    /// Along the horizon, from +y.
    Side,
    /// From above.
    Top,
    /// As the camera looks now, near enough that the film fills the picture.
    Macro,
}

/// The views, each with its name and what it shows.
pub const VIEWS: [(View, &str, &str); 4] = [
    (View::Front, "front", "Along the horizon: level bands are level lines"),
    (View::Side, "side", "Along the horizon, a quarter turn from the front"),
    (View::Top, "top", "From above: onto the thinnest film of a bubble that has drained"),
    (
        View::Macro,
        "macro",
        "The film as a lens for small things sees it: a quarter of the way from the film to where the bubbles are framed",
    ),
];

/// A camera with one of these views of spheres, each a center and a radius in m.
#[must_use]
pub fn seen_from(camera: &Camera, spheres: &[(DVec3, f64)], view: View) -> Camera {
    let (azimuth_deg, elevation_deg) = match view {
        View::Front => (0.0, 0.0),
        View::Side => (90.0, 0.0),
        View::Top => (0.0, 90.0),
        View::Macro => (camera.azimuth_deg, camera.elevation_deg),
    };
    let framed = framed(&Camera { azimuth_deg, elevation_deg, ..camera.clone() }, spheres, 1.0);
    let nearest_m = spheres.iter().map(|(_, radius)| *radius).fold(0.0, f64::max);
    match view {
        // A quarter of the way between the film and where the bubbles are framed.
        View::Macro => Camera { distance_m: nearest_m + 0.25 * (framed.distance_m - nearest_m), ..framed },
        _ => framed,
    }
}

/// A sphere around all spheres: their mean center, and the farthest point from it.
fn bounding_sphere(spheres: &[(DVec3, f64)]) -> Option<(DVec3, f64)> {
    let center = spheres.iter().map(|(center, _)| *center).sum::<DVec3>() / spheres.len() as f64;
    let reach = |(other, radius): &(DVec3, f64)| other.distance(center) + radius;
    spheres.iter().map(reach).reduce(f64::max).map(|radius| (center, radius))
}

fn reach_m(bubbles: &[Bubble]) -> f64 {
    let spheres: Vec<_> = bubbles.iter().map(|bubble| (bubble.center_m.into(), bubble.radius_mm * 1e-3)).collect();
    bounding_sphere(&spheres).map_or(0.05, |(_, radius)| radius)
}

fn is_inside(camera: &Camera, bubbles: &[Bubble]) -> bool {
    let eye = camera.eye();
    bubbles.iter().any(|bubble| eye.distance(bubble.center_m.into()) < bubble.radius_mm * 1e-3)
}

fn half_fov(camera: &Camera) -> f64 {
    0.5 * camera.fov_y_rad()
}

/// An angle within (-180, 180] degrees.
#[must_use]
pub fn wrapped(deg: f64) -> f64 {
    180.0 - (180.0 - deg).rem_euclid(360.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn at(distance_m: f64) -> Camera {
        Camera { distance_m, ..Camera::default() }
    }

    fn one() -> Vec<Bubble> {
        vec![Bubble::default()]
    }

    #[test]
    fn a_drag_to_the_right_turns_the_near_side_to_the_right() {
        let camera = at(0.24);
        let near_side = -0.05 * camera.forward();
        let turned = moved(&camera, &one(), &Gesture { turn: DVec2::new(0.1, 0.0), ..Gesture::default() });
        assert!(near_side.dot(turned.right()) > 0.01);
        assert_eq!(turned.elevation_deg, camera.elevation_deg);
    }

    #[test]
    fn from_inside_the_wall_follows_the_pointer_by_the_same_share_of_the_view() {
        let camera = Camera { fov_y_deg: 90.0, elevation_deg: 0.0, ..at(0.0) };
        let before = camera.forward();
        let turned = moved(&camera, &one(), &Gesture { turn: DVec2::new(0.5, 0.0), ..Gesture::default() });
        // Half of a view of 90 degrees: what was ahead is 45 degrees to the right.
        assert!((before.dot(turned.right()) - 0.5f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_shift_moves_the_target_with_the_pointer() {
        let camera = at(0.24);
        let shifted = moved(&camera, &one(), &Gesture { shift: DVec2::new(0.25, 0.5), ..Gesture::default() });
        let height = 2.0 * 0.24 * 15f64.to_radians().tan();
        let offset = DVec3::from(shifted.target_m);
        assert!((offset.dot(camera.right()) + 0.25 * height).abs() < 1e-12);
        assert!((offset.dot(camera.up()) - 0.5 * height).abs() < 1e-12);
    }

    #[test]
    fn zooming_goes_to_the_center_and_out_again() {
        let step = |camera: &Camera, zoom| moved(camera, &one(), &Gesture { zoom, ..Gesture::default() });
        let mut camera = at(0.24);
        let notches = (1..100).find(|_| {
            camera = step(&camera, 0.2);
            camera.distance_m == 0.0
        });
        assert!(notches.is_some_and(|notches| notches < 40), "{notches:?} notches and {} m", camera.distance_m);
        for _ in 0..40 {
            camera = step(&camera, -0.2);
        }
        assert!(camera.distance_m > 0.24);
        // In and out by the same amount is no movement.
        let there_and_back = step(&step(&at(0.24), 0.7), -0.7);
        assert!((there_and_back.distance_m - 0.24).abs() < 1e-12);
    }

    #[test]
    fn framed_bubbles_fill_the_picture() {
        let away = Camera { target_m: [3.0, 2.0, 1.0], ..at(50.0) };
        let one = [(DVec3::ZERO, 0.05)];
        let camera = framed(&away, &one, 1.6);
        // The default camera is where the default bubble fills 80 % of the height.
        assert_eq!(camera.target_m, [0.0; 3]);
        assert!((camera.distance_m - 0.24).abs() < 0.003, "{} m", camera.distance_m);
        assert!(framed(&away, &one, 0.5).distance_m > 1.9 * camera.distance_m);
        assert_eq!(framed(&away, &[], 1.0), away);
    }

    #[test]
    fn no_gesture_leaves_the_ranges_of_a_scene() {
        let wild = [-1e9, -3.0, 0.0, 0.3, 1e9];
        let mut count = 0;
        for x in wild {
            for y in wild {
                let gesture =
                    Gesture { turn: DVec2::new(x, y), shift: DVec2::new(y, x), zoom: x, ..Gesture::default() };
                for distance in [0.0, 0.05, 1000.0] {
                    let camera = moved(&at(distance), &one(), &gesture);
                    let scene = Scene { camera, ..Scene::default() };
                    assert_eq!(scene.validate(), Ok(()), "{gesture:?}");
                    count += 1;
                }
            }
        }
        assert_eq!(count, 75);
    }

    #[test]
    fn angles_wrap() {
        for (deg, expected) in [(0.0, 0.0), (180.0, 180.0), (190.0, -170.0), (-180.0, 180.0), (725.0, 5.0)] {
            assert!((wrapped(deg) - expected).abs() < 1e-12, "{deg}");
        }
    }

    #[test]
    fn views_look_where_their_names_say() {
        let spheres = [(DVec3::new(0.1, 0.0, 0.2), 0.05)];
        let from = |view| {
            let camera = seen_from(&Camera::default(), &spheres, view);
            ((camera.eye() - spheres[0].0).normalize(), camera.eye().distance(spheres[0].0))
        };
        assert!(from(View::Front).0.abs_diff_eq(DVec3::X, 1e-12) && from(View::Side).0.abs_diff_eq(DVec3::Y, 1e-12));
        assert!(from(View::Top).0.abs_diff_eq(DVec3::Z, 1e-12));
        let (near, far) = (from(View::Macro).1, from(View::Front).1);
        assert!(near > 0.05 && near < 0.5 * far, "outside of the bubble, and near it: {near} {far}");
    }
}
