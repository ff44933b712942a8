//! What lies over the picture's lower left corner: messages, and what is being loaded or drawn.

use egui::{Align2, Area, Color32, Context, Frame, Id, Rect, RichText, Stroke, Ui, pos2};

use super::hints;
use crate::app::{
    messages::{Kind, Message},
    model::Model,
};

const PROBLEM: Color32 = Color32::from_rgb(214, 118, 96);

/// Shows messages and work in progress.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    let now_s = ctx.input(|input| input.time);
    let messages = model.messages.at(now_s).to_vec();
    if let Some(wait_s) = model.messages.next_change_s(now_s) {
        ctx.request_repaint_after_secs(wait_s.max(0.0) as f32);
    }
    let busy = model.loading.as_ref().map(|what| format!("Loading {what}"));
    let busy = busy.or(model.drawing.then(|| "Drawing the picture".to_owned()));
    if messages.is_empty() && busy.is_none() {
        return;
    }
    let corner = pos2(picture.left() + 12.0, hints::floor(ctx, picture) - 12.0);
    let mut dismissed = None;
    Area::new(Id::unique("notices")).fixed_pos(corner).pivot(Align2::LEFT_BOTTOM).show(ctx, |ui| {
        ui.set_max_width((picture.width() - 24.0).clamp(120.0, 560.0));
        for (index, message) in messages.iter().enumerate() {
            if line(ui, message) {
                dismissed = Some(index);
            }
        }
        if let Some(busy) = busy {
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.spinner();
                    ui.label(busy);
                });
            });
        }
    });
    if let Some(index) = dismissed {
        model.messages.dismiss(index);
    }
}

/// One message; returns whether it was dismissed.
fn line(ui: &mut Ui, message: &Message) -> bool {
    let frame = Frame::popup(ui.style());
    let frame = if message.kind == Kind::Problem { frame.stroke(Stroke::new(1.0, PROBLEM)) } else { frame };
    frame
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let close = ui.small_button("×").on_hover_text("Dismiss this message (Esc for all)").clicked();
                ui.add(egui::Label::new(RichText::new(&message.text)).wrap());
                close
            })
            .inner
        })
        .inner
}
