//! The gizmo of the selected bubbles over the picture.

use egui::{Color32, CursorIcon, Id, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2};

use super::places;
use crate::app::{
    gizmo::{self, AXES, Grip, Handle},
    model::Model,
    tools::Tool,
};

/// Length of its arrows, points.
const LENGTH: f32 = 70.0;
/// Radius of its ring, points.
const RING: f32 = 9.0;
/// Size of the square around a handle where the pointer takes it, points.
const REACH: f32 = 20.0;
/// Colours of the axes.
const COLOURS: [Color32; 3] =
    [Color32::from_rgb(235, 80, 80), Color32::from_rgb(90, 200, 90), Color32::from_rgb(90, 140, 250)];
const RING_COLOUR: Color32 = Color32::from_gray(230);
/// Edge around them, which tells them from films of all colours.
const EDGE: Color32 = Color32::from_black_alpha(170);
const EDGE_WIDTH: f32 = 1.5;

/// Shows the gizmo of the bubble that was clicked, and lets the pointer move all selected ones. Tells whether the bubbles shall be framed, as a double
/// click asks wherever it is.
pub fn show(ui: &mut Ui, rect: Rect, model: &mut Model) -> bool {
    let is_wanted = model.outlines && matches!(model.tool, Tool::Orbit | Tool::Drag) && !model.presents;
    let bubble = model.scene.bubbles.get(model.selected).filter(|_| is_wanted && !model.stands_alone);
    let boundary = bubble.map(|bubble| bubble.boundary);
    let height = f64::from(rect.height().max(1.0));
    let shape = boundary.and_then(|boundary| {
        gizmo::shape(&model.scene.camera, model.put_m(model.selected), boundary, f64::from(LENGTH) / height)
    });
    let Some((shape, boundary)) = shape.zip(boundary) else {
        model.gizmo = None;
        return false;
    };
    let center = places::at(rect, shape.center);
    let tips = shape.arrows.iter().map(|(axis, tip)| (Handle::Axis(*axis), places::at(rect, *tip)));
    let handles: Vec<(Handle, Pos2)> = [(Handle::Plane, center)].into_iter().chain(tips).collect();
    let mut frames = false;
    for (handle, at) in handles {
        let response = touched(ui, rect, handle, at);
        frames |= response.double_clicked();
        pull(model, rect, handle, boundary, &response);
        let is_held = model.gizmo.is_some_and(|grip| grip.handle == handle);
        paint(ui, rect, handle, [center, at], is_held || response.hovered());
    }
    frames
}

/// The room of a handle, which the pointer takes.
fn touched(ui: &Ui, picture: Rect, handle: Handle, at: Pos2) -> Response {
    let room = Rect::from_center_size(at, Vec2::splat(REACH)).intersect(picture);
    let response = ui.interact(room, Id::unique(("gizmo", handle)), Sense::click_and_drag());
    let name = match handle {
        Handle::Axis(axis) => format!("Move along {}", AXES[axis].1),
        Handle::Plane => "Move across the view".to_owned(),
    };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    response.on_hover_cursor(CursorIcon::Grab).on_hover_text(name)
}

/// Moves the bubbles with the pointer that holds a handle.
fn pull(model: &mut Model, rect: Rect, handle: Handle, boundary: crate::scene::Boundary, response: &Response) {
    let place = response.interact_pointer_pos().map(|at| places::place(rect, at));
    let Some(at) = place.filter(|_| response.is_pointer_button_down_on()) else {
        model.gizmo = model.gizmo.filter(|grip| grip.handle != handle);
        return;
    };
    match &mut model.gizmo {
        Some(grip) if grip.handle == handle => {
            let by_m = grip.follow(&model.scene.camera, at);
            model.move_selected(by_m);
        }
        _ => model.gizmo = Grip::new(handle, &model.scene.camera, model.put_m(model.selected), boundary, at),
    }
}

fn paint(ui: &Ui, picture: Rect, handle: Handle, [center, at]: [Pos2; 2], is_strong: bool) {
    let painter = ui.painter().with_clip_rect(picture);
    let width = if is_strong { 4.0 } else { 2.5 };
    let draw = |stroke: Stroke| match handle {
        Handle::Axis(_) => {
            // The ring stays free.
            let start = center + RING * (at - center).normalized();
            painter.arrow(start, at - start, stroke);
        }
        Handle::Plane => _ = painter.circle_stroke(center, RING, stroke),
    };
    let colour = if let Handle::Axis(axis) = handle { COLOURS[axis] } else { RING_COLOUR };
    draw(Stroke::new(width + 2.0 * EDGE_WIDTH, EDGE));
    draw(Stroke::new(width, colour));
}
