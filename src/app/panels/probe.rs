//! The probe's numbers: a card beside the pointer, and a window with plots for what was clicked.

use egui::{
    Align2, Area, Color32, Context, Frame, Grid, Id, LayerId, Rect, ScrollArea, Sense, Stroke, Ui, Window, vec2,
};

use super::{pin_plots, places, tools};
use crate::Words;
use crate::app::{
    model::Model,
    probe::{Pin, Plot, Probe, Reading, WallReading},
    request::{Request, Target},
    sight,
};
use crate::physics::colour::chromaticity_xy;

/// Shows what the probe has found, over the picture.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    mark(ctx, picture, model);
    pinned(ctx, picture, model);
    let place = ctx.pointer_hover_pos().filter(|place| picture.contains(*place));
    let (Some(reading), Some(place)) = (&model.probe.hover, place) else { return };
    let id = Id::unique("probe card");
    let [card, window] = [id, Id::unique("probe")].map(|id| ctx.memory(|memory| memory.area_rect(id)));
    let window = window.filter(|_| model.probe.pinned.is_some());
    let size = card.map_or(vec2(0.0, 0.0), |card| card.size());
    // On the side where there is room.
    let on_left = Rect::from_min_size(place + vec2(-16.0 - size.x, 16.0), size);
    let to_left = place.x > picture.center().x && !window.is_some_and(|window| window.intersects(on_left));
    let (pivot, away) = if to_left { (Align2::RIGHT_TOP, -16.0) } else { (Align2::LEFT_TOP, 16.0) };
    let area = Area::new(id).fixed_pos(place + vec2(away, 16.0)).pivot(pivot);
    area.interactable(false)
        .constrain_to(picture)
        .show(ctx, |ui| Frame::popup(ui.style()).show(ui, |ui| numbers(ui, reading)));
}

/// The numbers of each wall, in columns.
fn numbers(ui: &mut Ui, reading: &Reading) {
    ui.strong(format!("{} at {:.2} s", reading.bubble, reading.time_s));
    Grid::new("probe").num_columns(1 + reading.walls.len()).spacing([14.0, 2.0]).show(ui, |ui| {
        let mut row = |name: &str, value: &dyn Fn(&WallReading) -> String| {
            ui.weak(name);
            reading.walls.iter().for_each(|wall| drop(ui.monospace(value(wall))));
            ui.end_row();
        };
        row("", &|wall| wall.name().to_owned());
        row("thickness", &|wall| format!("{:.1} nm", wall.thickness_nm));
        row("angle", &|wall| format!("{:.1}°", wall.angle_deg()));
        row("path", &|wall| format!("{:.0} nm", wall.path_nm));
        row("order", &|wall| wall.order().to_string());
        row("flow", &|wall| wall.speed_m_s.map_or("?".to_owned(), |speed| format!("{:.1} mm/s", 1e3 * speed)));
        row("flows to", &|wall| wall.flow_deg.map_or("-".to_owned(), |deg| format!("{deg:.0}°")));
        row("x, y", &|wall| {
            let xy = chromaticity_xy(wall.xyz);
            format!("{:.3}, {:.3}", xy.x, xy.y)
        });
        row("Y", &|wall| format!("{:.2} %", 100.0 * wall.xyz.y));
        ui.weak("colour");
        for wall in &reading.walls {
            let [r, g, b] = wall.swatch;
            let (rect, swatch) = ui.allocate_exact_size(vec2(64.0, 14.0), Sense::hover());
            ui.painter().rect_filled(rect, 2.0, Color32::from_rgb(r, g, b));
            swatch.on_hover_text(
                "The colour of white light that this wall reflects, exposed so that the brightest film is white",
            );
        }
        ui.end_row();
    });
}

/// A cross at the place of the nearest wall that was clicked, which moves with the bubble.
fn mark(ctx: &Context, picture: Rect, model: &Model) {
    let Some(Pin { places: (film, walls), .. }) = &model.probe.pinned else { return };
    let (Some(bubble), Some(wall)) = (model.scene.bubbles.get(*film), walls.first()) else { return };
    let center_m = model.scene.center_m(*film, model.clock.time_s(&model.scene.motion));
    let Some(at) = sight::place(&model.scene.camera, center_m + 1e-3 * bubble.radius_mm * *wall) else { return };
    let (at, painter) = (places::at(picture, at), ctx.layer_painter(LayerId::background()).with_clip_rect(picture));
    for stroke in [Stroke::new(3.0, Color32::from_black_alpha(150)), Stroke::new(1.2, Color32::WHITE)] {
        for way in [vec2(7.0, 0.0), vec2(0.0, 7.0)] {
            painter.line_segment([at - way, at - 0.35 * way], stroke);
            painter.line_segment([at + 0.35 * way, at + way], stroke);
        }
    }
}

/// The window of what was clicked: its numbers, its plots, and ways to take them along.
fn pinned(ctx: &Context, picture: Rect, model: &mut Model) {
    let Model { probe: Probe { pinned, plot, is_uniform, .. }, requests, .. } = model;
    let Some(pin) = pinned else { return };
    let mut is_open = true;
    let corner = picture.left_top() + vec2(10.0, 52.0);
    let window = Window::new("Probe").id(Id::unique("probe")).open(&mut is_open).resizable(false).default_pos(corner);
    let room = tools::room_below(picture);
    window.constrain_to(room).show(ctx, |ui| {
        let width = (picture.width() - 40.0).clamp(120.0, 340.0);
        // As high as it may be from the first frame on: a window that grows by and by would hide what stands below.
        let height = (room.height() - 76.0).max(60.0);
        let scroll = ScrollArea::vertical().max_height(height).min_scrolled_height(height).max_width(width + 12.0);
        scroll.show(ui, |ui| {
            ui.set_width(width);
            numbers(ui, &pin.reading);
            choices(ui, plot, is_uniform);
            let height = (0.4 * room.height()).clamp(150.0, 300.0);
            pin_plots::show(ui, pin, *plot, *is_uniform, vec2(width, height));
        });
        ui.horizontal(|ui| buttons(ui, pin, *plot, requests));
    });
    if !is_open {
        *pinned = None;
    }
}

/// Which plot is shown.
fn choices(ui: &mut Ui, plot: &mut Plot, is_uniform: &mut bool) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for choice in Plot::ALL {
            ui.selectable_value(plot, choice, choice.name()).on_hover_text(choice.help());
        }
    });
    if *plot == Plot::Chromaticity {
        ui.horizontal(|ui| {
            ui.selectable_value(is_uniform, false, "CIE 1931 x, y");
            ui.selectable_value(is_uniform, true, "CIE 1976 u', v'").on_hover_text("Equal distances look more alike");
        });
    }
}

fn buttons(ui: &mut Ui, pin: &Pin, plot: Plot, requests: &mut Vec<Request>) {
    if ui.button("Copy").on_hover_text("Copy the numbers").clicked() {
        ui.ctx().copy_text(pin.reading.text());
    }
    let mut ask = |target| requests.push(Request::Ask(target));
    if ui.button("CSV…").on_hover_text("Save the numbers and this plot as comma-separated values").clicked() {
        ask(Target::SaveCsv(plot));
    }
    if ui.button("PNG…").on_hover_text("Save this plot as a picture").clicked() {
        ask(Target::SavePlot(plot));
    }
}
