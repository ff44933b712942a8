//! Rows of a panel: a name, a widget that bears it, and what it means as a tooltip.

use std::ops::RangeInclusive;

use egui::{Align, Id, Layout, Rect, Response, Sense, Stroke, Ui, Vec2, WidgetInfo, emath::Numeric, vec2};
use toml::Value;

use super::rail::Rail;

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
pub fn number<N: Numeric>(ui: &mut Ui, key: &Key, value: &mut N, form: impl FnOnce(Rail<'_>) -> Rail<'_>) -> Response {
    let Range::Within(low, high) = key.range else { unreachable!("`{}` has no ends: give some", key.name) };
    number_within(ui, key, value, N::from_f64(low)..=N::from_f64(high), form)
}

/// A row with a slider over a part of a key's range.
pub fn number_within<N: Numeric>(
    ui: &mut Ui,
    key: &Key,
    value: &mut N,
    range: RangeInclusive<N>,
    form: impl FnOnce(Rail<'_>) -> Rail<'_>,
) -> Response {
    let normal = normal(key);
    slider_from(ui, key.label, value, range, &tooltip(key.help), normal, |slider| form(slider.suffix(key.unit)))
}

/// The default of a key that is a number, or three equal ones.
fn normal(key: &Key) -> Option<f64> {
    let number = |value: &Value| match value {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    };
    match (key.normal)()? {
        Value::Array(parts) => number(parts.first()?).filter(|_| parts.iter().all(|part| *part == parts[0])),
        value => number(&value),
    }
}

/// A row with a slider over a whole range, that no edit leaves.
pub fn slider<N: Numeric>(
    ui: &mut Ui,
    name: &str,
    value: &mut N,
    range: RangeInclusive<N>,
    help: &str,
    form: impl FnOnce(Rail<'_>) -> Rail<'_>,
) -> Response {
    slider_from(ui, name, value, range, help, None, form)
}

/// A row with a slider over a whole range, and a way back to a default.
pub fn slider_from<N: Numeric>(
    ui: &mut Ui,
    name: &str,
    value: &mut N,
    range: RangeInclusive<N>,
    help: &str,
    normal: Option<f64>,
    form: impl FnOnce(Rail<'_>) -> Rail<'_>,
) -> Response {
    let before = value.to_f64();
    let normal = normal.filter(|normal| range.contains(&N::from_f64(*normal)));
    let mut is_reset = false;
    let mut response = row(ui, name, help, |ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - VALUE_WIDTH - RESET_WIDTH).max(40.0);
        let (response, stepped) = form(Rail::new(value, range)).show(ui, before);
        stepped.into_iter().for_each(|stepped| *value = N::from_f64(stepped));
        is_reset = normal.is_some_and(|normal| normal != before) && reset(ui, name);
        response
    });
    if let Some(normal) = normal.filter(|_| is_reset) {
        *value = N::from_f64(normal);
        response.mark_changed();
    }
    response
}

/// A button at the end of a row that sets it back; returns whether it was clicked.
fn reset(ui: &mut Ui, name: &str) -> bool {
    let button = |ui: &mut Ui| {
        let (rect, button) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::click());
        button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Reset {name}")));
        turn_back(ui, rect, ui.style().interact(&button).fg_stroke);
        button.on_hover_text(format!("Set {name} back to its default")).clicked()
    };
    ui.with_layout(Layout::right_to_left(Align::Center), button).inner
}

/// Draws an arrow that turns back. The fonts have none.
fn turn_back(ui: &Ui, rect: Rect, stroke: Stroke) {
    let on_circle = |turn: f32| rect.center() + 0.3 * rect.width() * Vec2::angled(std::f32::consts::TAU * turn);
    // From the upper left around to the left.
    let arc: Vec<_> = (0..=12u8).map(|k| on_circle(0.625 + 0.8 * f32::from(k) / 12.0)).collect();
    let tip = arc[0];
    ui.painter().line(arc, stroke);
    ui.painter().line(vec![tip + vec2(0.0, -4.0), tip, tip + vec2(4.0, 0.0)], stroke);
}

/// A row with a box to tick.
pub fn flag(ui: &mut Ui, key: &Key, value: &mut bool) -> Response {
    let normal = (key.normal)().and_then(|normal| normal.as_bool()).filter(|normal| normal != value);
    let mut is_reset = false;
    let mut response = row(ui, key.label, &tooltip(key.help), |ui| {
        let response = ui.checkbox(value, "");
        is_reset = normal.is_some() && reset(ui, key.label);
        response
    });
    if let Some(normal) = normal.filter(|_| is_reset) {
        *value = normal;
        response.mark_changed();
    }
    response
}

/// Room for a slider's number, points.
const VALUE_WIDTH: f32 = 70.0;
/// Room for the button that sets a row back, points.
const RESET_WIDTH: f32 = 22.0;

/// A row with the words of a key, one of them chosen; returns whether the choice has changed.
pub fn choice<T: Words>(ui: &mut Ui, key: &Key, value: &mut T) -> bool {
    choice_from(ui, key, value, T::CHOICES)
}

/// A row with some of the words of a key, and a way back to its default.
fn choice_from<T: Words>(ui: &mut Ui, key: &Key, value: &mut T, choices: &[T]) -> bool {
    let options: Vec<_> = choices.iter().map(|choice| (*choice, choice.name(), choice.help())).collect();
    let normal = (key.normal)().and_then(|normal| T::of_name(normal.as_str()?));
    options_from(ui, key.label, value, &options, normal.filter(|normal| choices.contains(normal)))
}

/// What stands in the place of a value that several bubbles do not have in common.
pub const MIXED: &str = "—";

/// A slider that shows no number where several bubbles do not have it in common.
pub fn shared<'a>(slider: Rail<'a>, group: &Group, key: &Key) -> Rail<'a> {
    if group.is_mixed(key) { slider.text(MIXED) } else { slider }
}

