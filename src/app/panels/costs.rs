//! The costs panel: what a picture takes.

use egui::{Grid, Ui};

use super::plots;
use crate::app::model::Model;

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
            if let Some([cells, flow_cells]) = model.scene.field_grids(index) {
                entry(&format!("film {}, flow", index + 1), format!("6x{cells}², 6x{}²", flow_cells.min(cells)));
            }
        }
        entry("draws", costs.counts.draws.to_string());
        entry("dispatches", costs.counts.dispatches.to_string());
        entry("submissions", costs.counts.submissions.to_string());
        entry("pixels shaded", costs.counts.pixels_shaded.to_string());
        entry("cells stepped", costs.counts.cells_stepped.to_string());
    });
}
