//! Rows of a panel: a name, a widget that bears it, and what it means as a tooltip.

use std::ops::RangeInclusive;

use egui::{Align, Layout, Response, Slider, SliderClamping, Ui, emath::Numeric, vec2};

/// Width of the names, points.
const NAME_WIDTH: f32 = 84.0;

/// A row with a name. The widget is called by it, for screen readers and tests.
pub fn row(ui: &mut Ui, name: &str, help: &str, add: impl FnOnce(&mut Ui) -> Response) -> Response {
    ui.horizontal(|ui| {
        let label = named(ui, name);
        add(ui).labelled_by(label.id).on_hover_text(help)
    })
    .inner
}

/// A row of several widgets that have names of their own.
pub fn group<R>(ui: &mut Ui, name: &str, add: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        named(ui, name);
        add(ui)
    })
    .inner
}

fn named(ui: &mut Ui, name: &str) -> Response {
    let size = vec2(NAME_WIDTH, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(NAME_WIDTH);
        ui.label(name)
    })
    .inner
}

/// A row with a slider over a whole range, that no edit leaves.
pub fn slider<N: Numeric>(
    ui: &mut Ui,
    name: &str,
    value: &mut N,
    range: RangeInclusive<N>,
    help: &str,
    form: impl FnOnce(Slider<'_>) -> Slider<'_>,
) -> Response {
    row(ui, name, help, |ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - VALUE_WIDTH).max(40.0);
        ui.add(form(Slider::new(value, range).clamping(SliderClamping::Edits)))
    })
}

/// Room for a slider's number, points.
const VALUE_WIDTH: f32 = 76.0;

/// A row of words of which one is chosen; tells whether another was chosen now.
pub fn choice<T: Copy + PartialEq>(ui: &mut Ui, name: &str, value: &mut T, options: &[(T, &str, &str)]) -> bool {
    let before = *value;
    group(ui, name, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(3.0, 2.0);
            for (option, label, help) in options {
                ui.selectable_value(value, *option, *label).on_hover_text(*help);
            }
        });
    });
    *value != before
}

/// A seed as a number, and a button for another one.
pub fn seed(ui: &mut Ui, name: &str, value: &mut u64, help: &str) -> bool {
    ui.horizontal(|ui| {
        let label = named(ui, name);
        let number = ui.add(egui::DragValue::new(value).speed(0.1)).labelled_by(label.id).on_hover_text(help);
        let button = ui.button(format!("New {}", name.to_lowercase())).on_hover_text("Draws another seed");
        if button.clicked() {
            *value = crate::app::model::new_seed();
        }
        number.changed() || button.clicked()
    })
    .inner
}
