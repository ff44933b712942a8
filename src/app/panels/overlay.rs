//! False colour over the picture with its scale, and the profile of the film along a line.

use egui::{
    Align2, Area, Color32, Context, Frame, Id, LayerId, Rect, Sense, Stroke, TextureOptions, Ui, Window, pos2, vec2,
};
use egui_plot::{Line, LineStyle, Plot, Points};

use super::{hints, places::at, plots::with_few_marks, textures::texture, tools, widgets::choice_of};
use crate::{
    Words,
    app::{
        model::Model,
        overlay::{FalseColour, Map, Overlay, Profile, Streamlines},
        request::{Request, Target},
    },
};

const FILM: Color32 = Color32::from_rgb(90, 160, 230);
const LAW: Color32 = Color32::from_rgb(230, 150, 80);

/// The rows of the panel that choose what is laid over the picture.
pub fn choices(ui: &mut Ui, overlay: &mut Overlay) {
    choice_of(ui, "False colour", &mut overlay.of, FalseColour::CHOICES);
    ui.checkbox(&mut overlay.shows_streamlines, "Streamlines")
        .on_hover_text("Lines along which the front wall flows at this moment; arrows show the direction");
    ui.weak("Draw a line over the bubble with the tool Profile (7) to see thickness against height.");
}

/// Shows what is laid over the picture.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    let overlay = &model.overlay;
    if let Some(map) = overlay.map.as_ref().filter(|map| map.of == overlay.of) {
        let painter = ctx.layer_painter(LayerId::background()).with_clip_rect(picture);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let texture = texture(ctx, "false colour", &map.pixels, TextureOptions::LINEAR);
        painter.image(texture.id(), picture, whole, Color32::WHITE);
        let corner = pos2(picture.right() - 10.0, hints::floor(ctx, picture) - 10.0);
        let area = Area::new(Id::unique("scale")).fixed_pos(corner).pivot(Align2::RIGHT_BOTTOM).constrain_to(picture);
        area.show(ctx, |ui| Frame::popup(ui.style()).show(ui, |ui| scale(ui, map)));
    }
    streamlines(ctx, picture, &overlay.streamlines);
    profile(ctx, picture, model);
}

/// White lines with a dark edge, which are seen on any film, each with an arrow in its middle.
fn streamlines(ctx: &Context, picture: Rect, lines: &Streamlines) {
    let painter = ctx.layer_painter(LayerId::background()).with_clip_rect(picture);
    let strokes = [Stroke::new(2.6, Color32::from_black_alpha(90)), Stroke::new(1.1, Color32::from_white_alpha(190))];
    for line in &lines.0 {
        let points: Vec<_> = line.iter().map(|place| at(picture, *place)).collect();
        let middle = points.len() / 2;
        let way = (points[middle] - points[middle.saturating_sub(2)]).normalized();
        let barb = |side: f32| points[middle] - 5.0 * way + side * 3.0 * way.rot90();
        let arrow = vec![barb(1.0), points[middle], barb(-1.0)];
        for stroke in strokes {
            painter.line(points.clone(), stroke);
            painter.line(arrow.clone(), stroke);
        }
    }
}

/// The colours with the numbers that they stand for.
fn scale(ui: &mut Ui, map: &Map) {
    let Map { scale: [low, high], of, .. } = map;
    ui.label(format!("{} of the front wall, {}", of.name(), of.unit()));
    ui.horizontal(|ui| {
        ui.monospace(number(*low));
        let (rect, _) = ui.allocate_exact_size(vec2(140.0, 10.0), Sense::hover());
        for column in 0..140u8 {
            let [r, g, b] = of.colour(f64::from(column) / 139.0);
            let x = rect.left() + f32::from(column);
            ui.painter().vline(x, rect.y_range(), Stroke::new(1.5, Color32::from_rgb(r, g, b)));
        }
        ui.monospace(number(*high));
    });
}

/// A number to six digits, without zeros at its end.
fn number(value: f64) -> String {
    format!("{}", (1e6 * value).round() / 1e6)
}

/// The line over the picture, and the window with the profile along it.
fn profile(ctx: &Context, picture: Rect, model: &mut Model) {
    let Some(profile) = &model.overlay.profile else { return };
    let painter = ctx.layer_painter(LayerId::background()).with_clip_rect(picture);
    painter.line_segment(profile.ends.map(|end| at(picture, end)), Stroke::new(1.5, Color32::from_white_alpha(220)));
    let mut is_open = true;
    let window = Window::new("Profile").id(Id::unique("profile")).open(&mut is_open).resizable(false);
    let corner = picture.left_bottom() + vec2(10.0, -10.0);
    let room = tools::room_below(picture);
    window.default_pos(corner).pivot(Align2::LEFT_BOTTOM).constrain_to(room).show(ctx, |ui| {
        ui.set_width((picture.width() - 40.0).clamp(120.0, 320.0));
        chart(ui, profile, (0.4 * picture.height()).clamp(110.0, 220.0));
        ui.horizontal(|ui| {
            if ui.button("CSV…").on_hover_text("Save the profile as comma-separated values").clicked() {
                model.requests.push(Request::Ask(Target::SaveProfile));
            }
            if ui.button("PNG…").on_hover_text("Save this plot as a picture").clicked() {
                model.requests.push(Request::Ask(Target::SaveProfilePlot));
            }
        });
    });
    if !is_open {
        model.overlay.profile = None;
    }
}

/// Thickness against height, with the law of drainage beside it and a legend below.
pub fn chart(ui: &mut Ui, profile: &Profile, height: f32) {
    let film =
        || profile.points.iter().map(|(_, front)| [front.thickness_nm, 1e3 * front.height_m]).collect::<Vec<_>>();
    let plot = with_few_marks(Plot::new("profile")).height(height).include_x(0.0);
    let plot = plot.x_axis_label("thickness, nm").y_axis_label("height, mm");
    plot.allow_drag(false).allow_zoom(false).allow_scroll(false).allow_boxed_zoom(false).show(ui, |plot| {
        plot.line(Line::new("film", film()).color(FILM));
        plot.points(Points::new("film", film()).color(FILM).radius(1.2));
        plot.line(Line::new("drainage", profile.drained()).color(LAW).style(LineStyle::dashed_loose()));
    });
    ui.colored_label(FILM, format!("front wall at {:.2} s", profile.time_s));
    let law = format!("drainage alone, from {:.0} nm everywhere", profile.blown_nm);
    ui.colored_label(LAW, law).on_hover_text(
        "What the upper half would be if water only drained between two immobile layers of soap: 1/h² − 1/h₀² = ρ g t / (3 μ R) at the top",
    );
}
