//! Sliders that the arrow keys move by round steps.

use std::ops::RangeInclusive;

use egui::{Key, Response, Slider, SliderClamping, Ui, emath::Numeric};

/// Steps between the ends of a slider, roughly; and those between two powers of ten of a logarithmic one.
const STEPS: f64 = 100.0;
const STEPS_OF_TEN: f64 = 10.0;

/// A slider over a range, as a row forms it.
pub struct Rail<'a> {
    slider: Slider<'a>,
    ends: [f64; 2],
    /// The smallest number worth telling from 0 on a logarithmic slider; other ones have none.
    smallest: Option<f64>,
    decimals: Option<usize>,
}

impl<'a> Rail<'a> {
    /// A slider that no edit leaves.
    pub fn new<N: Numeric>(value: &'a mut N, range: RangeInclusive<N>) -> Self {
        let ends = [range.start().to_f64(), range.end().to_f64()];
        let slider = Slider::new(value, range).clamping(SliderClamping::Edits);
        Self { slider, ends, smallest: None, decimals: N::INTEGRAL.then_some(0) }
    }

    /// Small numbers get as much of the slider as large ones.
    pub fn logarithmic(mut self, is: bool) -> Self {
        self.slider = self.slider.logarithmic(is);
        self.smallest = is.then_some(1e-3);
        self
    }

    /// The smallest number of a logarithmic slider that begins at 0.
    pub fn smallest_positive(mut self, smallest: f64) -> Self {
        self.slider = self.slider.smallest_positive(smallest);
        self.smallest = Some(smallest);
        self
    }

    /// Decimals at most.
    pub fn max_decimals(mut self, decimals: usize) -> Self {
        self.slider = self.slider.max_decimals(decimals);
        self.decimals = Some(decimals);
        self
    }

    /// Decimals, neither more nor less.
    pub fn fixed_decimals(mut self, decimals: usize) -> Self {
        self.slider = self.slider.fixed_decimals(decimals);
        self.decimals = Some(decimals);
        self
    }

    /// The unit behind the number.
    pub fn suffix(mut self, unit: &str) -> Self {
        self.slider = self.slider.suffix(unit);
        self
    }

    /// Shows a text in the place of the number.
    pub fn text(mut self, text: &'static str) -> Self {
        self.slider = self.slider.custom_formatter(move |_, _| text.to_owned());
        self
    }

    /// Shows the slider, and what arrow keys make of a value if it has the keyboard; `None` where that is not theirs.
    pub fn show(self, ui: &mut Ui, value: f64) -> (Response, Option<f64>) {
        let Self { slider, ends, smallest, decimals } = self;
        // Before the number takes them.
        let presses = presses(ui);
        let response = ui.add(slider);
        if presses == 0 || !response.has_focus() || !response.changed() {
            return (response, None);
        }
        let finest = 10f64.powi(-(decimals.unwrap_or(9) as i32));
        let step = match smallest {
            Some(smallest) => {
                // From 100 on upwards by tens, from there downwards by ones.
                let beyond = if presses > 0 { 1.0 + 1e-9 } else { 1.0 - 1e-9 };
                power_of_ten(value.abs().max(smallest) * beyond) / STEPS_OF_TEN
            }
            None => power_of_ten((ends[1] - ends[0]) / STEPS * (1.0 + 1e-9)),
        };
        let stepped = stepped(value, f64::from(presses) * step.max(finest), step.max(finest));
        (response, Some(stepped.clamp(ends[0], ends[1])))
    }
}

/// How often arrow keys were pressed up or to the right, less how often down or to the left. With Shift each counts ten times.
pub fn presses(ui: &Ui) -> i32 {
    ui.input(|input| {
        let count = |keys: [Key; 2]| keys.map(|key| input.num_presses(key) as i32).iter().sum::<i32>();
        let presses = count([Key::ArrowRight, Key::ArrowUp]) - count([Key::ArrowLeft, Key::ArrowDown]);
        if input.modifiers.shift { 10 * presses } else { presses }
    })
}

/// The power of ten that is just below a number.
fn power_of_ten(value: f64) -> f64 {
    10f64.powf(value.log10().floor())
}

/// A value and a change of it, without the noise of the sum: to a thousandth of a step.
fn stepped(value: f64, change: f64, step: f64) -> f64 {
    let parts = (1e3 / step).max(1.0).round();
    ((value + change) * parts).round() / parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_round() {
        assert_eq!(stepped(0.7, 0.1, 0.1), 0.8);
        assert_eq!(stepped(0.29, -0.01, 0.01), 0.28);
        assert_eq!(stepped(9000.0, 1000.0, 1000.0), 10_000.0);
    }
}
