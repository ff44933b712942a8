//! The probe's numbers: a card beside the pointer, and a window with spectra for what was clicked.

use egui::{Align2, Area, Color32, Context, Frame, Grid, Id, Rect, Sense, Ui, Window, vec2};
use egui_plot::{Line, Plot, PlotPoints};

use crate::app::{
    model::Model,
    probe::{Reading, SpectrumRow, WallReading},
    request::{Request, Target},
};

/// Shows what the probe has found, over the picture.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    let place = ctx.pointer_hover_pos().filter(|place| picture.contains(*place));
    if let (Some(reading), Some(place)) = (&model.probe.hover, place) {
        // On the side where there is room.
        let to_left = place.x > picture.center().x;
        let (pivot, away) = if to_left { (Align2::RIGHT_TOP, -16.0) } else { (Align2::LEFT_TOP, 16.0) };
        let area = Area::new(Id::unique("probe card")).fixed_pos(place + vec2(away, 16.0)).pivot(pivot);
        area.interactable(false)
            .constrain_to(picture)
            .show(ctx, |ui| Frame::popup(ui.style()).show(ui, |ui| numbers(ui, reading)));
    }
    pinned(ctx, picture, model);
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

fn pinned(ctx: &Context, picture: Rect, model: &mut Model) {
    let Some((reading, spectrum)) = &model.probe.pinned else { return };
    let mut is_open = true;
    let corner = picture.left_top() + vec2(10.0, 52.0);
    let window = Window::new("Probe").id(Id::unique("probe")).open(&mut is_open).resizable(false).default_pos(corner);
    // The tools stand above.
    let room = Rect::from_min_max(picture.min + vec2(0.0, 46.0), picture.max);
    window.constrain_to(room).show(ctx, |ui| {
        numbers(ui, reading);
        spectra(ui, spectrum, reading.walls.len() > 1, picture);
        ui.horizontal(|ui| {
            if ui.button("Copy").on_hover_text("Copy the numbers").clicked() {
                ui.ctx().copy_text(reading.text());
            }
            if ui.button("CSV…").on_hover_text("Save numbers and spectra as comma-separated values").clicked() {
                model.requests.push(Request::Ask(Target::SaveCsv));
            }
        });
    });
    if !is_open {
        model.probe.pinned = None;
    }
}

/// A curve of the plot: its name, its colour, and its value in a row.
type Curve = (&'static str, Color32, fn(&SpectrumRow) -> f64);

/// The curves, that of both walls last.
const CURVES: [Curve; 4] = [
    ("R, s", Color32::from_rgb(90, 160, 230), |row| row.r.s),
    ("R, p", Color32::from_rgb(230, 150, 80), |row| row.r.p),
    ("R", Color32::from_rgb(110, 190, 110), |row| row.r.mean()),
    ("R of both walls", Color32::from_rgb(200, 120, 200), |row| row.both[0]),
];
const LIGHT: Color32 = Color32::from_gray(125);

/// Reflectance and transmittance against wavelength, over the light's spectrum.
fn spectra(ui: &mut Ui, rows: &[SpectrumRow], two_walls: bool, picture: Rect) {
    let curves = &CURVES[..CURVES.len() - usize::from(!two_walls)];
    let brightest = rows.iter().map(|row| row.both[0].max(row.r.s)).fold(0.01, f64::max);
    let line = |name: &str, colour: Color32, value: &dyn Fn(&SpectrumRow) -> f64| {
        let points: PlotPoints<'_> = rows.iter().map(|row| [row.wavelength_nm, value(row)]).collect();
        Line::new(name, points).color(colour)
    };
    let plot = Plot::new("spectra").width(320.0).height((0.28 * picture.height()).clamp(70.0, 150.0)).include_y(0.0);
    plot.allow_drag(false).allow_zoom(false).allow_scroll(false).allow_boxed_zoom(false).show(ui, |plot| {
        // The light in the scale of the reflectances: only its shape counts.
        plot.line(line("light", LIGHT, &|row| brightest * row.light).fill(0.0));
        curves.iter().for_each(|(name, colour, value)| plot.line(line(name, *colour, value)));
    });
    ui.horizontal(|ui| {
        curves.iter().for_each(|(name, colour, _)| drop(ui.colored_label(*colour, *name)));
        ui.colored_label(LIGHT, "light, over nm");
    });
    let middle = &rows[rows.len() / 2];
    let both = if two_walls { format!(", through both walls {:.4}", middle.both[1]) } else { String::new() };
    ui.weak(format!("T at {:.0} nm: {:.4}{both}", middle.wavelength_nm, middle.t));
}
