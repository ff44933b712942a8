//! The head of the panels: the scene, and where it comes from and goes to.

use egui::Ui;

use super::window;
use crate::app::{
    model::Model,
    request::{Request, Target},
};

/// Shows the scene's name and what can be done with it.
pub fn show(ui: &mut Ui, model: &mut Model) {
    ui.add_space(8.0);
    let name = egui::RichText::new(file_name(&model.name)).heading();
    ui.add(egui::Label::new(name).truncate()).on_hover_text(&model.name);
    ui.horizontal(|ui| {
        let ask = |requests: &mut Vec<Request>, target| requests.push(Request::Ask(target));
        if ui.button("Presets").on_hover_text("Built-in scenes").clicked() {
            model.shows_gallery = true;
        }
        ui.menu_button("File", |ui| file(ui, model)).response.on_hover_text("Scene files; or drop one on the window");
        ui.menu_button("Picture", |ui| {
            if ui.button("PNG…").on_hover_text("Save the picture as the window shows it (Ctrl+P)").clicked() {
                ask(&mut model.requests, Target::SavePng);
            }
            if ui.button("EXR…").on_hover_text("Save the scene radiance, linear BT.709 (Ctrl+Shift+P)").clicked() {
                ask(&mut model.requests, Target::SaveExr);
            }
            #[cfg(not(target_arch = "wasm32"))]
            if ui.button("Copy").on_hover_text("Copy the picture to the clipboard").clicked() {
                model.compare.wants = Some(crate::app::compare::Want::Copy);
            }
        });
        #[cfg(target_arch = "wasm32")]
        if ui.button("Link").on_hover_text("Copy a link to this page that holds the scene with its history").clicked() {
            model.requests.push(Request::CopyLink);
        }
        ui.menu_button("Window", |ui| window::menu(ui, model));
        if ui.button("?").on_hover_text("Keys and pointer (F1)").clicked() {
            model.shows_help = !model.shows_help;
        }
    });
    ui.horizontal(|ui| steps(ui, model));
    ui.add_space(4.0);
}

/// What can be taken back, and what can be made again.
fn steps(ui: &mut Ui, model: &mut Model) {
    let button = |ui: &mut Ui, name: &str, step: Option<&str>, key: &str| {
        let help = step
            .map_or(format!("Nothing to {} ({key})", name.to_lowercase()), |step| format!("{name}: {step} ({key})"));
        ui.add_enabled(step.is_some(), egui::Button::new(name))
            .on_hover_text(&help)
            .on_disabled_hover_text(help)
            .clicked()
    };
    if button(ui, "Undo", model.undo.last_name(), "Ctrl+Z") {
        model.undo();
    }
    if button(ui, "Redo", model.undo.next_name(), "Ctrl+Shift+Z") {
        model.redo();
    }
    if ui.button("Save").on_hover_text("Save the scene with its history (Ctrl+S)").clicked() {
        model.save();
    }
    if model.undo.is_dirty() {
        ui.weak("edited");
    }
}

fn file(ui: &mut Ui, model: &mut Model) {
    if ui.button("Open…").on_hover_text("Open a scene file (Ctrl+O)").clicked() {
        model.requests.push(Request::Ask(Target::OpenScene));
    }
    if ui.button("Save as…").on_hover_text("Save the scene to another file (Ctrl+Shift+S)").clicked() {
        model.requests.push(Request::Ask(Target::SaveScene));
    }
    #[cfg(not(target_arch = "wasm32"))]
    if ui.button("Export…").on_hover_text("A picture of any size, a video or a map of the film (Ctrl+E)").clicked() {
        model.requests.push(Request::Export);
    }
    if !model.settings.recent.is_empty() {
        ui.separator();
    }
    for path in model.settings.recent.clone() {
        let name = egui::Button::new(file_name(&path)).wrap_mode(egui::TextWrapMode::Extend);
        if ui.add(name).on_hover_text(&path).clicked() {
            model.ask_for(Request::LoadScene(path));
        }
    }
}

/// The last part of a path.
pub fn file_name(path: &str) -> &str {
    std::path::Path::new(path).file_name().and_then(|name| name.to_str()).unwrap_or(path)
}
