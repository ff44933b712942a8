//! The wand: a new bubble where the pointer is pressed, as large as the pointer draws it.

use glam::DVec3;

use super::{sight, tools::Press};
use crate::scene::{Bubble, Camera, Film, FilmStateName, Range};

/// The least radius, mm: the pointer has hardly moved.
const SMALLEST_MM: f64 = 1.0;

/// A bubble that is being blown. It is in the scene once the pointer is let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wand {
    /// Its center, m.
    pub center_m: DVec3,
    /// Its radius, m.
    pub radius_m: f64,
}

impl Wand {
    /// The bubble whose center is where the pointer was pressed and whose outline goes through where it is now, both at the distance of the camera's
    /// target.
    #[must_use]
    pub fn new(camera: &Camera, press: Press) -> Option<Self> {
        let (eye, target) = (camera.eye(), DVec3::from(camera.target_m));
        let at = |place| sight::on_plane(eye, sight::ray(camera, place), target, -camera.forward());
        let (center_m, edge_m) = (at(press.from)?, at(press.at)?);
        let radius_m = center_m.distance(edge_m);
        (1e3 * radius_m >= SMALLEST_MM).then_some(Self { center_m, radius_m })
    }

    /// The bubble as a scene has it: just blown.
    #[must_use]
    pub fn bubble(self) -> Bubble {
        let largest_mm = match Bubble::KEYS.radius_mm.range {
            Range::Within(_, largest_mm) => largest_mm,
            _ => f64::INFINITY,
        };
        // To a tenth of a millimetre.
        let radius_mm = (1e4 * self.radius_m).round() / 10.0;
        Bubble {
            center_m: self.center_m.to_array(),
            radius_mm: radius_mm.min(largest_mm),
            film: Film { state: FilmStateName::Blown, ..Film::default() },
            ..Bubble::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    #[test]
    fn a_bubble_is_as_large_as_it_is_drawn() {
        let camera = Camera { azimuth_deg: 30.0, elevation_deg: 10.0, ..Camera::default() };
        let from = DVec2::new(0.2, -0.1);
        let wand = Wand::new(&camera, Press { from, at: from + DVec2::new(0.0, 0.15) }).unwrap();
        assert!(sight::place(&camera, wand.center_m).unwrap().distance(from) < 1e-9);
        let height_m = sight::height(&camera) * sight::depth_m(&camera, wand.center_m);
        assert!((wand.radius_m - 0.15 * height_m).abs() < 1e-9, "{} m", wand.radius_m);
        assert!((wand.bubble().radius_mm - 1e3 * wand.radius_m).abs() < 0.051);
        assert_eq!(Wand::new(&camera, Press { from, at: from }), None, "not drawn yet");
    }
}
