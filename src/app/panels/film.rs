//! The film panel: how the film of a bubble begins.

use egui::Ui;

use super::widgets::{choice, choice_of, group, number, number_within, options_of, seed, slider};
use crate::{
    app::{edit::Edit, model::Model},
    scene::{Boundary, Bubble, Detail, Film, FilmIndexName, FilmStateName, Range},
};

/// Cells along a panel's edge that the panel offers.
const CELLS: [(u32, &str, &str); 4] = [
    (64, "64", "24 576 cells"),
    (128, "128", "98 304 cells"),
    (256, "256", "393 216 cells"),
    (512, "512", "1 572 864 cells: for fast graphics cards"),
];

/// Shows and edits the selected bubble's film.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let count = model.scene.bubbles.len();
    model.selected = model.selected.min(count.saturating_sub(1));
    if count > 1 {
        let mut number = model.selected + 1;
        slider(ui, "Bubble", &mut number, 1..=count, "The bubble to edit", |slider| slider);
        model.selected = number - 1;
    }
    bubbles(ui, model);
    let Some(bubble) = model.scene.bubbles.get(model.selected) else {
        let made = !model.scene.generators.is_empty();
        ui.label(if made { "Generators make all bubbles of this scene." } else { "This scene has no bubble." });
        return;
    };
    let mut edited = bubble.clone();
    number(ui, &Bubble::KEYS.radius_mm, &mut edited.radius_mm, |slider| slider.logarithmic(true).max_decimals(1));
    boundary(ui, &mut edited);
    film(ui, &mut edited.film);
    if edited != *bubble {
        model.edit(Edit::Bubble(model.selected, edited.into()));
    }
}

/// Buttons that add and delete bubbles.
fn bubbles(ui: &mut Ui, model: &mut Model) {
    let selected = model.scene.bubbles.get(model.selected).cloned();
    group(ui, "", |ui| {
        if ui.button("Add").on_hover_text("Add a bubble with the default film").clicked() {
            model.add_bubble(Bubble::default());
        }
        let Some(selected) = selected else { return };
        if ui.button("Duplicate").on_hover_text("Another bubble like this one (Ctrl+D)").clicked() {
            model.add_bubble(selected);
        }
        if ui.button("Delete").on_hover_text("Delete this bubble and its events").clicked() {
            model.delete_bubble();
        }
    });
}

/// What the film ends at, and what comes from there.
fn boundary(ui: &mut Ui, bubble: &mut Bubble) {
    choice(ui, &Bubble::KEYS.boundary, &mut bubble.boundary);
    if let Some([lowest, highest]) = bubble.boundary.rims_deg() {
        bubble.rim_deg = bubble.rim_deg.clamp(lowest, highest);
        number_within(ui, &Bubble::KEYS.rim_deg, &mut bubble.rim_deg, lowest..=highest, |s| s.max_decimals(0));
    }
    if bubble.boundary == Boundary::Free {
        return;
    }
    number(ui, &Bubble::KEYS.regeneration, &mut bubble.regeneration, |slider| slider.max_decimals(1));
    let max_mm = 0.25 * bubble.radius_mm.clamp(0.4, 400.0);
    bubble.patch_mm = bubble.patch_mm.min(max_mm);
    number_within(ui, &Bubble::KEYS.patch_mm, &mut bubble.patch_mm, 0.1..=max_mm, |slider| {
        slider.logarithmic(true).max_decimals(1)
    });
}

/// How a film begins.
pub fn film(ui: &mut Ui, film: &mut Film) {
    let keys = Film::KEYS;
    choice(ui, &keys.state, &mut film.state);
    let Range::Within(flowing_nm, thickest_nm) = keys.thickness_nm.range else { unreachable!("a range of numbers") };
    let thinnest_nm = if film.state == FilmStateName::Uniform { 0.0 } else { flowing_nm };
    film.thickness_nm = film.thickness_nm.max(thinnest_nm);
    number_within(ui, &keys.thickness_nm, &mut film.thickness_nm, thinnest_nm..=thickest_nm, |slider| {
        slider.logarithmic(true).smallest_positive(1.0).max_decimals(1)
    });
    if film.state != FilmStateName::Uniform {
        number(ui, &keys.stratification, &mut film.stratification, |slider| slider.max_decimals(2));
    }
    index(ui, &mut film.index);
    number(ui, &keys.skin_nm, &mut film.skin_nm, |slider| slider.max_decimals(1));
    if film.state == FilmStateName::Blown {
        seed(ui, &keys.seed, &mut film.seed);
    }
    if film.state != FilmStateName::Uniform {
        options_of(ui, keys.cells.label, &mut film.cells, &CELLS);
        // The window has settled whether a film takes all or half of its cells.
        choice_of(ui, keys.detail.label, &mut film.detail, &[Detail::Full, Detail::Half]);
    }
}

/// Water's index varies with the wavelength; any other one is a number.
fn index(ui: &mut Ui, index: &mut FilmIndexName) {
    const WATER_LIKE: f64 = 1.333;
    group(ui, Film::KEYS.index.label, |ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        let is_constant = matches!(index, FilmIndexName::Constant(_));
        let liquids = [
            ("water", FilmIndexName::Water, "Water at 20 °C, with its dispersion"),
            ("glycerol", FilmIndexName::Named("glycerol 30%".to_owned()), "Water with 30 % of glycerol by mass"),
        ];
        for (label, liquid, help) in liquids {
            if ui.selectable_label(*index == liquid, label).on_hover_text(help).clicked() {
                *index = liquid;
            }
        }
        let help = "The same index at every wavelength";
        if ui.selectable_label(is_constant, "constant").on_hover_text(help).clicked() && !is_constant {
            *index = FilmIndexName::Constant(WATER_LIKE);
        }
    });
    if let (FilmIndexName::Constant(n), Range::Within(lowest, highest)) = (index, Film::KEYS.index.range) {
        slider(ui, "Value", n, lowest..=highest, "Refractive index of the film", |slider| slider.fixed_decimals(3));
    }
}
