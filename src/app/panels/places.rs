//! Places in the picture, right and up from its middle in heights of it, and where they are in the window.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, vec2};
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

/// Writes a text over the picture, readable on any film: aligned to a point of the window.
pub fn tag(painter: &Painter, align: Align2, at: Pos2, text: String) {
    let text = painter.layout_no_wrap(text, FontId::proportional(13.0), Color32::WHITE);
    let room = align.anchor_size(at, text.size());
    painter.rect_filled(room.expand(3.0), 3.0, Color32::from_black_alpha(170));
    painter.galley(room.min, text, Color32::WHITE);
}
