//! The picture's place in the window, and what the pointer does there.

use egui::{
    Align2, CentralPanel, Color32, Context, Frame, InputState, LayerId, PointerButton, Rect, Response, Sense, Stroke,
    Ui, Vec2, pos2,
};
use glam::DVec2;

use super::{
    Picture, gallery, gizmo,
    places::{at, place, tag},
};
use crate::app::{
    model::Model,
    orbit::{Gesture, TURN_DEG},
    sight,
    tools::{self, Press},
    wand::Wand,
};

/// Natural logarithm of the magnification for a point of scrolling: a notch of a wheel is 40 points.
const ZOOM_PER_POINT: f64 = 0.004;

/// Shows the picture in the rest of the window, and reads the pointer there, which a camera may follow by an angle for the picture's height.
pub fn show(ui: &mut Ui, model: &mut Model) -> Picture {
    let follow_deg = model.scene.camera.follow_deg;
    CentralPanel::no_frame()
        .frame(Frame::NONE)
        .show(ui, |ui| {
            let rect = ui.available_rect_before_wrap();
            if model.pictured.is_none() && !model.stands_alone {
                placeholder(ui, rect, &model.name);
            }
            let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
            let (fingers, held) = (fingers(ui, &response), is_held(ui, &response));
            let mut gesture = gesture(ui, &response, follow_deg, fingers, held);
            gesture.frame |= gizmo::show(ui, rect, model);
            Picture {
                rect,
                gesture,
                pressed: if held && fingers == Fingers::One { pressed(ui, rect) } else { None },
                hovered: response.hover_pos().map(|at| place(rect, at)),
                clicked: response.clicked(),
            }
        })
        .inner
}

/// Shows the gallery's small picture of a preset while the first one is drawn, as high as that will be.
fn placeholder(ui: &Ui, rect: Rect, name: &str) {
    let Some(picture) = gallery::picture(ui.ctx(), name) else { return };
    let size = picture.size_vec2() * (rect.height() / picture.size_vec2().y);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter_at(rect).image(picture.id(), Rect::from_center_size(rect.center(), size), whole, Color32::WHITE);
}

/// How many fingers hold the picture; a mouse is one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fingers {
    One,
    /// Two or more, and how far their middle has moved, in points.
    More(Vec2),
    /// One of more that have been lifted since.
    Left,
}

/// The first of several fingers is also the pointer: until it is lifted, it neither turns the view nor has a tool in hand.
fn fingers(ui: &Ui, response: &Response) -> Fingers {
    let were_more = response.id.with("fingers");
    if let Some(touch) = ui.input(InputState::multi_touch) {
        ui.data_mut(|data| data.insert_temp(were_more, true));
        return Fingers::More(touch.translation_delta);
    }
    if !ui.data(|data| data.get_temp(were_more).unwrap_or(false)) {
        return Fingers::One;
    }
    if !ui.input(|input| input.pointer.any_down() || input.any_touches()) {
        ui.data_mut(|data| data.insert_temp(were_more, false));
    }
    Fingers::Left
}

/// Whether the pointer went down on the picture and is down since. egui takes a finger that rests for a secondary click, and gives it up; on a
/// picture it goes on holding a tool or the view.
fn is_held(ui: &Ui, response: &Response) -> bool {
    let was_held = response.id.with("held");
    let is_down = ui.input(|input| input.pointer.any_down());
    let goes_on = ui.data(|data| data.get_temp(was_held).unwrap_or(false));
    let is_held = is_down && (goes_on || response.is_pointer_button_down_on());
    ui.data_mut(|data| data.insert_temp(was_held, is_held));
    is_held
}

/// The pointer that holds the picture, if by its primary button without Shift, which would shift the view.
fn pressed(ui: &Ui, picture: Rect) -> Option<Press> {
    let (is_down, from, at) = ui.input(|input| {
        let pointer = &input.pointer;
        (pointer.primary_down() && !input.modifiers.shift, pointer.press_origin(), pointer.interact_pos())
    });
    let at = at.filter(|_| is_down)?;
    let place = |at| place(picture, at);
    Some(Press { from: place(from.unwrap_or(at)), at: place(at) })
}

/// Outlines the selected bubbles, if one was clicked.
pub fn outline(ctx: &Context, picture: Rect, model: &Model) {
    let selection = if model.outlines { model.selection() } else { Vec::new() };
    let outlines = selection.into_iter().filter_map(|bubble| tools::outline(&model.scene, model.clock.tick, bubble));
    let painter = ctx.layer_painter(LayerId::background()).with_clip_rect(picture);
    for (middle, radius) in outlines {
        let at = at(picture, middle);
        painter.circle_stroke(
            at,
            picture.height() * radius as f32 + 2.0,
            Stroke::new(1.0, Color32::from_white_alpha(150)),
        );
    }
}

/// Shows the bubble that the wand blows, and how large it is.
pub fn blown(ctx: &Context, picture: Rect, model: &Model) {
    let Some(Wand { center_m, radius_m }) = model.wand else { return };
    let Some((middle, radius)) = sight::outline(&model.scene.camera, center_m, radius_m) else { return };
    let (middle, radius) = (at(picture, middle), picture.height() * radius as f32);
    let painter = ctx.layer_painter(LayerId::background()).with_clip_rect(picture);
    for stroke in [Stroke::new(3.0, Color32::from_black_alpha(130)), Stroke::new(1.2, Color32::WHITE)] {
        painter.circle_stroke(middle, radius, stroke);
    }
    tag(&painter, Align2::CENTER_CENTER, middle, format!("{:.1} mm", 1e3 * radius_m));
}

fn gesture(ui: &Ui, response: &Response, follow_deg: f64, fingers: Fingers, held: bool) -> Gesture {
    let height = f64::from(response.rect.height()).max(1.0);
    let has_rested = held && !response.is_pointer_button_down_on();
    let drag = match fingers {
        Fingers::One if has_rested => ui.input(|input| input.pointer.delta()),
        Fingers::One => response.drag_delta(),
        Fingers::More(moved) if response.contains_pointer() => moved,
        Fingers::More(_) | Fingers::Left => Vec2::ZERO,
    };
    let drag = DVec2::new(f64::from(drag.x), f64::from(drag.y)) / height;
    let shifts = fingers != Fingers::One
        || ui.input(|input| input.modifiers.shift)
        || !(has_rested || response.dragged_by(PointerButton::Primary));
    let mut gesture = Gesture { frame: response.double_clicked(), ..Gesture::default() };
    *(if shifts { &mut gesture.shift } else { &mut gesture.turn }) = drag;
    if response.hovered() && !ui.input(|input| input.pointer.any_down()) {
        let moved = ui.input(|input| input.pointer.delta());
        // The eye goes where the pointer goes; a drag pulls what one sees.
        gesture.follow = -follow_deg / TURN_DEG * DVec2::new(moved.x.into(), moved.y.into()) / height;
    }
    if response.contains_pointer() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        gesture.zoom = ZOOM_PER_POINT * f64::from(scroll.x + scroll.y) + f64::from(pinch).max(1e-3).ln();
    }
    gesture
}
