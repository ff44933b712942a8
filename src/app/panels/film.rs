//! The film panel: how the film of a bubble begins.

use egui::Ui;

use super::widgets::{choice, group, seed, slider};
use crate::{
    app::model::Model,
    scene::{Boundary, Bubble, Detail, Film, FilmIndexName, FilmStateName},
};

const STATES: [(FilmStateName, &str, &str); 3] = [
    (FilmStateName::Uniform, "uniform", "One thickness everywhere; nothing flows"),
    (FilmStateName::Rest, "rest", "Sorted by gravity: thin above, thick below"),
    (FilmStateName::Blown, "blown", "Freshly blown: random patches, not yet sorted"),
];

const BOUNDARIES: [(Boundary, &str, &str); 4] = [
    (Boundary::Free, "free", "A whole bubble in the air"),
    (Boundary::Bath, "bath", "Half a bubble that stands on water"),
    (Boundary::Ring, "ring", "A dome of film on a ring, open below"),
    (Boundary::Drop, "drop", "A whole bubble with a drop hanging at its bottom"),
];

/// Cells along a panel's edge that the panel offers.
const CELLS: [(u32, &str, &str); 4] = [
    (64, "64", "24 576 cells"),
    (128, "128", "98 304 cells"),
    (256, "256", "393 216 cells"),
    (512, "512", "1 572 864 cells: for fast graphics cards"),
];

/// How many of them.
const DETAILS: [(Detail, &str, &str); 2] = [
    (Detail::Full, "full", "All of these cells"),
    (Detail::Half, "half", "Half along each edge: enough for a bubble of 40 pixels, for a third of the time"),
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
    let Some(bubble) = model.scene.bubbles.get_mut(model.selected) else {
        ui.label("This scene has no bubble.");
        return;
    };
    slider(ui, "Radius", &mut bubble.radius_mm, 0.1..=5000.0, "Radius of the bubble", |slider| {
        slider.logarithmic(true).suffix(" mm").max_decimals(1)
    });
    let (mut film, mut ended) = (bubble.film.clone(), bubble.clone());
    end(ui, &mut ended);
    edit(ui, &mut film);
    model.change_film(model.selected, film);
    model.change_end(model.selected, &ended);
}

/// What the film ends at, and what comes from there.
fn end(ui: &mut Ui, bubble: &mut Bubble) {
    choice(ui, "Boundary", &mut bubble.boundary, &BOUNDARIES);
    if bubble.boundary == Boundary::Free {
        return;
    }
    if bubble.boundary != Boundary::Bath {
        let lowest = if bubble.boundary == Boundary::Ring { 150.0 } else { 175.0 };
        bubble.rim_deg = bubble.rim_deg.min(lowest);
        let help = "Where the film ends: the angle from the top";
        slider(ui, "Rim", &mut bubble.rim_deg, 30.0..=lowest, help, |slider| slider.suffix("°").max_decimals(0));
    }
    let help = "How many thin patches rise from the rim";
    slider(ui, "Regeneration", &mut bubble.regeneration, 0.0..=10.0, help, |slider| slider.max_decimals(1));
    let most_mm = 0.25 * bubble.radius_mm.clamp(0.4, 400.0);
    bubble.patch_mm = bubble.patch_mm.min(most_mm);
    slider(ui, "Patches", &mut bubble.patch_mm, 0.1..=most_mm, "Radius of these patches", |slider| {
        slider.logarithmic(true).suffix(" mm").max_decimals(1)
    });
}

fn edit(ui: &mut Ui, film: &mut Film) {
    choice(ui, "State", &mut film.state, &STATES);
    let thinnest_nm = if film.state == FilmStateName::Uniform { 0.0 } else { 1.0 };
    film.thickness_nm = film.thickness_nm.max(thinnest_nm);
    let help = "Mean thickness of the film, outside to inside.\nBlack below 30 nm, brightest colours from 200 to 600 nm, pale above 1000 nm.";
    slider(ui, "Thickness", &mut film.thickness_nm, thinnest_nm..=10_000.0, help, |slider| {
        slider.logarithmic(true).smallest_positive(1.0).suffix(" nm").max_decimals(1)
    });
    if film.state != FilmStateName::Uniform {
        let help = "How strongly gravity has sorted the film: 0 is even, above 0 thick below.";
        slider(ui, "Stratification", &mut film.stratification, -5.0..=5.0, help, |slider| slider.max_decimals(2));
    }
    index(ui, &mut film.index);
    let help = "Thickness of the layer of soap molecules on each face; soap has about 2 nm.";
    slider(ui, "Skins", &mut film.skin_nm, 0.0..=5.0, help, |slider| slider.suffix(" nm").max_decimals(1));
    if film.state == FilmStateName::Blown {
        seed(ui, "Film seed", &mut film.seed, "The seed of the random film: each seed gives another film");
    }
    if film.state != FilmStateName::Uniform {
        choice(ui, "Cells", &mut film.cells, &CELLS);
        choice(ui, "Detail", &mut film.detail, &DETAILS);
    }
}

/// Water's index varies with the wavelength; any other one is a number.
fn index(ui: &mut Ui, index: &mut FilmIndexName) {
    const WATER_LIKE: f64 = 1.333;
    group(ui, "Index", |ui| {
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
    if let FilmIndexName::Constant(n) = index {
        slider(ui, "Value", n, 1.0..=4.0, "Refractive index of all films", |slider| slider.fixed_decimals(3));
    }
}
