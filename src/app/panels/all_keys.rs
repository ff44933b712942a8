//! Keys of the scene's sections in rows that follow from their declarations, each with a way back to its default.

use egui::{ComboBox, DragValue, Grid, Id, Response, Ui};
use serde::{Serialize, de::DeserializeOwned};
use toml::Value;

use super::{
    light,
    widgets::{MIXED, tooltip},
};
use crate::{
    app::{edit::Edit, group::Group, model::Model},
    scene::{Bubble, Camera, Film, Generator, Key, Lens, Light, Motion, Range, View},
};

/// Shows and edits the keys of the selected bubble and generator, the motion, the camera, the view, the lens and the light.
pub fn show(ui: &mut Ui, model: &mut Model) {
    if let Some(bubble) = model.scene.bubbles.get(model.selected) {
        let (mut edited, group) = (bubble.clone(), model.group());
        let (title, films) = match model.selection().len() {
            0 | 1 => (format!("Bubble {}", model.selected + 1), "Its film"),
            count => (format!("{count} bubbles"), "Their films"),
        };
        shared_section(ui, &title, &mut edited, Bubble::ALL_KEYS, &group);
        shared_section(ui, films, &mut edited.film, Film::ALL_KEYS, &group);
        model.edit_selected(edited, &group);
    }
    if let Some(generator) = model.scene.generators.get(model.selected_generator) {
        let mut edited = generator.clone();
        section(ui, &format!("Generator {}", model.selected_generator + 1), &mut edited, Generator::ALL_KEYS);
        if edited != *generator {
            model.edit(Edit::Generator(model.selected_generator, edited.into()));
        }
    }
    motion(ui, model);
    let mut camera = model.scene.camera.clone();
    if section(ui, "Camera", &mut camera, Camera::ALL_KEYS) {
        model.look_from(camera);
    }
    let mut view = model.scene.view.clone();
    if section(ui, "View", &mut view, View::ALL_KEYS) {
        model.edit(Edit::View(view));
    }
    let mut lens = model.scene.lens.clone();
    if section(ui, "Lens", &mut lens, Lens::ALL_KEYS) {
        model.edit(Edit::Lens(lens));
    }
    let mut light = model.scene.light.clone();
    // What must be loaded is chosen in the panel of the light.
    let keys: Vec<Key> =
        Light::ALL_KEYS.iter().filter(|key| !["environment", "illuminant"].contains(&key.name)).copied().collect();
    if section(ui, "Light", &mut light, &keys) {
        light::change(model, light);
    }
}

/// The keys of the motion in force. A number that is dragged counts once it is let go, or each value on the way would be an event.
fn motion(ui: &mut Ui, model: &mut Model) {
    let (id, now) = (Id::unique("keys of the motion"), model.motion());
    let mut edited = ui.data(|data| data.get_temp::<Motion>(id)).unwrap_or_else(|| now.clone());
    section(ui, "Motion", &mut edited, Motion::ALL_KEYS);
    if edited != now && ui.input(|input| input.pointer.any_down()) {
        ui.data_mut(|data| data.insert_temp(id, edited));
        return;
    }
    ui.data_mut(|data| data.remove_temp::<Motion>(id));
    if edited != now {
        model.edit(Edit::Motion(edited.into()));
    }
}

/// The rows of a section; returns whether one was changed.
fn section<T>(ui: &mut Ui, title: &str, value: &mut T, keys: &[Key]) -> bool
where
    T: Serialize + DeserializeOwned + Default,
{
    shared_section(ui, title, value, keys, &Group::default())
}

/// The rows of a section of several bubbles, with a mark where they differ.
fn shared_section<T>(ui: &mut Ui, title: &str, value: &mut T, keys: &[Key], group: &Group) -> bool
where
    T: Serialize + DeserializeOwned + Default,
{
    let [mut table, normal] = [&*value, &T::default()].map(|value| toml::Table::try_from(value).unwrap_or_default());
    let before = table.clone();
    ui.strong(title);
    Grid::new(title).num_columns(3).spacing([8.0, 3.0]).show(ui, |ui| {
        for key in keys {
            match table.get_mut(key.name) {
                Some(now) => {
                    if row(ui, key, now, normal.get(key.name), group.is_mixed(key)) {
                        table.remove(key.name);
                    }
                }
                None => {
                    let Range::Within(low, high) = key.range else { continue };
                    if unset_row(ui, key) {
                        give::<T>(&mut table, key, middle(low, high));
                    }
                }
            }
            ui.end_row();
        }
    });
    if table == before {
        return false;
    }
    match Value::Table(table).try_into() {
        Ok(changed) => *value = changed,
        Err(error) => {
            log::warn!("{title} cannot be changed so: {error}");
            return false;
        }
    }
    true
}

