//! Places in the picture, right and up from its middle in heights of it, and where they are in the window.

use egui::{Pos2, Rect, vec2};
use glam::DVec2;

/// The place in the picture of a point of the window.
pub fn place(picture: Rect, at: Pos2) -> DVec2 {
    let from_middle = (at - picture.center()) / picture.height().max(1.0);
    DVec2::new(from_middle.x.into(), (-from_middle.y).into())
}

/// Where a place in the picture is in the window.
pub fn at(picture: Rect, place: DVec2) -> Pos2 {
    picture.center() + picture.height() * vec2(place.x as f32, -place.y as f32)
}
