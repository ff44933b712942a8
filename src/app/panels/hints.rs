//! One line that says what to do; it goes away for good once it was read.

use egui::{Align2, Area, Context, Frame, Id, LayerId, Order, Rect, vec2};

use crate::app::model::Model;

/// The line.
const HINTS: &str =
    "Drag to turn, scroll to zoom. 2 stirs the film, 6 measures it. Space pauses, Ctrl+Z undoes, F1 shows all keys.";

/// Height of a picture, points, below which the line would cover too much of it.
const LOWEST: f32 = 200.0;

/// The lower edge of the picture, or of what is left of it above the hints.
pub fn floor(ctx: &Context, picture: Rect) -> f32 {
    let hints = Id::unique("hints");
    let shown = ctx.memory(|memory| {
        let is_visible = memory.areas().is_visible(&LayerId::new(Order::Middle, hints));
        memory.area_rect(hints).filter(|_| is_visible)
    });
    shown.map_or(picture.bottom(), |hints| hints.top())
}

/// Shows the hints over the lower edge of the picture.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    if model.settings.knows_hints || picture.height() < LOWEST {
        return;
    }
    let edge = picture.center_bottom() + vec2(0.0, -10.0);
    Area::new(Id::unique("hints")).fixed_pos(edge).pivot(Align2::CENTER_BOTTOM).constrain_to(picture).show(ctx, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width((picture.width() - 40.0).max(60.0));
            ui.horizontal(|ui| {
                model.settings.knows_hints =
                    ui.small_button("Got it").on_hover_text("Do not show hints again").clicked();
                ui.add(egui::Label::new(HINTS).wrap());
            });
        });
    });
    // Who has changed something knows how.
    model.settings.knows_hints |= model.undo.steps() > HINTED_STEPS;
}

/// Steps after which the hints have done their work.
const HINTED_STEPS: usize = 12;
