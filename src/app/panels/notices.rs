//! What lies over the picture's lower left corner: messages, and what is being loaded or drawn.

use egui::{Align2, Area, Color32, Context, Frame, Id, Rect, RichText, Stroke, Ui, pos2};

use super::hints;
use crate::app::{
    messages::{Kind, Message},
    model::Model,
};

const PROBLEM: Color32 = Color32::from_rgb(214, 118, 96);
/// Seconds of work after which a sign moves beside its name. Sooner there is nothing to wonder about, and a software rasteriser that draws a moving
/// sign has less time for the work.
const PATIENCE_S: f64 = 1.0;

/// Shows messages and work in progress.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    let now_s = ctx.input(|input| input.time);
    let messages = model.messages.at(now_s).to_vec();
    if let Some(wait_s) = model.messages.next_change_s(now_s) {
        ctx.request_repaint_after_secs(wait_s.max(0.0) as f32);
    }
    let busy = model.loading.as_ref().map(|what| format!("Loading {what}"));
    let busy = busy.or(model.drawing.then(|| "Drawing the picture".to_owned()));
    let busy_s = seconds_of(ctx, busy.is_some(), now_s);
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
                    ui.label(busy);
                    if busy_s >= PATIENCE_S {
                        ui.spinner();
                    } else {
                        ctx.request_repaint_after_secs((PATIENCE_S - busy_s) as f32);
                    }
                });
            });
        }
    });
    if let Some(index) = dismissed {
        model.messages.dismiss(index);
    }
}

/// For how many seconds something has been so.
fn seconds_of(ctx: &Context, is_so: bool, now_s: f64) -> f64 {
    let id = Id::unique("busy since");
    ctx.data_mut(|data| {
        if is_so {
            now_s - *data.get_temp_mut_or(id, now_s)
        } else {
            data.remove::<f64>(id);
            0.0
        }
    })
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
