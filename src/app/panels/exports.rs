//! The dialog for exports, and what they are doing, over the picture's lower right corner.

use egui::{Align2, Area, Context, Frame, Id, Label, Modal, ProgressBar, Rect, RichText, TextEdit, Ui, vec2};

use super::{
    dialog,
    widgets::{choice_of, follow_focus, group, options_of, row},
};
use crate::{
    Words,
    app::{
        exports::{Entry, Form, Kind, SequenceFormat},
        model::Model,
        request::{Request, Target},
    },
    export::{Format, Quality, map::Projection},
    physics::colour::Gamut,
    scene,
};

/// Sizes that the dialog offers, with their names.
const SIZES: [(&str, [u32; 2]); 3] = [("HD", [1280, 720]), ("Full HD", [1920, 1080]), ("4K", [3840, 2160])];
/// Width of a field for a number, points.
const NUMBER: f32 = 64.0;
/// Time between two looks at how far an export is.
const PERIOD_S: f32 = 0.25;

/// Shows the dialog if it is open, and the exports that have not ended.
pub fn show(ctx: &Context, picture: Rect, model: &mut Model) {
    if model.exports.form.is_open {
        dialog(ctx, model);
    }
    if model.exports.entries.is_empty() {
        return;
    }
    ctx.request_repaint_after_secs(PERIOD_S);
    // Above the hints.
    let corner = picture.right_bottom() + vec2(-12.0, if model.settings.knows_hints { -12.0 } else { -56.0 });
    let area = Area::new(Id::unique("exports")).fixed_pos(corner).pivot(Align2::RIGHT_BOTTOM).constrain_to(picture);
    let cancelled = area.show(ctx, |ui| {
        let shown =
            model.exports.entries.iter().map(|entry| Frame::popup(ui.style()).show(ui, |ui| line(ui, entry)).inner);
        shown.flatten().last()
    });
    cancelled.inner.into_iter().for_each(|id| model.exports.cancel(id));
}

/// How far an export is; its number if it shall be stopped.
fn line(ui: &mut Ui, entry: &Entry) -> Option<u64> {
    let name = entry.path.file_name().unwrap_or(entry.path.as_os_str()).to_string_lossy().into_owned();
    ui.horizontal(|ui| {
        let bar =
            ProgressBar::new(entry.watch.done() as f32).desired_width(200.0).text(format!("{name}: {}", entry.told()));
        ui.add(bar).on_hover_text(entry.path.display().to_string());
        let stop = ui.small_button("Stop").on_hover_text("Stop this export; numbered pictures that are finished stay");
        stop.clicked().then_some(entry.id)
    })
    .inner
}

fn dialog(ctx: &Context, model: &mut Model) {
    let mut form = std::mem::take(&mut model.exports.form);
    let before = form.clone();
    let time_s = model.clock.time_s(&model.scene.motion);
    let modal = Modal::new(Id::unique("export")).show(ctx, |ui| {
        ui.set_width(dialog::width(ui, 520.0));
        ui.heading("Export");
        let mut clicked = Clicked::default();
        // A refusal may take three lines.
        dialog::scroll(ui, 110.0).show(ui, |ui| {
            choice_of(ui, "What", &mut form.kind, Kind::CHOICES);
            ui.weak(form.kind.help());
            ui.add_space(4.0);
            fields(ui, &mut form, time_s, model.selected);
            if form.ending() != before.ending() {
                form.name_file();
            }
            clicked.chooses = file(ui, &mut form);
            follow_focus(ui);
        });
        // What was refused may be right now.
        if form != before {
            form.refused = None;
        }
        if let Some(refused) = &form.refused {
            ui.colored_label(ui.visuals().warn_fg_color, refused);
        }
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let job = form.job(time_s, model.selected);
            let replaces = model.exports.replaces(&form);
            let text = if replaces { "Replace the file" } else { "Export" };
            let export = ui.add_enabled(job.is_ok(), egui::Button::new(text));
            clicked.exports = export.clicked();
            if replaces {
                export.on_hover_text("A file of this name is there already, or waits to be exported");
            }
            clicked.closes = ui.button("Close").clicked();
        });
        clicked
    });
    form.is_open = !modal.inner.closes && !modal.should_close();
    if modal.inner.chooses {
        model.requests.push(Request::Ask(Target::Export(form.ending())));
    }
    if modal.inner.exports {
        begin(model, &mut form, time_s);
    }
    model.exports.form = form;
}

/// What was clicked in the dialog.
#[derive(Default)]
struct Clicked {
    exports: bool,
    closes: bool,
    chooses: bool,
}

/// Puts the export into the queue, unless it cannot be done: then the dialog stays and says why.
fn begin(model: &mut Model, form: &mut Form, time_s: f64) {
    let job = form.job(time_s, model.selected);
    let checked = job.and_then(|job| job.check().map(|()| job).map_err(|error| format!("{error:#}")));
    form.refused = checked.as_ref().err().cloned();
    form.is_open = checked.is_err();
    if let Ok(job) = checked {
        let scene = if form.kind == Kind::Picture { model.view_snapshot() } else { model.snapshot() };
        model.exports.add(job, scene);
    }
}

