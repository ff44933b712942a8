//! The tool in the pointer's hand, over the picture's corner.

use egui::{Area, Context, Frame, Id, Rect, vec2};

use crate::app::{model::Model, tools::Tool};

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
