//! Rows of a panel: a name, a widget that bears it, and what it means as a tooltip.

use std::ops::RangeInclusive;

use egui::{Align, Layout, Response, Slider, SliderClamping, Ui, emath::Numeric, vec2};

use crate::{
    Words,
    app::group::Group,
    scene::{Key, Range},
};

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

/// What a key means, as a tooltip: the sentence of the format's page without its marks.
pub fn tooltip(help: &str) -> String {
    let plain = help.replace(" [table](#files-that-a-scene-names)", " table").replace('`', "");
    let mut letters = plain.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A row with a slider over a key's whole range.
pub fn number<N: Numeric>(
    ui: &mut Ui,
    key: &Key,
    value: &mut N,
    form: impl FnOnce(Slider<'_>) -> Slider<'_>,
) -> Response {
    let Range::Within(low, high) = key.range else { unreachable!("`{}` has no ends: give some", key.name) };
    number_within(ui, key, value, N::from_f64(low)..=N::from_f64(high), form)
}

/// A row with a slider over a part of a key's range.
pub fn number_within<N: Numeric>(
    ui: &mut Ui,
    key: &Key,
    value: &mut N,
    range: RangeInclusive<N>,
    form: impl FnOnce(Slider<'_>) -> Slider<'_>,
) -> Response {
    slider(ui, key.label, value, range, &tooltip(key.help), |slider| form(slider.suffix(key.unit)))
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

/// A row with a box to tick.
pub fn flag(ui: &mut Ui, key: &Key, value: &mut bool) -> Response {
    row(ui, key.label, &tooltip(key.help), |ui| ui.checkbox(value, ""))
}

/// Room for a slider's number, points.
const VALUE_WIDTH: f32 = 76.0;

/// A row with the words of a key, one of them chosen; returns whether the choice has changed.
pub fn choice<T: Words>(ui: &mut Ui, key: &Key, value: &mut T) -> bool {
    choice_of(ui, key.label, value, T::CHOICES)
}

/// What stands in the place of a value that several bubbles do not have in common.
pub const MIXED: &str = "—";

/// A slider that shows no number where several bubbles do not have it in common.
pub fn shared<'a>(slider: Slider<'a>, group: &Group, key: &Key) -> Slider<'a> {
    if group.is_mixed(key) { slider.custom_formatter(|_, _| MIXED.to_owned()) } else { slider }
}

/// A row with the words of a key, none of them chosen where several bubbles do not have one in common.
pub fn shared_choice<T: Words>(ui: &mut Ui, key: &Key, value: &mut T, choices: &[T], bubbles: &mut Group) {
    if !bubbles.is_mixed(key) {
        choice_of(ui, key.label, value, choices);
        return;
    }
    let options: Vec<_> = choices.iter().map(|choice| (*choice, choice.name(), choice.help())).collect();
    if let Some(chosen) = mixed_options(ui, key.label, &options) {
        *value = chosen;
        bubbles.set(key);
    }
}

/// A row of options, none of them chosen; returns the one that is clicked.
pub fn mixed_options<T: Copy>(ui: &mut Ui, name: &str, options: &[(T, &str, &str)]) -> Option<T> {
    let mut chosen = None;
    group(ui, name, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(3.0, 2.0);
            ui.weak(MIXED).on_hover_text("The selected bubbles differ");
            for (option, label, help) in options {
                if ui.selectable_label(false, *label).on_hover_text(*help).clicked() {
                    chosen = Some(*option);
                }
            }
        });
    });
    chosen
}

/// A row with some of the words of a key, one of them chosen.
pub fn choice_of<T: Words>(ui: &mut Ui, name: &str, value: &mut T, choices: &[T]) -> bool {
    let options: Vec<_> = choices.iter().map(|choice| (*choice, choice.name(), choice.help())).collect();
    options_of(ui, name, value, &options)
}

/// A row of options, one of them chosen; returns whether the choice has changed.
pub fn options_of<T: Copy + PartialEq>(ui: &mut Ui, name: &str, value: &mut T, options: &[(T, &str, &str)]) -> bool {
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
pub fn seed(ui: &mut Ui, key: &Key, value: &mut u64) -> bool {
    shared_seed(ui, key, value, &Group::default())
}

/// A seed, which is shown if several bubbles have it in common.
pub fn shared_seed(ui: &mut Ui, key: &Key, value: &mut u64, bubbles: &Group) -> bool {
    ui.horizontal(|ui| {
        let label = named(ui, key.label);
        let mut number = egui::DragValue::new(value).speed(0.1);
        if bubbles.is_mixed(key) {
            number = number.custom_formatter(|_, _| MIXED.to_owned());
        }
        let number = ui.add(number).labelled_by(label.id).on_hover_text(tooltip(key.help));
        let button = ui.button(format!("New {}", key.label.to_lowercase())).on_hover_text("Picks another random seed");
        if button.clicked() {
            *value = crate::app::edit::new_seed();
        }
        number.changed() || button.clicked()
    })
    .inner
}
