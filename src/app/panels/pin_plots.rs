//! The plots of a pinned point, as the probe's window shows them and as files hold them.

use egui::{Align2, Color32, Ui, Vec2, vec2};
use egui_plot::{Bar, BarChart, Line, LineStyle, Plot as Chart, PlotPoint, PlotPoints, PlotUi, Points, Text, VLine};
use glam::{DVec2, DVec3};

use super::plots::with_few_marks;
use crate::{
    app::probe::{Pin, Plot, SpectrumRow},
    physics::{
        colour::{BT709, DISPLAY_P3, RgbSpace, chromaticity_uv, chromaticity_xy, spectral_locus},
        optics::Polarised,
    },
};

const S: Color32 = Color32::from_rgb(90, 160, 230);
const P: Color32 = Color32::from_rgb(230, 150, 80);
const MEAN: Color32 = Color32::from_rgb(110, 190, 110);
const BOTH: Color32 = Color32::from_rgb(200, 120, 200);
const LIGHT: Color32 = Color32::from_gray(125);

/// Draws a plot of a pinned point in a room. `is_uniform`: the diagram of chromaticity of 1976.
pub fn show(ui: &mut Ui, pin: &Pin, plot: Plot, is_uniform: bool, room: Vec2) {
    ui.spacing_mut().item_spacing.y = 2.0;
    match plot {
        Plot::Spectra => spectra(ui, pin, room),
        Plot::Time => time(ui, pin, room),
        Plot::Strip => strip(ui, pin, room),
        Plot::Chromaticity => chromaticity(ui, pin, is_uniform, room),
    }
}

/// A chart that stands still.
fn chart<'a>(name: &'a str, size: Vec2) -> Chart<'a> {
    let chart = Chart::new(name).width(size.x).height(size.y).set_margin_fraction(vec2(0.0, 0.04));
    // Axes of one width, so that wavelengths of several plots stand beneath one another.
    let chart = with_few_marks(chart).y_axis_min_width(44.0);
    chart.allow_drag(false).allow_zoom(false).allow_scroll(false).allow_boxed_zoom(false)
}

fn legend(ui: &mut Ui, entries: &[(&str, Color32)]) {
    ui.horizontal_wrapped(|ui| entries.iter().for_each(|(name, colour)| drop(ui.colored_label(*colour, *name))));
}

/// What walls do with light: that of the nearest, and of both.
type Quantity = fn(&SpectrumRow) -> [Polarised; 2];

/// Reflectance and transmittance against wavelength, side by side where there is room, and the light's spectrum beneath.
fn spectra(ui: &mut Ui, pin: &Pin, room: Vec2) {
    let is_wide = room.x > 480.0;
    let height = (room.y - 44.0).max(90.0);
    let size = if is_wide { vec2(0.5 * room.x - 6.0, 0.7 * height) } else { vec2(room.x, 0.38 * height) };
    let both = |ui: &mut Ui| {
        polarised(ui, "R", pin, size, |row| [row.r, row.r_both]);
        polarised(ui, "T", pin, size, |row| [row.t, row.t_both]);
    };
    if is_wide {
        ui.horizontal(both).inner
    } else {
        both(ui)
    }
    let light = chart("light", vec2(room.x, if is_wide { 0.3 * height } else { 0.24 * height })).include_y(0.0);
    light.y_axis_label("light").show(ui, |plot| {
        plot.line(curve("light", pin, LIGHT, |row| row.light).fill(0.0));
    });
    let walls = [
        ("s", S),
        ("p", P),
        ("unpolarised", MEAN),
        ("both walls; s and p of both dashed", BOTH),
        ("light, over λ in nm", LIGHT),
    ];
    let kept: Vec<_> = walls.into_iter().filter(|(name, _)| !name.starts_with("both walls") || has_two(pin)).collect();
    legend(ui, &kept);
}

fn has_two(pin: &Pin) -> bool {
    pin.reading.walls.len() > 1
}

fn polarised(ui: &mut Ui, name: &str, pin: &Pin, size: Vec2, quantity: Quantity) {
    chart(name, size).y_axis_label(name).show(ui, |plot| {
        plot.line(curve("s", pin, S, |row| quantity(row)[0].s));
        plot.line(curve("p", pin, P, |row| quantity(row)[0].p));
        plot.line(curve("unpolarised", pin, MEAN, |row| quantity(row)[0].mean()));
        if has_two(pin) {
            let dashed = |line: Line<'static>| line.style(LineStyle::dashed_dense()).width(1.0);
            plot.line(dashed(curve("s, both walls", pin, S, |row| quantity(row)[1].s)));
            plot.line(dashed(curve("p, both walls", pin, P, |row| quantity(row)[1].p)));
            plot.line(curve("both walls", pin, BOTH, |row| quantity(row)[1].mean()));
        }
    });
}

fn curve<'a>(name: &str, pin: &Pin, colour: Color32, value: impl Fn(&SpectrumRow) -> f64) -> Line<'a> {
    let points: PlotPoints<'_> = pin.spectrum.iter().map(|row| [row.wavelength_nm, value(row)]).collect();
    Line::new(name, points).color(colour)
}

