//! The head of the panels: the scene, and where it comes from and goes to.

use egui::Ui;

use crate::{
    app::model::{Model, Request, Target},
    scene::preset_names,
};

/// Shows the scene's name and what can be done with it.
pub fn show(ui: &mut Ui, model: &mut Model) {
    ui.add_space(8.0);
    let name = egui::RichText::new(file_name(&model.name)).heading();
    ui.add(egui::Label::new(name).truncate()).on_hover_text(&model.name);
    ui.horizontal(|ui| {
        let ask = |requests: &mut Vec<Request>, target| requests.push(Request::Ask(target));
        ui.menu_button("Presets", |ui| presets(ui, &mut model.requests)).response.on_hover_text("Built-in scenes");
        if ui.button("Open…").on_hover_text("Open a scene file (Ctrl+O); or drop one on the window").clicked() {
            ask(&mut model.requests, Target::OpenScene);
        }
        if ui.button("Save…").on_hover_text("Save the scene with its history (Ctrl+S)").clicked() {
            ask(&mut model.requests, Target::SaveScene);
        }
        ui.menu_button("Picture", |ui| {
            if ui.button("PNG…").on_hover_text("Save the picture as the window shows it (Ctrl+P)").clicked() {
                ask(&mut model.requests, Target::SavePng);
            }
            if ui.button("EXR…").on_hover_text("Save the scene radiance, linear BT.709 (Ctrl+Shift+P)").clicked() {
                ask(&mut model.requests, Target::SaveExr);
            }
        });
        #[cfg(target_arch = "wasm32")]
        if ui.button("Link").on_hover_text("Copy a link to this page that holds the scene with its history").clicked() {
            model.requests.push(Request::CopyLink);
        }
        if ui.button("?").on_hover_text("Keys and pointer (F1)").clicked() {
            model.shows_help = !model.shows_help;
        }
    });
    ui.add_space(4.0);
}

/// The last part of a path.
pub fn file_name(path: &str) -> &str {
    std::path::Path::new(path).file_name().and_then(|name| name.to_str()).unwrap_or(path)
}

fn presets(ui: &mut Ui, requests: &mut Vec<Request>) {
    for name in preset_names() {
        if ui.button(name).clicked() {
            requests.push(Request::LoadScene(name.to_owned()));
        }
    }
}
