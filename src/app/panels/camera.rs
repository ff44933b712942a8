//! Ways to look at the bubbles: known views, and a turntable.

use egui::Ui;

use super::widgets::{group, slider};
use crate::app::{edit::Edit, model::Model, orbit};

/// Turns of the turntable that its slider offers, degrees per second.
const TURNS_DEG_S: std::ops::RangeInclusive<f64> = -90.0..=90.0;

/// Shows the views and the turntable.
pub fn show(ui: &mut Ui, model: &mut Model) {
    group(ui, "Look from", |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            for (view, name, help) in orbit::VIEWS {
                if ui.button(name).on_hover_text(help).clicked() {
                    let spheres = model.scene.spheres(model.clock.time_s(&model.scene.motion));
                    model.edit(Edit::Camera(orbit::seen_from(&model.scene.camera, &spheres, view)));
                }
            }
        });
    });
    let help = "The eye goes around its target by itself; 0: it stays";
    slider(ui, "Turntable", &mut model.turntable_deg_s, TURNS_DEG_S, help, |slider| {
        slider.suffix("°/s").max_decimals(0)
    });
}
