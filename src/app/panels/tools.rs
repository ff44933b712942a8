//! The tool in the pointer's hand, over the picture's corner.

use egui::{Area, Context, Frame, Id, Rect, vec2};

use crate::app::{model::Model, tools::Tool};

/// The room of windows below the tools, which stand in two rows over a narrow picture.
pub fn room_below(picture: Rect) -> Rect {
    let height: f32 = if picture.width() < 400.0 { 74.0 } else { 46.0 };
    Rect::from_min_max(picture.min + vec2(0.0, height.min(picture.height())), picture.max)
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
