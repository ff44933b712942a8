//! The costs panel: what a picture takes.

use egui::{Grid, Ui};

use super::plots;
use crate::{
    app::model::Model,
    plan::{FilmKey, Moment},
};

/// Shows times and counts.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let costs = &model.costs;
    ui.add(egui::Label::new(egui::RichText::new(&costs.adapter).weak()).truncate()).on_hover_text(&costs.adapter);
    plots::frame_times(ui, costs);
    Grid::new("costs").num_columns(2).spacing([20.0, 3.0]).show(ui, |ui| {
        let mut entry = |name: &str, value: String| {
            ui.label(name);
            ui.monospace(value);
            ui.end_row();
        };
        let ms = |ms: Option<f64>| ms.map_or("unknown".to_owned(), |ms| format!("{ms:.2} ms"));
        entry("window, median", ms(costs.median_cpu_ms()));
        for pass in &costs.passes {
            entry(&pass.name.replace('_', " "), ms(pass.gpu_ms));
        }
        for index in 0..model.scene.bubbles.len() {
            if let Some(FilmKey::Field(film)) = model.scene.film_key(index, Moment::default()) {
                let flow_cells = film.flow_cells.min(film.cells);
                entry(&format!("film {}, flow", index + 1), format!("6x{}², 6x{flow_cells}²", film.cells));
            }
        }
        entry("draws", costs.counts.draws.to_string());
        entry("dispatches", costs.counts.dispatches.to_string());
        entry("submissions", costs.counts.submissions.to_string());
        entry("pixels shaded", costs.counts.pixels_shaded.to_string());
        entry("cells stepped", costs.counts.cells_stepped.to_string());
    });
}
