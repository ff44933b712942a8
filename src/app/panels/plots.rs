//! Plots of the panels.

use egui::{Rangef, Ui};
use egui_plot::{AxisHints, GridInput, GridMark, Line, Plot, PlotPoints};

use crate::app::costs::Costs;

/// Parts of an axis that its marks make, about.
const PARTS: f64 = 4.0;

/// A plot whose axes have a few round numbers, in small plots too.
pub fn with_few_marks(plot: Plot<'_>) -> Plot<'_> {
    // Where marks are closer together, in points, labels fade and then disappear.
    let (x, y) = (Rangef::new(24.0, 32.0), Rangef::new(9.0, 12.0));
    plot.x_grid_spacer(few_marks)
        .y_grid_spacer(few_marks)
        .custom_x_axes(vec![AxisHints::new_x().label_spacing(x)])
        .custom_y_axes(vec![AxisHints::new_y().label_spacing(y)])
}

/// Marks of an axis: a few round numbers, all of them named.
fn few_marks(GridInput { bounds: (low, high), .. }: GridInput) -> Vec<GridMark> {
    let step_size = round_step((high - low) / PARTS);
    let (first, last) = ((low / step_size).ceil() as i64, (high / step_size).floor() as i64);
    (first..=last).map(|k| GridMark { value: k as f64 * step_size, step_size }).collect()
}

/// The round number, 1, 2 or 5 times a power of ten, that is next below a step or equal to it.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.max(f64::MIN_POSITIVE).log10().floor());
    let part = step / power;
    power
        * if part >= 5.0 {
            5.0
        } else if part >= 2.0 {
            2.0
        } else {
            1.0
        }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_a_few_round_marks() {
        for (low, high, expected) in [
            (0.0, 0.043, vec![0.0, 0.01, 0.02, 0.03, 0.04]),
            (0.957, 1.0, vec![0.96, 0.97, 0.98, 0.99, 1.0]),
            (-52.0, 52.0, vec![-40.0, -20.0, 0.0, 20.0, 40.0]),
            (360.0, 780.0, vec![400.0, 500.0, 600.0, 700.0]),
        ] {
            let marks = few_marks(GridInput { bounds: (low, high), base_step_size: 1.0 });
            let values: Vec<f64> = marks.iter().map(|mark| (1e6 * mark.value).round() / 1e6).collect();
            assert_eq!(values, expected);
        }
    }
}
