//! The tool in the pointer's hand, over the picture's corner.

use egui::{Area, Context, Frame, Id, Rect, vec2};

use crate::app::{model::Model, tools::Tool};

/// Width of the tools in one row with the margins around them, points.
pub const WIDTH: f32 = 464.0;

/// The room of windows below the tools, which stand in several rows over a narrow picture.
pub fn room_below(picture: Rect) -> Rect {
    // The last tool of a row may leave room that it is too wide for.
    let rows = match picture.width() {
        width if width >= WIDTH => 1.0,
        width if width >= 0.6 * WIDTH => 2.0,
        _ => 3.0,
    };
    let height = 18.0 + 28.0 * rows;
    Rect::from_min_max(picture.min + vec2(0.0, picture.height().min(height)), picture.max)
}

/// Shows the tools over a corner of the picture.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    Area::new(Id::unique("tools")).fixed_pos(picture.left_top() + vec2(10.0, 10.0)).show(ctx, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width((picture.width() - 34.0).max(60.0));
            ui.horizontal_wrapped(|ui| {
                for (tool, name, help) in Tool::ALL {
                    ui.selectable_value(&mut model.tool, tool, name).on_hover_text(help);
                }
            });
        });
    });
}
