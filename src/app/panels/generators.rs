//! The panel of generators: the bubbles that one makes, and the films that they share.

use egui::Ui;

use super::{
    film,
    widgets::{choice, group, number, number_within, seed, slider},
};
use crate::{
    app::{edit::Edit, group::Group, model::Model},
    scene::{Generator, Layout},
};

/// The most bubbles, and the longest life in seconds, that the panel offers; a file may ask for more.
const MOST_BUBBLES: u32 = 20_000;
const LONGEST_S: f64 = 100.0;

/// Shows and edits the generators of a scene.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let count = model.scene.generators.len();
    model.selected_generator = model.selected_generator.min(count.saturating_sub(1));
    if count > 1 {
        let mut number = model.selected_generator + 1;
        slider(ui, "Generator", &mut number, 1..=count, "The generator to edit", |slider| slider);
        model.selected_generator = number - 1;
    }
    add_and_delete(ui, model);
    let Some(generator) = model.scene.generators.get(model.selected_generator) else { return };
    let mut edited = generator.clone();
    bubbles(ui, &mut edited);
    way(ui, &mut edited);
    film::film(ui, &mut edited.film, &mut Group::default());
    if edited != *generator {
        model.edit(Edit::Generator(model.selected_generator, edited.into()));
    }
}

/// Buttons that add and delete generators.
fn add_and_delete(ui: &mut Ui, model: &mut Model) {
    group(ui, "", |ui| {
        let mut generators = model.scene.generators.clone();
        if ui.button("Add").on_hover_text("Add a generator of many bubbles").clicked() {
            generators.push(Generator::default());
            model.selected_generator = generators.len() - 1;
        } else if !generators.is_empty() && ui.button("Delete").on_hover_text("Delete this generator").clicked() {
            generators.remove(model.selected_generator);
        } else {
            return;
        }
        model.edit(Edit::Films(model.scene.bubbles.clone(), generators));
    });
}

fn bubbles(ui: &mut Ui, generator: &mut Generator) {
    let keys = Generator::KEYS;
    choice(ui, &keys.layout, &mut generator.layout);
    let most = MOST_BUBBLES.max(generator.count);
    number_within(ui, &keys.count, &mut generator.count, 1..=most, |slider| slider.logarithmic(true));
    seed(ui, &keys.seed, &mut generator.seed);
    number(ui, &keys.radius_mm, &mut generator.radius_mm, |slider| slider.logarithmic(true).max_decimals(1));
    number(ui, &keys.radius_spread, &mut generator.radius_spread, |slider| slider.max_decimals(2));
    number(ui, &keys.thickness_spread, &mut generator.thickness_spread, |slider| slider.max_decimals(2));
    // A wand's bubbles need an end.
    let shortest_s = if generator.layout == Layout::Wand { 0.5 } else { 0.0 };
    generator.life_s = generator.life_s.max(shortest_s);
    let longest_s = LONGEST_S.max(generator.life_s);
    number_within(ui, &keys.life_s, &mut generator.life_s, shortest_s..=longest_s, |slider| slider.max_decimals(1));
}

fn way(ui: &mut Ui, generator: &mut Generator) {
    let keys = Generator::KEYS;
    if generator.layout == Layout::Wand {
        number(ui, &keys.speed_m_s, &mut generator.speed_m_s, |slider| slider.logarithmic(true).max_decimals(2));
        number(ui, &keys.spread_deg, &mut generator.spread_deg, |slider| slider.max_decimals(0));
        number(ui, &keys.wobble, &mut generator.wobble, |slider| slider.max_decimals(2));
    }
    number_within(ui, &keys.rise_m_s, &mut generator.rise_m_s, -1.0..=1.0, |slider| slider.max_decimals(2));
    number(ui, &keys.wander_mm, &mut generator.wander_mm, |slider| slider.logarithmic(true).max_decimals(0));
}
