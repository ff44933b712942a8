//! The view panel: exposure, backdrop and lens.

use egui::Ui;

use super::widgets::{choice, row, slider};
use crate::{
    app::model::Model,
    scene::{Backdrop, Quality, View},
};

/// Shows and edits the view.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let view = &mut model.scene.view;
    let help = "Exposure in stops: the radiance is multiplied by 2 to this power";
    slider(ui, "Exposure", &mut view.exposure_ev, -20.0..=20.0, help, |slider| slider.suffix(" EV").fixed_decimals(2));
    backdrop(ui, view);
    choice(ui, "Quality", &mut view.quality, &QUALITIES);
    polariser(ui, view);
    row(ui, "White balance", "Shows the illuminant's white as white, as cameras do", |ui| {
        ui.checkbox(&mut view.white_balance, "")
    });
    row(ui, "Dither", "Hides the steps of 8-bit pictures under fine noise", |ui| ui.checkbox(&mut view.dither, ""));
    let fov = &mut model.scene.camera.fov_y_deg;
    slider(ui, "Field of view", fov, 1.0..=170.0, "Full vertical angle of the view", |slider| {
        slider.suffix("°").max_decimals(1)
    });
    let distance = &mut model.scene.camera.distance_m;
    let help = "From the eye to the target; 0 is inside.\nF frames the bubbles.";
    slider(ui, "Distance", distance, 0.0..=1000.0, help, |slider| {
        slider.logarithmic(true).smallest_positive(0.001).suffix(" m").max_decimals(3)
    });
}

const QUALITIES: [(Quality, &str, &str); 3] = [
    (Quality::Fast, "fast", "Fastest: light that meets several walls is summed over few wavelengths"),
    (Quality::Standard, "standard", "Light that meets several walls is summed over a dozen wavelengths"),
    (Quality::Spectral, "spectral", "Most exact: all light is summed over some thirty wavelengths or more"),
];

fn polariser(ui: &mut Ui, view: &mut View) {
    let mut is_there = view.polariser_deg.is_some();
    row(ui, "Polariser", "A polarising filter before the camera", |ui| ui.checkbox(&mut is_there, ""));
    view.polariser_deg = is_there.then(|| view.polariser_deg.unwrap_or(0.0));
    if let Some(angle) = &mut view.polariser_deg {
        slider(ui, "Its angle", angle, -90.0..=90.0, "From the horizontal, anticlockwise", |slider| {
            slider.suffix("°").max_decimals(1)
        });
    }
}

fn backdrop(ui: &mut Ui, view: &mut View) {
    let colour = match view.backdrop {
        Backdrop::Environment => View::default().backdrop,
        colour => colour,
    };
    let options = [
        (Backdrop::Environment, "environment", "The light's own surroundings"),
        (colour, "colour", "One radiance, like a photographer's card"),
    ];
    choice(ui, "Backdrop", &mut view.backdrop, &options);
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
