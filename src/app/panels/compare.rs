//! The kept picture beside the one that is shown, and the map of how far they are apart.

use std::sync::atomic::Ordering;

use egui::{
    Align2, Area, Color32, Context, Frame, Id, LayerId, Order, ProgressBar, Rect, ScrollArea, Sense, Stroke,
    TextureOptions, Ui, pos2, vec2,
};

use super::{textures::texture, tools};
use crate::app::{
    colour_map::viridis,
    compare::{Compare, MAP_SCALE, Pixels, Side, Want},
    model::Model,
};
use crate::{Words, scene::Quality};

/// Width of what can be done with the pictures, points.
const WIDTH: f32 = 330.0;

/// Shows A left of the split and B right of it, or the map, over the picture; and what can be done with them.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    let Some((kept, _)) = model.compare.kept().cloned() else { return };
    let painter = ctx.layer_painter(LayerId::background());
    let draw = |slot, pixels: &Pixels, clip: Rect| {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let texture = texture(ctx, slot, pixels, TextureOptions::NEAREST);
        painter.with_clip_rect(clip).image(texture.id(), unstretched(picture, pixels.size), whole, Color32::WHITE);
    };
    if let Some(map) = &model.compare.map {
        draw("compared", &map.pixels, picture);
    } else {
        let x = picture.left() + model.compare.split * picture.width();
        if let Some((other, _)) = &model.compare.other {
            draw("other", other, Rect::from_min_max(pos2(x, picture.top()), picture.max));
        }
        draw("compared", &kept, Rect::from_min_max(picture.min, pos2(x, picture.bottom())));
        handle(ctx, picture, x, &mut model.compare);
    }
    // Beside the tools if there is room.
    let room = if picture.width() < tools::WIDTH + WIDTH + 30.0 { tools::room_below(picture) } else { picture };
    let corner = room.right_top() + vec2(-10.0, 10.0);
    let area = Area::new(Id::unique("compare")).fixed_pos(corner).pivot(Align2::RIGHT_TOP).constrain_to(room);
    area.show(ctx, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width((picture.width() - 34.0).clamp(60.0, WIDTH));
            let height = (room.height() - 34.0).max(20.0);
            let scroll = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
            scroll.show(ui, |ui| controls(ui, &mut model.compare));
        });
    });
}

/// Where a picture of a size stands over the one that is shown: as high, for both see the same angle from top to bottom, and unstretched.
fn unstretched(picture: Rect, size: [u32; 2]) -> Rect {
    let aspect = size[0] as f32 / size[1].max(1) as f32;
    // Rounding to whole pixels changes no aspect.
    let is_same = (aspect * picture.height() - picture.width()).abs() < 2.0;
    if is_same { picture } else { Rect::from_center_size(picture.center(), picture.height() * vec2(aspect, 1.0)) }
}

/// The line between A and B, which can be dragged.
fn handle(ctx: &Context, picture: Rect, x: f32, compare: &mut Compare) {
    let area = Area::new(Id::unique("split")).order(Order::Middle).fixed_pos(pos2(x - 5.0, picture.top()));
    area.constrain(false).show(ctx, |ui| {
        let (rect, response) = ui.allocate_exact_size(vec2(10.0, picture.height()), Sense::drag());
        response.widget_info(|| egui::WidgetInfo::slider(true, f64::from(compare.split), "Split"));
        ui.painter().vline(rect.center().x, rect.y_range(), Stroke::new(1.0, Color32::from_white_alpha(200)));
        let moved = response.drag_delta().x / picture.width().max(1.0);
        compare.split = (compare.split + moved).clamp(0.0, 1.0);
        response.on_hover_cursor(egui::CursorIcon::ResizeHorizontal);
    });
}

