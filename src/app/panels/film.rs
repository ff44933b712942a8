//! The film panel: how the film of a bubble begins.

use egui::Ui;

use super::widgets::{
    MIXED, group, mixed_options, number, number_within, options_of, shared, shared_choice, shared_seed, slider,
};
use crate::{
    Words,
    app::{group::Group, model::Model},
    scene::{Boundary, Bubble, Detail, Film, FilmIndexName, FilmStateName, Range},
};

/// Cells along a panel's edge that the panel offers.
const CELLS: [(u32, &str, &str); 4] = [
    (64, "64", "24 576 cells"),
    (128, "128", "98 304 cells"),
    (256, "256", "393 216 cells"),
    (512, "512", "1 572 864 cells: for fast graphics cards"),
];

/// Shows and edits the film of the selected bubble, and with it those of the others that are selected.
pub fn show(ui: &mut Ui, model: &mut Model) {
    // First, for the rows below come and go with the number of bubbles.
    bubbles(ui, model);
    let count = model.scene.bubbles.len();
    model.selected = model.selected.min(count.saturating_sub(1));
    model.also_selected.retain(|index| *index < count);
    if count > 1 {
        let mut number = model.selected + 1;
        slider(ui, "Bubble", &mut number, 1..=count, "The bubble to edit", |slider| slider);
        if number != model.selected + 1 {
            model.select_one(number - 1);
        }
        selection(ui, model, count);
    }
    let Some(bubble) = model.scene.bubbles.get(model.selected) else {
        let made = !model.scene.generators.is_empty();
        ui.label(if made { "Generators make all bubbles of this scene." } else { "This scene has no bubble." });
        return;
    };
    let (mut edited, mut group) = (bubble.clone(), model.group());
    number(ui, &Bubble::KEYS.radius_mm, &mut edited.radius_mm, |slider| {
        shared(slider.logarithmic(true).max_decimals(1), &group, &Bubble::KEYS.radius_mm)
    });
    boundary(ui, &mut edited, &mut group);
    film(ui, &mut edited.film, &mut group);
    model.edit_selected(edited, &group);
}

/// How many bubbles are selected, and a way to select all.
fn selection(ui: &mut Ui, model: &mut Model, count: usize) {
    let selected = model.selection().len();
    group(ui, "Selected", |ui| {
        ui.label(format!("{selected} of {count}"))
            .on_hover_text("Edits change all of them; Shift or Ctrl with a click");
        if selected < count && ui.button("Select all").on_hover_text("Select all bubbles (Ctrl+A)").clicked() {
            model.select_all();
        }
    });
}

/// Buttons that add and delete bubbles.
fn bubbles(ui: &mut Ui, model: &mut Model) {
    group(ui, "", |ui| {
        if ui.button("Add").on_hover_text("Add a bubble with the default film").clicked() {
            model.add_bubble(Bubble::default());
        }
        if model.scene.bubbles.is_empty() {
            return;
        }
        if ui.button("Duplicate").on_hover_text("More bubbles like the selected ones (Ctrl+D)").clicked() {
            model.duplicate();
        }
        if ui.button("Delete").on_hover_text("Delete the selected bubbles and their events").clicked() {
            model.delete_bubbles();
        }
    });
}

/// What the film ends at, and what comes from there.
fn boundary(ui: &mut Ui, bubble: &mut Bubble, group: &mut Group) {
    let keys = Bubble::KEYS;
    shared_choice(ui, &keys.boundary, &mut bubble.boundary, Boundary::CHOICES, group);
    if let Some([lowest, highest]) = bubble.boundary.rims_deg() {
        bubble.rim_deg = bubble.rim_deg.clamp(lowest, highest);
        number_within(ui, &keys.rim_deg, &mut bubble.rim_deg, lowest..=highest, |slider| {
            shared(slider.max_decimals(0), group, &keys.rim_deg)
        });
    }
    if bubble.boundary == Boundary::Free {
        return;
    }
    if bubble.boundary == Boundary::Ring {
        number(ui, &keys.wire_mm, &mut bubble.wire_mm, |slider| shared(slider.max_decimals(1), group, &keys.wire_mm));
    }
    number(ui, &keys.regeneration, &mut bubble.regeneration, |slider| {
        shared(slider.max_decimals(1), group, &keys.regeneration)
    });
    let max_mm = 0.25 * bubble.radius_mm.clamp(0.4, 400.0);
    bubble.patch_mm = bubble.patch_mm.min(max_mm);
    number_within(ui, &keys.patch_mm, &mut bubble.patch_mm, 0.1..=max_mm, |slider| {
        shared(slider.logarithmic(true).max_decimals(1), group, &keys.patch_mm)
    });
}

