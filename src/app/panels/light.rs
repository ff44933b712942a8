//! The light panel.

use egui::Ui;

use super::{
    header, lamps, spectrum,
    widgets::{group, number, number_within, row, slider},
};
use crate::{
    app::{
        edit::Edit,
        model::Model,
        request::{Request, Target},
    },
    physics::colour::{BUILT_IN, BuiltIn},
    scene::{Environment, Light},
};

/// Radiance of a constant light when it is first chosen.
const CONSTANT: [f64; 3] = [0.5; 3];
/// The black body that is chosen first: a halogen lamp.
const BLACK_BODY: &str = "3200 K";

/// Shows and edits the light.
pub fn show(ui: &mut Ui, model: &mut Model) {
    environment(ui, model);
    illuminant(ui, model);
    let mut light = model.scene.light.clone();
    if let Some(radiance) = &mut light.constant {
        group(ui, "Radiance", |ui| {
            for (value, name) in radiance.iter_mut().zip(["red", "green", "blue"]) {
                let number = egui::DragValue::new(value).range(0.0..=65504.0).speed(0.005).max_decimals(3);
                ui.add(number).on_hover_text(format!("Constant radiance, {name}, linear BT.709"));
            }
        });
    }
    number_within(ui, &Light::KEYS.rotation_deg, &mut light.rotation_deg, -180.0..=180.0, |s| s.max_decimals(1));
    number(ui, &Light::KEYS.intensity, &mut light.intensity, |slider| {
        slider.logarithmic(true).smallest_positive(0.01).max_decimals(2)
    });
    change(model, light);
    // What folds stands below, or the rows of the whole light would read as those of a lamp.
    spectrum::show(ui, model);
    lamps::show(ui, model);
}

/// Changes the light. Before lamps, even light is a part of the map of the surroundings, which is then computed anew.
pub(super) fn change(model: &mut Model, light: Light) {
    if light.constant != model.scene.light.constant && !light.lamps.is_empty() {
        model.requests.push(Request::LoadLight(light));
    } else if light != model.scene.light {
        model.edit(Edit::Light(light));
    }
}

fn environment(ui: &mut Ui, model: &mut Model) {
    let light = &model.scene.light;
    let is = |name: &Environment| light.constant.is_none() && light.environment == *name;
    let mut requested: Option<Light> = None;
    // More choices than one row holds.
    group(ui, "Environment", |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            let built_in = [
                (Environment::Tent, "tent", "A photographer's light tent with soft lamps"),
                (Environment::Windows, "windows", "A dark room with bright windows"),
                (Environment::Park, "park", "A meadow among dark trees, clouds and a low sun"),
                (Environment::Studio, "studio", "Two softboxes and a strip light on black"),
            ];
            for (name, label, help) in built_in {
                if ui.selectable_label(is(&name), label).on_hover_text(help).clicked() && !is(&name) {
                    requested = Some(Light { environment: name, constant: None, ..light.clone() });
                }
            }
            let constant = ui.selectable_label(light.constant.is_some(), "constant");
            if constant.on_hover_text("The same radiance from everywhere").clicked() && light.constant.is_none() {
                requested = Some(Light { constant: Some(CONSTANT), ..light.clone() });
            }
        })
    });
    group(ui, "Panorama", |ui| {
        let open = ui.button("Open…").on_hover_text("An equirectangular .exr or .hdr file; or drop one on the window");
        if open.clicked() {
            model.requests.push(Request::Ask(Target::OpenEnvironment));
        }
        if let (Environment::File(path), None) = (&light.environment, light.constant) {
            let name = egui::RichText::new(header::file_name(path)).weak();
            ui.add(egui::Label::new(name).truncate()).on_hover_text(path);
        }
    });
    model.requests.extend(requested.map(Request::LoadLight));
}

fn illuminant(ui: &mut Ui, model: &mut Model) {
    let light = &model.scene.light;
    let mut chosen: Option<&str> = None;
    let mut opens = false;
    let is_named = light.spectrum.is_none();
    let shown = if is_named { header::file_name(&light.illuminant) } else { "spectrum" };
    row(ui, "Illuminant", "The spectrum of white light", |ui| {
        let list = egui::ComboBox::from_id_salt("illuminant").selected_text(shown);
        list.show_ui(ui, |ui| {
            for BuiltIn { name, help, .. } in BUILT_IN {
                let is = is_named && light.illuminant.eq_ignore_ascii_case(name);
                if ui.selectable_label(is, *name).on_hover_text(*help).clicked() && !is {
                    chosen = Some(name);
                }
            }
            let is = is_named && kelvin(&light.illuminant).is_some();
            let help = "Light of a glowing body, of a temperature that can be set";
            if ui.selectable_label(is, "black body").on_hover_text(help).clicked() && !is {
                chosen = Some(BLACK_BODY);
            }
            let help = "A table of wavelengths and powers (.csv)";
            opens = ui.selectable_label(false, "from a file…").on_hover_text(help).clicked();
        })
        .response
    });
    let changed = chosen.map(|name| Light { illuminant: name.to_owned(), spectrum: None, ..light.clone() });
    model.requests.extend(changed.map(Request::LoadLight));
    model.requests.extend(opens.then_some(Request::Ask(Target::OpenIlluminant)));
    let kelvin = kelvin(&model.scene.light.illuminant).filter(|_| model.scene.light.spectrum.is_none());
    if let Some(kelvin) = kelvin {
        temperature(ui, model, kelvin);
    }
}

/// The temperature of an illuminant that is a black body, K.
fn kelvin(illuminant: &str) -> Option<f64> {
    illuminant.trim().strip_suffix(['K', 'k'])?.trim().parse().ok()
}

/// The slider of a black body's temperature. The light is loaded once the slider is let go, so that a drag is one step to undo.
fn temperature(ui: &mut Ui, model: &mut Model, kelvin: f64) {
    let id = egui::Id::unique("temperature");
    let mut draft = ui.data(|data| data.get_temp(id)).unwrap_or(kelvin);
    let help = "Temperature of the black body: low is red, high is blue";
    let slid = slider(ui, "Temperature", &mut draft, 1000.0..=20_000.0, help, |slider| {
        slider.logarithmic(true).suffix(" K").max_decimals(0)
    });
    if slid.dragged() {
        ui.data_mut(|data| data.insert_temp(id, draft));
        return;
    }
    ui.data_mut(|data| data.remove::<f64>(id));
    if draft != kelvin && model.loading.is_none() {
        let light = Light { illuminant: format!("{} K", draft.round()), ..model.scene.light.clone() };
        model.requests.push(Request::LoadLight(light));
    }
}