/// Gives a key a number as its value, or three of them: whichever it takes.
fn give<T: DeserializeOwned>(table: &mut toml::Table, key: &Key, number: f64) {
    for value in [Value::Float(number), Value::Array(vec![Value::Float(number); 3])] {
        let mut tried = table.clone();
        tried.insert(key.name.to_owned(), value);
        if Value::Table(tried.clone()).try_into::<T>().is_ok() {
            *table = tried;
            return;
        }
    }
}

/// A key without a value; returns whether it shall have one.
fn unset_row(ui: &mut Ui, key: &Key) -> bool {
    ui.label(key.label).on_hover_text(format!("`{}`: {}", key.name, tooltip(key.help)));
    ui.small_button("set").on_hover_text(format!("Give {} a value; it has none", key.label)).clicked()
}

/// A whole number between the ends of a range: where they are both positive, as a ratio.
fn middle(low: f64, high: f64) -> f64 {
    let middle = if low > 0.0 { (low * high).sqrt() } else { 0.5 * (low + high) };
    middle.round()
}

/// The name of a key, its value, and a way back to the normal one; returns whether it shall have none.
fn row(ui: &mut Ui, key: &Key, now: &mut Value, normal: Option<&Value>, is_mixed: bool) -> bool {
    let label = ui.label(key.label).on_hover_text(format!("`{}`: {}", key.name, tooltip(key.help)));
    ui.horizontal(|ui| {
        field(ui, key, now, &label);
        if is_mixed {
            ui.weak(MIXED).on_hover_text("The selected bubbles differ; this is the value of one");
        }
    });
    let Some(normal) = normal else {
        let unset = ui.small_button("unset").on_hover_text(format!("{} has no value by default", key.label));
        return unset.clicked();
    };
    if normal != now {
        let reset = ui.small_button("reset").on_hover_text(format!("Set {} back to {normal}", key.label));
        if reset.clicked() {
            *now = normal.clone();
        }
    }
    false
}

/// The widget of a value.
fn field(ui: &mut Ui, key: &Key, now: &mut Value, label: &Response) {
    match (now, key.range) {
        (Value::Boolean(flag), _) => drop(ui.checkbox(flag, "").labelled_by(label.id)),
        (Value::Float(number), range) => drop(ui.add(dragged(number, range, key.unit)).labelled_by(label.id)),
        (Value::Integer(number), Range::Within(low, high)) => {
            let number = DragValue::new(number).range(low as i64..=high as i64).suffix(key.unit);
            ui.add(number).labelled_by(label.id);
        }
        (Value::Integer(number), _) => drop(ui.add(DragValue::new(number).range(0..=i64::MAX)).labelled_by(label.id)),
        (Value::String(word), Range::Word(names, helps)) => {
            let list = ComboBox::from_id_salt((label.id, key.name)).selected_text(word.as_str());
            let shown = list.show_ui(ui, |ui| {
                for (name, help) in names.iter().zip(helps) {
                    ui.selectable_value(word, (*name).to_owned(), *name).on_hover_text(*help);
                }
            });
            shown.response.labelled_by(label.id);
        }
        (Value::Array(parts), range) => {
            for part in parts {
                if let Value::Float(number) = part {
                    ui.add(dragged(number, range, "")).labelled_by(label.id);
                }
            }
            ui.weak(key.unit);
        }
        (other, _) => drop(ui.weak(other.to_string())),
    }
}

/// A number of a range, that moves by a hundredth of itself.
fn dragged<'a>(number: &'a mut f64, range: Range, unit: &str) -> DragValue<'a> {
    let speed = 0.01 * number.abs().max(0.1);
    let field = DragValue::new(number).speed(speed).max_decimals(4).suffix(unit);
    match range {
        Range::Within(low, high) => field.range(low..=high),
        _ => field,
    }
}
