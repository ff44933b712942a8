//! The spectrum of the light: a plot whose points can be dragged, and their numbers.

use std::sync::{Arc, LazyLock};

use egui::{
    Align2, CollapsingHeader, Color32, DragValue, FontId, Mesh, Pos2, Rect, Response, ScrollArea, Sense, Shape, Stroke,
    Ui, pos2, vec2,
};

use super::widgets::group;
use crate::{
    app::{
        model::Model,
        request::Request,
        spectrum::{self, Band},
    },
    physics::{
        colour::{BT709, ColourWeights, Illuminant, Observer, chromaticity_xy, correlated_temperature_k, srgb_encode},
        spectra::{FIRST_NM, LAST_NM, SAMPLES, wavelength_nm},
    },
    scene::{Light, LightSpectrum},
};

/// Height of the plot, points.
const HEIGHT: f32 = 130.0;
/// Height of the visible colours below it, and of the wavelengths below these.
const STRIP: f32 = 9.0;
const LABELS: f32 = 14.0;
/// How near to a point the pointer must be to take hold of it, points.
const REACH: f32 = 10.0;
/// What the largest power leaves free above it, as a part of it.
const HEADROOM: f64 = 0.1;
/// Rows of numbers that are seen at once.
const ROWS: f32 = 6.0;

/// How far a change is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    /// Nothing has changed.
    None,
    /// Something is being dragged.
    Held,
    /// It was let go, or changed at once.
    Done,
}

impl Step {
    fn and(self, other: Self) -> Self {
        if self == Self::None { other } else { self }
    }
}

/// Shows and edits the spectrum of the light, folded at first.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let fold = CollapsingHeader::new("Spectrum").default_open(false);
    fold.show_unindented(ui, |ui| body(ui, model)).header_response.on_hover_text("The spectral power of the light");
}

fn body(ui: &mut Ui, model: &mut Model) {
    let is_dragging = ui.input(|input| input.pointer.any_down() || input.pointer.any_released());
    if !is_dragging && !model.loads_light() {
        model.spectrum.draft = None;
    }
    let before = model.spectrum.draft.clone().unwrap_or_else(|| model.scene.light.spectrum.clone());
    let mut points = before.clone();
    let light = match &points {
        // Points that no light can have are told when they are let go.
        Some(points) => points.illuminant().map_or_else(|_| model.resources.illuminant.clone(), Arc::new),
        None => model.resources.illuminant.clone(),
    };
    let mut step = plot(ui, points.as_mut(), &light, &mut model.spectrum.held);
    step = step.and(buttons(ui, &mut points, &light, &model.scene.light.illuminant));
    step = step.and(band(ui, &mut points, &mut model.spectrum.band));
    if let Some(points) = &mut points {
        step = step.and(numbers(ui, points));
    }
    white(ui, &light);
    match step {
        Step::None => {}
        Step::Held => model.spectrum.draft = Some(points),
        Step::Done => load(model, points),
    }
}

/// Asks for the light of a spectrum, once it was let go: a drag is one step to undo.
fn load(model: &mut Model, points: Option<LightSpectrum>) {
    if let Some(Err(error)) = points.as_ref().map(LightSpectrum::illuminant) {
        model.messages.problem(error.to_string());
        model.spectrum.draft = None;
        return;
    }
    model.spectrum.draft = Some(points.clone());
    if points != model.scene.light.spectrum || model.loading.is_some() {
        let light = Light { spectrum: points, ..model.scene.light.clone() };
        model.requests.push(Request::LoadLight(light));
    }
}

/// Turns a light with a name into points, and back.
fn buttons(ui: &mut Ui, points: &mut Option<LightSpectrum>, light: &Illuminant, named: &str) -> Step {
    let mut step = Step::None;
    ui.horizontal(|ui| match points {
        None => {
            let help = "Turn the spectrum into points that can be dragged; they are saved in the scene";
            if ui.button("Edit").on_hover_text(help).clicked() {
                *points = Some(spectrum::resampled(light));
                step = Step::Done;
            }
        }
        Some(known) => {
            if ui.button("Add point").on_hover_text("In the widest gap; or double click in the plot").clicked()
                && spectrum::add_in_gap(known)
            {
                step = Step::Done;
            }
            let back = ui.button(format!("Back to {named}"));
            if back.on_hover_text("Leave the points out of the scene again").clicked() {
                *points = None;
                step = Step::Done;
            }
        }
    });
    step
}

/// The row that sets a single band.
fn band(ui: &mut Ui, points: &mut Option<LightSpectrum>, band: &mut Band) -> Step {
    let mut is_set = false;
    group(ui, "Band", |ui| {
        let number = DragValue::new(&mut band.center_nm).range(Band::CENTERS_NM).suffix(" nm").max_decimals(1);
        ui.add(number).on_hover_text("Wavelength of the peak");
        let number = DragValue::new(&mut band.width_nm).range(Band::WIDTHS_NM).suffix(" nm").max_decimals(1);
        ui.add(number).on_hover_text("Full width at half of the peak");
        is_set = ui.button("Set").on_hover_text("Light of this band alone").clicked();
    });
    if !is_set {
        return Step::None;
    }
    *points = Some(band.spectrum());
    Step::Done
}

