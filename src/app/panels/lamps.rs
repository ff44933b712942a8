//! The lamps of the light: their list in the panel, and the one that the pointer holds in the picture.

use egui::{Align2, CollapsingHeader, Color32, Context, LayerId, Rect, Stroke, Ui, vec2};

use super::{
    places,
    widgets::{choice, group, number, number_within, slider},
};
use crate::{
    app::{lamps::Lamps, model::Model, request::Request},
    scene::{LampShape, Light, LightLamp, MAX_LAMPS},
};

/// Colour temperature of a lamp that is first given one: a halogen lamp, K.
const HALOGEN_K: f64 = 3200.0;

/// Shows and edits the lamps, folded at first.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let title = format!("Lamps ({})", model.scene.light.lamps.len());
    CollapsingHeader::new(title).id_salt("lamps").default_open(false).show_unindented(ui, |ui| body(ui, model));
}

fn body(ui: &mut Ui, model: &mut Model) {
    let (is_down, is_let_go) = ui.input(|input| (input.pointer.any_down(), input.pointer.any_released()));
    if !is_down && !is_let_go && !model.loads_light() {
        (model.lamps.draft, model.lamps.asked) = (None, None);
    }
    let before = model.lamps.draft.clone().unwrap_or_else(|| model.scene.light.lamps.clone());
    let mut lamps = before.clone();
    list(ui, &mut lamps, &mut model.lamps);
    if let Some(lamp) = lamps.get_mut(model.lamps.selected) {
        rows(ui, lamp);
    }
    if lamps != before {
        model.lamps.draft = Some(lamps);
    }
    // They are loaded once a slider is let go: a drag is one step to undo.
    if let Some(lamps) = model.lamps.draft.clone().filter(|_| !is_down)
        && model.lamps.asked.as_ref() != Some(&lamps)
    {
        model.lamps.asked = Some(lamps.clone());
        model.requests.push(Request::LoadLight(Light { lamps, ..model.scene.light.clone() }));
    }
}

/// Which lamp is shown, and buttons that add and delete lamps.
fn list(ui: &mut Ui, lamps: &mut Vec<LightLamp>, editor: &mut Lamps) {
    editor.selected = editor.selected.min(lamps.len().saturating_sub(1));
    if lamps.len() > 1 {
        let mut number = editor.selected + 1;
        slider(ui, "Lamp", &mut number, 1..=lamps.len(), "The lamp to edit", |slider| slider);
        editor.selected = number - 1;
    }
    group(ui, "", |ui| {
        let add = ui.add_enabled(lamps.len() < MAX_LAMPS, egui::Button::new("Add lamp"));
        if add.on_hover_text("A softbox; the tool Lamp (8) moves it by its highlight").clicked() {
            lamps.push(LightLamp::default());
            editor.selected = lamps.len() - 1;
        }
        if !lamps.is_empty() && ui.button("Delete lamp").on_hover_text("Delete this lamp").clicked() {
            lamps.remove(editor.selected);
            editor.selected = editor.selected.saturating_sub(1);
        }
    });
}

fn rows(ui: &mut Ui, lamp: &mut LightLamp) {
    let keys = LightLamp::KEYS;
    choice(ui, &keys.shape, &mut lamp.shape);
    number_within(ui, &keys.azimuth_deg, &mut lamp.azimuth_deg, -180.0..=180.0, |slider| slider.max_decimals(1));
    number(ui, &keys.elevation_deg, &mut lamp.elevation_deg, |slider| slider.max_decimals(1));
    number_within(ui, &keys.roll_deg, &mut lamp.roll_deg, -180.0..=180.0, |slider| slider.max_decimals(1));
    number(ui, &keys.width_deg, &mut lamp.width_deg, |slider| slider.logarithmic(true).max_decimals(2));
    if lamp.shape != LampShape::Disc {
        number(ui, &keys.height_deg, &mut lamp.height_deg, |slider| slider.logarithmic(true).max_decimals(2));
    }
    number(ui, &keys.edge_deg, &mut lamp.edge_deg, |slider| slider.max_decimals(1));
    number(ui, &keys.luminance, &mut lamp.luminance, |slider| {
        slider.logarithmic(true).smallest_positive(0.01).max_decimals(2)
    });
    group(ui, "Colour", |ui| {
        let mut is_white = lamp.kelvin.is_none();
        if ui.checkbox(&mut is_white, "of the illuminant").on_hover_text("Or that of a black body").changed() {
            lamp.kelvin = (!is_white).then_some(HALOGEN_K);
        }
    });
    if let Some(kelvin) = &mut lamp.kelvin {
        number(ui, &keys.kelvin, kelvin, |slider| slider.logarithmic(true).max_decimals(0));
    }
}

/// Shows where the lamp goes that the pointer holds in the picture.
pub fn held(ctx: &Context, rect: Rect, model: &Model) {
    let Some(grip) = model.lamps.grip else { return };
    let Some(lamp) = grip.moved(&model.scene, model.clock.tick) else { return };
    let painter = ctx.layer_painter(LayerId::background()).with_clip_rect(rect);
    let at = places::at(rect, grip.at);
    painter.circle_stroke(at, 8.0, Stroke::new(2.0, Color32::WHITE));
    let told = format!("lamp {}: azimuth {}°, elevation {}°", grip.lamp + 1, lamp.azimuth_deg, lamp.elevation_deg);
    places::tag(&painter, Align2::LEFT_CENTER, at + vec2(14.0, 0.0), told);
}
