//! The view panel: exposure, backdrop, camera and lens.

use egui::Ui;

use super::widgets::{choice, flag, number, options_of, row, slider, tooltip};
use super::{camera, header};
use crate::{
    app::{
        edit::Edit,
        model::Model,
        request::{Request, Target},
    },
    scene::{Backdrop, Camera, Lens, View},
};

/// Shows and edits the view.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let mut view = model.scene.view.clone();
    let keys = View::KEYS;
    number(ui, &keys.exposure_ev, &mut view.exposure_ev, |slider| slider.fixed_decimals(2));
    backdrop(ui, &mut view);
    if plate(ui, &mut view) {
        model.requests.push(Request::Ask(Target::OpenPlate));
    }
    choice(ui, &keys.quality, &mut view.quality);
    polariser(ui, &mut view);
    flag(ui, &keys.white_balance, &mut view.white_balance);
    flag(ui, &keys.dither, &mut view.dither);
    if view != model.scene.view {
        model.edit(Edit::View(view));
    }
    lens(ui, model);
    camera::show(ui, model);
    let mut camera = model.scene.camera.clone();
    match &mut camera.focal_mm {
        Some(focal_mm) => {
            number(ui, &Camera::KEYS.focal_mm, focal_mm, |slider| slider.logarithmic(true).max_decimals(1))
        }
        None => number(ui, &Camera::KEYS.fov_y_deg, &mut camera.fov_y_deg, |slider| slider.max_decimals(1)),
    };
    number(ui, &Camera::KEYS.follow_deg, &mut camera.follow_deg, |slider| slider.max_decimals(0));
    let decimals = decimals(camera.distance_m);
    number(ui, &Camera::KEYS.distance_m, &mut camera.distance_m, |slider| {
        slider.logarithmic(true).smallest_positive(0.001).max_decimals(decimals)
    })
    .on_hover_text("F frames the bubbles.");
    if camera != model.scene.camera {
        model.look_from(camera);
    }
}

/// Decimals of a length in m that show three of its digits, and at least millimetres.
fn decimals(length_m: f64) -> usize {
    let digits = if length_m > 0.0 { 2.0 - length_m.log10().floor() } else { 3.0 };
    digits.clamp(3.0, 9.0) as usize
}

fn lens(ui: &mut Ui, model: &mut Model) {
    let mut lens = model.scene.lens.clone();
    let keys = Lens::KEYS;
    number(ui, &keys.aperture_mm, &mut lens.aperture_mm, |slider| slider.max_decimals(1));
    if lens.aperture_mm > 0.0 {
        focus(ui, &mut lens, model.scene.camera.distance_m);
    }
    number(ui, &keys.glare, &mut lens.glare, |slider| slider.max_decimals(3));
    number(ui, &keys.vignetting_ev, &mut lens.vignetting_ev, |slider| slider.max_decimals(2));
    number(ui, &keys.grain, &mut lens.grain, |slider| slider.max_decimals(3));
    if lens != model.scene.lens {
        model.edit(Edit::Lens(lens));
    }
}

fn focus(ui: &mut Ui, lens: &mut Lens, distance_m: f64) {
    let mut is_held = lens.focus_m.is_some();
    row(ui, "Hold focus", "Focus at a fixed distance; otherwise at the camera's target", |ui| {
        ui.checkbox(&mut is_held, "")
    });
    lens.focus_m = is_held.then(|| lens.focus_m.unwrap_or(distance_m).clamp(0.01, 1000.0));
    if let Some(focus_m) = &mut lens.focus_m {
        number(ui, &Lens::KEYS.focus_m, focus_m, |slider| slider.logarithmic(true).max_decimals(3));
    }
}

/// The photograph behind the bubbles; returns whether one is to be opened.
fn plate(ui: &mut Ui, view: &mut View) -> bool {
    let name = view.plate.as_deref().map(|path| header::file_name(path).to_owned());
    let mut opens = false;
    let mut removes = false;
    row(ui, View::KEYS.plate.label, &tooltip(View::KEYS.plate.help), |ui| {
        opens = ui.button("Open…").on_hover_text("Choose a photograph (.png, .jpg)").clicked();
        removes = name.is_some() && ui.button("Remove").clicked();
        let text = egui::RichText::new(name.as_deref().unwrap_or("none")).weak();
        ui.add(egui::Label::new(text).truncate()).on_hover_text(view.plate.as_deref().unwrap_or("none"))
    });
    if removes {
        view.plate = None;
    }
    opens
}

fn polariser(ui: &mut Ui, view: &mut View) {
    let mut is_there = view.polariser_deg.is_some();
    row(ui, "Polariser", "A polarising filter in front of the camera", |ui| ui.checkbox(&mut is_there, ""));
    view.polariser_deg = is_there.then(|| view.polariser_deg.unwrap_or(0.0));
    if let Some(angle) = &mut view.polariser_deg {
        let help = tooltip(View::KEYS.polariser_deg.help);
        slider(ui, "Polariser angle", angle, -90.0..=90.0, &help, |slider| slider.suffix("°").max_decimals(1));
    }
}

fn backdrop(ui: &mut Ui, view: &mut View) {
    let colour = match view.backdrop {
        Backdrop::Environment => View::default().backdrop,
        colour => colour,
    };
    let options = [
        (Backdrop::Environment, "environment", "The environment that lights the scene"),
        (colour, "colour", "A constant radiance, like a photographer's card"),
    ];
    options_of(ui, View::KEYS.backdrop.label, &mut view.backdrop, &options);
    if let Backdrop::Radiance(radiance) = &mut view.backdrop {
        row(ui, "Card colour", "Radiance of the backdrop", |ui| {
            let mut rgb = radiance.map(|value| value as f32);
            let response = ui.color_edit_button_rgb(&mut rgb);
            if response.changed() {
                *radiance = rgb.map(|value| f64::from(value).clamp(0.0, 65504.0));
            }
            response
        });
    }
}