/// A row with the words of a key, none of them chosen where several bubbles do not have one in common.
pub fn shared_choice<T: Words>(ui: &mut Ui, key: &Key, value: &mut T, choices: &[T], bubbles: &mut Group) {
    if !bubbles.is_mixed(key) {
        choice_from(ui, key, value, choices);
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
    options_from(ui, name, value, options, None)
}

/// A row of options with a way back to one of them.
pub fn options_from<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
    normal: Option<T>,
) -> bool {
    let before = *value;
    group(ui, name, |ui| {
        let size = vec2((ui.available_width() - RESET_WIDTH).max(0.0), ui.spacing().interact_size.y);
        let layout = Layout::left_to_right(Align::Center).with_main_wrap(true);
        ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.spacing_mut().item_spacing = vec2(3.0, 2.0);
            for (option, label, help) in options {
                ui.selectable_value(value, *option, *label).on_hover_text(*help);
            }
        });
        let normal = normal.filter(|normal| *normal != before);
        if let Some(normal) = normal
            && reset(ui, name)
        {
            *value = normal;
        }
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

/// Scrolls to a widget that has got the keyboard and is not all seen, at the end of what scrolls.
pub fn follow_focus(ui: &Ui) {
    let followed = Id::unique("followed focus");
    let focused = ui.memory(|memory| memory.focused());
    let known: Option<Id> = ui.data(|data| data.get_temp(followed));
    if focused == known {
        return;
    }
    ui.data_mut(|data| match focused {
        Some(focused) => drop(data.insert_temp(followed, focused)),
        None => data.remove::<Id>(followed),
    });
    let widget = focused.and_then(|focused| ui.ctx().read_response(focused));
    // What stands outside of what scrolls is all seen.
    if let Some(widget) =
        widget.filter(|widget| widget.layer_id == ui.layer_id() && widget.rect != widget.interact_rect)
    {
        ui.scroll_to_rect(widget.rect, None);
    }
}