/// The points as numbers: all that the plot can do, for the keyboard.
fn numbers(ui: &mut Ui, points: &mut LightSpectrum) -> Step {
    let height = ui.spacing().interact_size.y;
    let title = format!("Points ({})", points.power.len());
    let fold = CollapsingHeader::new(title).id_salt("points").default_open(false);
    let shown = fold.show_unindented(ui, |ui| {
        let list = ScrollArea::vertical().id_salt("list of points").max_height(ROWS * height);
        let mut step = Step::None;
        list.show_rows(ui, height, points.power.len(), |ui, rows| {
            // Rows beyond the last point are gone after one was removed.
            for index in rows {
                if index < points.power.len() {
                    step = step.and(row(ui, points, index));
                }
            }
        });
        step
    });
    shown.body_returned.unwrap_or(Step::None)
}

fn row(ui: &mut Ui, points: &mut LightSpectrum, index: usize) -> Step {
    let largest = spectrum::largest(points);
    let (mut nm, mut power) = (points.wavelengths_nm[index], points.power[index]);
    ui.horizontal(|ui| {
        let label = ui.label(format!("Point {}", index + 1));
        let room = spectrum::room_nm(points, index);
        let number = DragValue::new(&mut nm).range(room).suffix(" nm").speed(0.5).max_decimals(1);
        let wavelength = ui.add(number).labelled_by(label.id).on_hover_text("Wavelength");
        let number = DragValue::new(&mut power).range(0.0..=1e12).speed(0.01 * largest).max_decimals(6);
        let height = ui.add(number).labelled_by(label.id).on_hover_text("Power");
        let remove = ui.small_button("×").on_hover_text(format!("Remove point {}", index + 1));
        if remove.clicked() && spectrum::remove(points, index) {
            return Step::Done;
        }
        let both = [&wavelength, &height];
        if both.iter().any(|number| number.changed()) {
            spectrum::put(points, index, (nm, power), largest.max(power));
        }
        step_of(&both)
    })
    .inner
}

/// How far the change of some numbers is.
fn step_of(numbers: &[&Response]) -> Step {
    if numbers.iter().any(|number| number.dragged()) {
        Step::Held
    } else if numbers.iter().any(|number| number.changed() || number.drag_stopped()) {
        Step::Done
    } else {
        Step::None
    }
}

/// Chromaticity and temperature of the light.
fn white(ui: &mut Ui, light: &Illuminant) {
    let xyz = ColourWeights::new(light).white();
    let at = chromaticity_xy(xyz);
    let temperature = correlated_temperature_k(xyz).map_or(String::new(), |kelvin| format!(", {kelvin:.0} K"));
    let help = "Chromaticity of the light (CIE 1931) and, if it is nearly white, its correlated colour temperature";
    ui.weak(format!("x {:.4}, y {:.4}{temperature}", at.x, at.y)).on_hover_text(help);
}

/// The place of the plot, and the scale of its axes.
struct Axes {
    rect: Rect,
    /// The power at the upper edge.
    top: f64,
}

impl Axes {
    fn x(&self, nm: f64) -> f32 {
        let part = (nm - FIRST_NM) / (LAST_NM - FIRST_NM);
        self.rect.left() + self.rect.width() * part as f32
    }

    fn at(&self, (nm, power): (f64, f64)) -> Pos2 {
        pos2(self.x(nm), self.rect.bottom() - self.rect.height() * (power / self.top).min(1.0) as f32)
    }

    /// The wavelength and the power at a place.
    fn value(&self, at: Pos2) -> (f64, f64) {
        let part = (at - self.rect.left_bottom()) / self.rect.size();
        let [along, up] = [f64::from(part.x), f64::from(-part.y)].map(|part| part.clamp(0.0, 1.0));
        (FIRST_NM + along * (LAST_NM - FIRST_NM), up * self.top)
    }

    /// The point next to a place, if one is near.
    fn nearest(&self, points: &LightSpectrum, place: Pos2) -> Option<usize> {
        let far = points.points().map(|point| self.at(point).distance(place)).enumerate();
        let near = far.filter(|(_, far)| *far <= REACH).min_by(|a, b| a.1.total_cmp(&b.1));
        near.map(|(index, _)| index)
    }
}

