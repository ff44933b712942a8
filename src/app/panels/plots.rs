//! Plots of the panels.

use egui::{Rangef, Ui};
use egui_plot::{AxisHints, GridMark, Line, Plot, PlotPoints};

use crate::app::costs::Costs;

/// Parts that the marks of an axis make, at most: to the right, and upwards, where small plots have less room.
const PARTS: [f64; 2] = [6.0, 4.0];

/// A plot whose axes have a few round numbers, in small plots too.
pub fn with_few_marks(plot: Plot<'_>) -> Plot<'_> {
    // Where marks are closer together, in points, labels fade and then disappear.
    let (x, y) = (Rangef::new(24.0, 32.0), Rangef::new(9.0, 12.0));
    plot.x_grid_spacer(|axis| few_marks(axis.bounds, PARTS[0]))
        .y_grid_spacer(|axis| few_marks(axis.bounds, PARTS[1]))
        .custom_x_axes(vec![AxisHints::new_x().label_spacing(x).formatter(|mark, _| name(mark))])
        .custom_y_axes(vec![AxisHints::new_y().label_spacing(y).formatter(|mark, _| name(mark))])
}

/// The number at a mark, with as many decimals as tell it from its neighbours.
fn name(GridMark { value, step_size }: GridMark) -> String {
    let decimals = (-step_size.log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
    format!("{value:.decimals$}")
}

/// Marks of an axis: a few round numbers, all of them named.
fn few_marks((low, high): (f64, f64), parts: f64) -> Vec<GridMark> {
    let step_size = round_step((high - low) / parts);
    let (first, last) = ((low / step_size).ceil() as i64, (high / step_size).floor() as i64);
    (first..=last).map(|k| GridMark { value: k as f64 * step_size, step_size }).collect()
}

/// The round number, 1, 2 or 5 times a power of ten, that is next above a step or equal to it.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.max(f64::MIN_POSITIVE).log10().floor());
    let part = step / power * (1.0 - 1e-9);
    power * [1.0, 2.0, 5.0].into_iter().find(|round| part <= *round).unwrap_or(10.0)
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
        for (low, high, parts, expected) in [
            (0.0, 0.043, 4.0, vec![0.0, 0.02, 0.04]),
            (0.957, 1.0, 4.0, vec![0.96, 0.98, 1.0]),
            (-52.0, 52.0, 4.0, vec![-50.0, 0.0, 50.0]),
            (0.0, 4.0, 4.0, vec![0.0, 1.0, 2.0, 3.0, 4.0]),
            (360.0, 780.0, 6.0, vec![400.0, 500.0, 600.0, 700.0]),
        ] {
            let marks = few_marks((low, high), parts);
            let values: Vec<f64> = marks.iter().map(|mark| (1e6 * mark.value).round() / 1e6).collect();
            assert_eq!(values, expected);
        }
        let names = |low: f64, high: f64| few_marks((low, high), 4.0).into_iter().map(name).collect::<Vec<_>>();
        assert_eq!(names(0.0, 0.16), ["0.00", "0.05", "0.10", "0.15"]);
        assert_eq!(names(0.0, 800.0), ["0", "200", "400", "600", "800"]);
    }
}