fn controls(ui: &mut Ui, compare: &mut Compare) {
    let a = compare.kept().map(|(_, name)| name.clone());
    let b = compare.other.as_ref().map(|(_, name)| name.clone());
    side(ui, "A, left", a, Side::A, compare);
    side(ui, "B, right", b, Side::B, compare);
    memory(ui, compare);
    if let Some(done) = compare.done {
        ui.horizontal(|ui| {
            ui.add(ProgressBar::new(done).desired_width(180.0).text(format!("reference: {:.0} %", 100.0 * done)));
            if ui.button("Stop").on_hover_text("Keep the reference picture as fine as it is").clicked() {
                compare.stop.store(true, Ordering::Relaxed);
                compare.done = None;
            }
        });
    }
    ui.horizontal_wrapped(|ui| buttons(ui, compare));
    if let Some(map) = &compare.map {
        ui.label(format!("CIEDE2000: mean {:.3}, 99.9 % of the pixels below {:.2}", map.mean, map.p999));
        ui.horizontal(scale);
    }
}

/// Earlier pictures, to be flipped through.
fn memory(ui: &mut Ui, compare: &mut Compare) {
    let (at, count) = (compare.at, compare.memory.len());
    if count < 2 {
        return;
    }
    ui.horizontal(|ui| {
        let mut step = |text: &str, help: &str, places: isize, is_there: bool| {
            if ui.add_enabled(is_there, egui::Button::new(text).small()).on_hover_text(help).clicked() {
                compare.flip(places);
            }
        };
        step("Earlier", "Show the picture that was kept before as A", -1, at > 0);
        step("Later", "Show the picture that was kept after it as A", 1, at + 1 < count);
        ui.weak(format!("A is picture {} of {count}", at + 1));
    });
}

/// The name of a picture, and the qualities in which it can be made anew.
fn side(ui: &mut Ui, title: &str, name: Option<String>, side: Side, compare: &mut Compare) {
    ui.horizontal(|ui| {
        ui.strong(title);
        ui.menu_button("Quality", |ui| {
            if side == Side::B && ui.button("as it is now").on_hover_text("The picture as it is shown").clicked() {
                (compare.other, compare.map) = (None, None);
            }
            for quality in Quality::ALL {
                if ui.button(quality.name()).on_hover_text(quality.help()).clicked() {
                    compare.wants = Some(Want::Draw(side, quality));
                }
            }
            let help = "The same light path in f64 on the CPU; the clock stands, and the picture grows finer while it is computed";
            // In a browser there is no other thread, and the page would stand still.
            if !cfg!(target_arch = "wasm32") && ui.button("reference").on_hover_text(help).clicked() {
                compare.wants = Some(Want::Reference(side));
            }
        });
        let name = name.unwrap_or_else(|| "as it is now".to_owned());
        ui.add(egui::Label::new(egui::RichText::new(&name).weak()).truncate()).on_hover_text(name);
    });
}

fn buttons(ui: &mut Ui, compare: &mut Compare) {
    if ui.button("Keep").on_hover_text("Keep the picture that is shown as A (K)").clicked() {
        compare.wants = Some(Want::Keep);
    }
    if compare.map.is_some() {
        if ui.button("Split").on_hover_text("Show A and B side by side").clicked() {
            compare.map = None;
        }
    } else if ui
        .button("ΔE map")
        .on_hover_text("Show how far A and B are apart, as people see it (CIEDE2000)")
        .clicked()
    {
        compare.wants = Some(Want::Map);
    }
    if ui.button("Close").on_hover_text("Forget A and B").clicked() {
        compare.close();
    }
}

/// The colours of the map.
fn scale(ui: &mut Ui) {
    ui.weak("0");
    let (rect, _) = ui.allocate_exact_size(vec2(160.0, 10.0), Sense::hover());
    for column in 0..160u8 {
        let [r, g, b] = viridis(f64::from(column) / 159.0);
        let x = rect.left() + f32::from(column);
        ui.painter().vline(x, rect.y_range(), Stroke::new(1.5, Color32::from_rgb(r, g, b)));
    }
    ui.weak(format!("{MAP_SCALE} and more"));
}