/// The plot. Points can be dragged, added by a double click, and removed by a right click.
fn plot(
    ui: &mut Ui,
    mut points: Option<&mut LightSpectrum>,
    light: &Illuminant,
    held: &mut Option<(usize, f64)>,
) -> Step {
    let (whole, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Plot of the spectrum"));
    let rect = Rect::from_min_max(whole.min, whole.max - vec2(0.0, STRIP + LABELS)).shrink2(vec2(6.0, 4.0));
    let largest =
        points.as_deref().map_or_else(|| spectrum::sampled(light).into_iter().fold(0.0, f64::max), spectrum::largest);
    let top = held.map_or((1.0 + HEADROOM) * largest, |(_, top)| top).max(f64::MIN_POSITIVE);
    let axes = Axes { rect, top };
    let step = points.as_deref_mut().map_or(Step::None, |points| touch(ui, points, &axes, &response, held));
    paint(ui, &axes, light, points.as_deref(), held.map(|(index, _)| index));
    if points.is_some() {
        // A tooltip would hide the points.
        ui.small("Drag points; double click adds one, right click removes it");
    }
    step
}

fn touch(
    ui: &Ui,
    points: &mut LightSpectrum,
    axes: &Axes,
    response: &Response,
    held: &mut Option<(usize, f64)>,
) -> Step {
    let Some(at) = response.interact_pointer_pos() else {
        *held = None;
        return Step::None;
    };
    let near = |at| axes.nearest(points, at);
    if response.double_clicked() && near(at).is_none() {
        return if spectrum::add(points, axes.value(at)) { Step::Done } else { Step::None };
    }
    if response.secondary_clicked() {
        let is_gone = near(at).is_some_and(|index| spectrum::remove(points, index));
        return if is_gone { Step::Done } else { Step::None };
    }
    if response.drag_started_by(egui::PointerButton::Primary) {
        let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(at);
        *held = near(from).map(|index| (index, axes.top));
    }
    let Some((index, top)) = *held else { return Step::None };
    if index >= points.power.len() {
        *held = None;
        return Step::None;
    }
    spectrum::put(points, index, axes.value(at), top);
    if response.drag_stopped() {
        *held = None;
        return Step::Done;
    }
    Step::Held
}

fn paint(ui: &Ui, axes: &Axes, light: &Illuminant, points: Option<&LightSpectrum>, held: Option<usize>) {
    let (painter, rect) = (ui.painter(), axes.rect);
    let (text, weak) = (ui.visuals().strong_text_color(), ui.visuals().weak_text_color());
    let powers = spectrum::sampled(light);
    let mut mesh = Mesh::default();
    for (i, (power, colour)) in powers.iter().zip(COLOURS.iter()).enumerate() {
        let at = axes.at((wavelength_nm(i), *power));
        let below = rect.bottom() + STRIP;
        // The visible colours are paler than the light above them.
        [(at.y, 0.75), (rect.bottom(), 0.75), (rect.bottom(), 1.0), (below, 1.0)]
            .into_iter()
            .for_each(|(y, part)| mesh.colored_vertex(pos2(at.x, y), colour.gamma_multiply(part)));
        if i > 0 {
            let [old, new] = [4 * (i as u32 - 1), 4 * i as u32];
            for edge in [0, 2] {
                mesh.add_triangle(old + edge, old + edge + 1, new + edge);
                mesh.add_triangle(new + edge, old + edge + 1, new + edge + 1);
            }
        }
    }
    painter.add(Shape::mesh(mesh));
    let outline: Vec<_> = match points {
        Some(points) => points.points().map(|point| axes.at(point)).collect(),
        None => powers.iter().enumerate().map(|(i, power)| axes.at((wavelength_nm(i), *power))).collect(),
    };
    painter.add(Shape::line(outline, Stroke::new(1.0, text)));
    for nm in [400.0, 500.0, 600.0, 700.0] {
        let at = pos2(axes.x(nm), rect.bottom() + STRIP + 1.0);
        painter.text(at, Align2::CENTER_TOP, format!("{nm} nm"), FontId::proportional(10.0), weak);
    }
    for (index, point) in points.into_iter().flat_map(LightSpectrum::points).enumerate() {
        let radius = if held == Some(index) { 5.0 } else { 3.5 };
        painter.circle(axes.at(point), radius, text, Stroke::new(1.0, ui.visuals().panel_fill));
    }
}

/// The colour of each wavelength of the grid, as a screen can show it: what leaves sRGB loses its negative parts, and the ends are dark.
static COLOURS: LazyLock<[Color32; SAMPLES]> = LazyLock::new(|| {
    let observer = Observer::cie_1931_2deg();
    let linear = |i: usize| (BT709.from_xyz() * observer.at_nm(wavelength_nm(i))).max(glam::DVec3::ZERO);
    let brightest = (0..SAMPLES).map(|i| linear(i).max_element()).fold(f64::MIN_POSITIVE, f64::max);
    std::array::from_fn(|i| {
        let [r, g, b] = (linear(i) / brightest).to_array().map(|part| (255.0 * srgb_encode(part)).round() as u8);
        Color32::from_rgb(r, g, b)
    })
});
