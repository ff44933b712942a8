//! Plots of the panels.

use egui::Ui;
use egui_plot::{Line, Plot, PlotPoints};

use crate::app::costs::Costs;

/// The window's time for each of the last pictures, ms.
pub fn frame_times(ui: &mut Ui, costs: &Costs) {
    let points: PlotPoints<'_> = costs.cpu_ms.iter().enumerate().map(|(index, ms)| [index as f64, *ms]).collect();
    let plot = Plot::new("frame times")
        .height(72.0)
        .include_y(0.0)
        .show_axes([false, true])
        .show_grid([false, true])
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_x(false);
    plot.show(ui, |plot| plot.line(Line::new("window, ms", points)));
}