fn fields(ui: &mut Ui, form: &mut Form, time_s: f64, selected: usize) {
    match form.kind {
        Kind::Picture => {
            ui.weak(format!("At {time_s:.2} s, where the time line stands."));
            let formats = [
                (Format::Png, "PNG", "What the window shows, 8 bits"),
                (Format::Exr, "EXR", "Scene radiance, linear BT.709, 32-bit floats"),
            ];
            options_of(ui, "Format", &mut form.picture_format, &formats);
            picture(ui, form);
        }
        Kind::Sequence => {
            choice_of(ui, "Format", &mut form.sequence_format, SequenceFormat::CHOICES);
            let (from, to, rate) = (form.begin_s().err(), form.end_s().err(), form.rate().err());
            number(ui, "From", "When the first frame is, in seconds of the film's time", &mut form.begin_s, "s", from);
            number(ui, "To", "When the last frame ends, in seconds of the film's time", &mut form.end_s, "s", to);
            number(
                ui,
                "Frame rate",
                "Frames per second: a number, or a ratio like 24000/1001",
                &mut form.fps,
                "fps",
                rate,
            );
            if let Ok(frames) = form.frames() {
                let (first, last) = (frames.start(), frames.end());
                let plural = if first == last { "" } else { "s" };
                ui.weak(format!("{} frame{plural}, {first} to {last}", last - first + 1));
            }
            picture(ui, form);
        }
        Kind::Map => {
            ui.weak(format!("Of bubble {} at {time_s:.2} s.", selected + 1));
            let layouts = [
                (
                    Projection::Equirect,
                    "Equirectangular",
                    "Twice as wide as high: azimuth to the right, height upwards",
                ),
                (Projection::Cube, "Cube", "Six squares one below the other: +x, -x, +y, -y, +z, -z"),
            ];
            options_of(ui, "Layout", &mut form.projection, &layouts);
            let fault = form.map_height().err();
            number(
                ui,
                "Map height",
                "Height of the map; of a cube, the edge of a face",
                &mut form.map_height,
                "px",
                fault,
            );
        }
    }
}

/// The options of pictures.
fn picture(ui: &mut Ui, form: &mut Form) {
    let (width, height, samples) = (form.width().err(), form.height().err(), form.samples().err());
    number(ui, "Width", "Width of the picture", &mut form.width, "px", width);
    number(ui, "Height", "Height of the picture", &mut form.height, "px", height);
    group(ui, "", |ui| {
        for (name, size) in SIZES {
            if ui.small_button(name).on_hover_text(format!("{} x {} pixels", size[0], size[1])).clicked() {
                [form.width, form.height] = size.map(|length| length.to_string());
            }
        }
    });
    let help = "N x N samples per pixel: 1 is what the window takes, 4 is nearly free of jagged edges";
    number(ui, "Samples", help, &mut form.samples, "per side of a pixel", samples);
    let mut qualities = vec![(None, "as shown", "As the scene says")];
    qualities.extend(
        scene::Quality::CHOICES.iter().map(|quality| (Some(Quality::Gpu(*quality)), quality.name(), quality.help())),
    );
    qualities.push((Some(Quality::Reference), "reference", "In f64 on the CPU: minutes for a picture"));
    options_of(ui, "Quality", &mut form.quality, &qualities);
    if form.is_radiance() {
        let help = "Reflection, transmission, thickness, normals and more as layers of the EXR file";
        row(ui, "Layers", help, |ui| ui.checkbox(&mut form.layers, ""));
    } else {
        let gamuts =
            [(Gamut::Srgb, "sRGB", "For all displays"), (Gamut::DisplayP3, "Display P3", "For wide-gamut displays")];
        options_of(ui, "Colours", &mut form.gamut, &gamuts);
    }
    row(ui, "Alpha", "Leave out what stands behind the bubbles", |ui| ui.checkbox(&mut form.alpha, ""));
}

/// A row with a number as text, its unit, and what is wrong with it.
fn number(ui: &mut Ui, name: &str, help: &str, text: &mut String, unit: &str, fault: Option<String>) {
    row(ui, name, help, |ui| {
        let field = ui.add(TextEdit::singleline(text).desired_width(NUMBER));
        ui.add(Label::new(unit).wrap());
        if let Some(fault) = fault {
            ui.add(Label::new(RichText::new(fault).color(ui.visuals().warn_fg_color)).wrap());
        }
        field
    });
}

/// The file; returns whether the system's dialog is asked for.
fn file(ui: &mut Ui, form: &mut Form) -> bool {
    let (fault, name) = (form.path().err(), if form.ending().is_some() { "File" } else { "Folder" });
    let chooses = ui.horizontal(|ui| {
        let width = (ui.available_width() - 190.0).max(60.0);
        row(ui, name, "Where it goes", |ui| ui.add(TextEdit::singleline(&mut form.path).desired_width(width)));
        ui.button("Choose…").clicked()
    });
    if let Some(fault) = fault {
        ui.label(RichText::new(fault).color(ui.visuals().warn_fg_color));
    }
    chooses.inner
}