/// How a film begins, or the films of several bubbles that have some of it in common.
pub fn film(ui: &mut Ui, film: &mut Film, group: &mut Group) {
    let keys = Film::KEYS;
    shared_choice(ui, &keys.state, &mut film.state, FilmStateName::CHOICES, group);
    let Range::Within(flowing_nm, thickest_nm) = keys.thickness_nm.range else { unreachable!("a range of numbers") };
    let thinnest_nm = if film.state == FilmStateName::Uniform { 0.0 } else { flowing_nm };
    film.thickness_nm = film.thickness_nm.max(thinnest_nm);
    number_within(ui, &keys.thickness_nm, &mut film.thickness_nm, thinnest_nm..=thickest_nm, |slider| {
        shared(slider.logarithmic(true).smallest_positive(1.0).max_decimals(1), group, &keys.thickness_nm)
    });
    if film.state != FilmStateName::Uniform {
        number(ui, &keys.stratification, &mut film.stratification, |slider| {
            shared(slider.max_decimals(2), group, &keys.stratification)
        });
    }
    index(ui, &mut film.index, group);
    number(ui, &keys.skin_nm, &mut film.skin_nm, |slider| shared(slider.max_decimals(1), group, &keys.skin_nm));
    if film.state == FilmStateName::Blown {
        shared_seed(ui, &keys.seed, &mut film.seed, group);
    }
    if film.state != FilmStateName::Uniform {
        cells(ui, &mut film.cells, group);
        // The window has settled whether a film takes all or half of its cells.
        shared_choice(ui, &keys.detail, &mut film.detail, &[Detail::Full, Detail::Half], group);
    }
}

fn cells(ui: &mut Ui, cells: &mut u32, group: &mut Group) {
    let key = Film::KEYS.cells;
    if !group.is_mixed(&key) {
        options_of(ui, key.label, cells, &CELLS);
    } else if let Some(chosen) = mixed_options(ui, key.label, &CELLS) {
        *cells = chosen;
        group.set(&key);
    }
}

/// Water's index varies with the wavelength; any other one is a number.
fn index(ui: &mut Ui, index: &mut FilmIndexName, bubbles: &mut Group) {
    const WATER_LIKE: f64 = 1.333;
    let key = Film::KEYS.index;
    let is_mixed = bubbles.is_mixed(&key);
    group(ui, key.label, |ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        let is_constant = matches!(index, FilmIndexName::Constant(_));
        let liquids = [
            ("water", FilmIndexName::Water, "Water at 20 °C, with its dispersion"),
            ("glycerol", FilmIndexName::Named("glycerol 30%".to_owned()), "Water with 30 % of glycerol by mass"),
        ];
        for (label, liquid, help) in liquids {
            let is = !is_mixed && *index == liquid;
            if ui.selectable_label(is, label).on_hover_text(help).clicked() {
                *index = liquid;
                bubbles.set(&key);
            }
        }
        let help = "The same index at every wavelength";
        let is = !is_mixed && is_constant;
        if ui.selectable_label(is, "constant").on_hover_text(help).clicked() && !is {
            *index = if is_constant { index.clone() } else { FilmIndexName::Constant(WATER_LIKE) };
            bubbles.set(&key);
        }
        if is_mixed {
            ui.weak(MIXED).on_hover_text("The selected bubbles differ");
        }
    });
    if let (FilmIndexName::Constant(n), Range::Within(lowest, highest)) = (index, key.range) {
        slider(ui, "Value", n, lowest..=highest, "Refractive index of the film", |slider| {
            shared(slider.fixed_decimals(3), bubbles, &key)
        });
    }
}