/// Thickness against time.
fn time(ui: &mut Ui, pin: &Pin, room: Vec2) {
    let names = [("front wall", S), ("back wall", P)];
    let shown = &names[..1 + usize::from(has_two(pin))];
    let time = chart("time", vec2(room.x, room.y - 24.0)).x_axis_label("time, s").y_axis_label("thickness, nm");
    time.show(ui, |plot| {
        for (wall, (name, colour)) in shown.iter().enumerate() {
            let samples = pin.history.iter().filter_map(|sample| Some([sample.time_s, sample.thickness_nm[wall]?]));
            let samples: Vec<_> = samples.collect();
            plot.points(Points::new(*name, samples.clone()).color(*colour).radius(1.5));
            plot.line(Line::new(*name, samples).color(*colour));
        }
    });
    legend(ui, shown);
}

/// The colours of all thicknesses, with marks at the walls.
fn strip(ui: &mut Ui, pin: &Pin, room: Vec2) {
    let step_nm = pin.strip[1].thickness_nm;
    let bars = pin.strip.iter().map(|film| {
        let [r, g, b] = film.swatch;
        // Bars reach over their neighbours: between edges that only meet, the ground would show through.
        Bar::new(film.thickness_nm, 1.0)
            .width(2.0 * step_nm)
            .fill(Color32::from_rgb(r, g, b))
            .stroke(egui::Stroke::NONE)
    });
    let bars: Vec<_> = bars.collect();
    let strip = chart("strip", vec2(room.x, (room.y - 24.0).min(130.0))).x_axis_label("thickness, nm");
    strip.show_axes([true, false]).show_grid(false).include_y(1.45).show(ui, |plot| {
        plot.bar_chart(BarChart::new("film", bars).allow_hover(false));
        for wall in &pin.reading.walls {
            let text = plot.ctx().global_style().visuals.strong_text_color();
            plot.vline(VLine::new(wall.name(), wall.thickness_nm).color(text));
            // One above the other, for walls may be equally thick.
            let (name, height) = if wall.is_front { ("front", 1.32) } else { ("back", 1.1) };
            plot.text(Text::new(wall.name(), PlotPoint::new(wall.thickness_nm, height), name).color(text));
        }
    });
    let angle_deg = pin.reading.walls[0].angle_deg();
    ui.weak(format!("at {angle_deg:.1}°, under {}; the brightest film is white", pin.reading.optics.illuminant.name()));
}

/// The diagram of chromaticity: spectral locus, triangles of sRGB and Display P3, the films of the strip, and the walls.
fn chromaticity(ui: &mut Ui, pin: &Pin, is_uniform: bool, room: Vec2) {
    let project = if is_uniform { chromaticity_uv } else { chromaticity_xy };
    let names = if is_uniform { ["u'", "v'"] } else { ["x", "y"] };
    // Below stand the legend and a line for each wall.
    let height = (room.y - 44.0 - 22.0 * pin.reading.walls.len() as f32).max(120.0);
    let diagram = chart("chromaticity", vec2(room.x.min(1.25 * height), height)).data_aspect(1.0);
    let diagram = diagram.include_x(0.0).include_x(0.7).include_y(0.0).include_y(if is_uniform { 0.62 } else { 0.86 });
    diagram.x_axis_label(names[0]).y_axis_label(names[1]).show(ui, |plot| {
        locus(plot, project);
        triangle(plot, "sRGB", &BT709, MEAN, project);
        triangle(plot, "Display P3", &DISPLAY_P3, P, project);
        let films = pin.strip.iter().filter(|film| film.xyz.y > 0.0).map(|film| project(film.xyz).to_array());
        plot.line(Line::new("films", films.collect::<Vec<_>>()).color(S));
        for wall in &pin.reading.walls {
            let [r, g, b] = wall.swatch;
            let at = || vec![project(wall.xyz).to_array()];
            plot.points(Points::new(wall.name(), at()).color(LIGHT).radius(6.0));
            plot.points(Points::new(wall.name(), at()).color(Color32::from_rgb(r, g, b)).radius(4.5));
        }
    });
    legend(ui, &[("spectral locus", LIGHT), ("sRGB", MEAN), ("Display P3", P), ("films of all thicknesses", S)]);
    for wall in &pin.reading.walls {
        let DVec2 { x, y } = project(wall.xyz);
        ui.label(format!("{}: {} {x:.4}, {} {y:.4}", wall.name(), names[0], names[1]));
    }
}

/// The colours of light of one wavelength, closed by the line of purples, with some wavelengths in nm.
fn locus(plot: &mut PlotUi<'_>, project: fn(DVec3) -> DVec2) {
    let locus = spectral_locus();
    let mut outline: Vec<_> = locus.iter().map(|(_, xyz)| project(*xyz).to_array()).collect();
    outline.extend(outline.first().copied());
    plot.line(Line::new("spectral locus", outline).color(LIGHT));
    for (nm, xyz) in locus.iter().filter(|(nm, _)| [460.0, 480.0, 500.0, 520.0, 550.0, 580.0, 620.0].contains(nm)) {
        let at = project(*xyz);
        let side = if at.x < 0.2 { Align2::LEFT_CENTER } else { Align2::LEFT_BOTTOM };
        plot.text(Text::new("wavelength", PlotPoint::new(at.x, at.y), format!(" {nm}")).color(LIGHT).anchor(side));
    }
}

fn triangle(plot: &mut PlotUi<'_>, name: &str, space: &RgbSpace, colour: Color32, project: fn(DVec3) -> DVec2) {
    let [r, g, b] = space.primaries().map(|xyz| project(xyz).to_array());
    plot.line(Line::new(name, vec![r, g, b, r]).color(colour).style(LineStyle::dashed_dense()));
}
