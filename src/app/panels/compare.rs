//! The kept picture beside the one that is shown, and the map of how far they are apart.

use std::sync::Arc;

use egui::{
    Align2, Area, Color32, ColorImage, Context, Frame, Id, LayerId, Order, Rect, Sense, Stroke, TextureHandle,
    TextureOptions, Ui, pos2, vec2,
};

use crate::app::{
    compare::{Compare, MAP_SCALE, Pixels, Want, map_colour},
    model::Model,
};

/// Where the texture of a slot is remembered, with the pixels that it shows.
type Remembered = (Arc<Vec<u8>>, TextureHandle);

/// Shows the kept picture left of the split, or the map, over the picture; and what can be done with them.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    let Some((kept, name)) = model.compare.kept.clone() else { return };
    let painter = ctx.layer_painter(LayerId::background());
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    if let Some(map) = &model.compare.map {
        painter.with_clip_rect(picture).image(texture(ctx, &map.pixels).id(), picture, whole, Color32::WHITE);
    } else {
        let x = picture.left() + model.compare.split * picture.width();
        let left = Rect::from_min_max(picture.min, pos2(x, picture.bottom()));
        painter.with_clip_rect(left).image(texture(ctx, &kept).id(), picture, whole, Color32::WHITE);
        handle(ctx, picture, x, &mut model.compare);
    }
    let corner = picture.right_top() + vec2(-10.0, 10.0);
    Area::new(Id::unique("compare")).fixed_pos(corner).pivot(Align2::RIGHT_TOP).constrain_to(picture).show(ctx, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| controls(ui, &mut model.compare, &name));
    });
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

fn controls(ui: &mut Ui, compare: &mut Compare, name: &str) {
    ui.horizontal(|ui| {
        ui.strong("A").on_hover_text(name);
        ui.weak("left, kept");
        ui.strong("B");
        ui.weak("right, as it is now");
        if ui.button("Keep B").on_hover_text("Keep the picture that is shown as A (K)").clicked() {
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
        if ui.button("Close").on_hover_text("Forget A").clicked() {
            *compare = Compare::default();
        }
    });
    if let Some(map) = &compare.map {
        ui.label(format!("CIEDE2000: mean {:.3}, 99.9 % of the pixels below {:.2}", map.mean, map.p999));
        ui.horizontal(scale);
    }
}

/// The colours of the map.
fn scale(ui: &mut Ui) {
    ui.weak("0");
    let (rect, _) = ui.allocate_exact_size(vec2(160.0, 10.0), Sense::hover());
    for column in 0..160u8 {
        let [r, g, b] = map_colour(f64::from(column) / 159.0);
        let x = rect.left() + f32::from(column);
        ui.painter().vline(x, rect.y_range(), Stroke::new(1.5, Color32::from_rgb(r, g, b)));
    }
    ui.weak(format!("{MAP_SCALE} and more"));
}

/// The texture of a picture, made when it is first shown.
fn texture(ctx: &Context, pixels: &Pixels) -> TextureHandle {
    let known = ctx.data(|data| data.get_temp::<Remembered>(slot()));
    if let Some((rgba, texture)) = known.filter(|(rgba, _)| Arc::ptr_eq(rgba, &pixels.rgba)) {
        drop(rgba);
        return texture;
    }
    let image = ColorImage::from_rgba_unmultiplied(pixels.size.map(|side| side as usize), &pixels.rgba);
    let texture = ctx.load_texture("compared", image, TextureOptions::NEAREST);
    ctx.data_mut(|data| data.insert_temp(slot(), (pixels.rgba.clone(), texture.clone())));
    texture
}

fn slot() -> Id {
    Id::unique("compared picture")
}

/// Forgets the texture, because the device that held it is lost.
pub fn forget(ctx: &Context) {
    ctx.data_mut(|data| data.remove::<Remembered>(slot()));
}
