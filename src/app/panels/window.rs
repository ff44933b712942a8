//! The window itself: its look, the size of its letters, and whether it fills the screen.

use egui::{Context, Id, Theme, Ui, ViewportCommand};

use crate::app::model::Model;

/// Sizes of letters, over the normal one, that the menu offers.
const ZOOMS: [f32; 6] = [0.8, 1.0, 1.25, 1.5, 1.75, 2.0];

/// Makes the window look as the settings say.
pub fn show(ctx: &Context, model: &mut Model) {
    let theme = if model.settings.is_light { Theme::Light } else { Theme::Dark };
    if ctx.theme() != theme {
        ctx.set_theme(theme);
    }
    // Ctrl with plus and minus changes it too.
    if ctx.zoom_factor() != model.settings.zoom {
        model.settings.zoom = ctx.zoom_factor();
    }
    // Told once: a system may refuse, or have none to tell.
    let told = Id::unique("fills the screen");
    let fills: bool = ctx.data(|data| data.get_temp(told).unwrap_or_default());
    if fills != model.presents {
        ctx.data_mut(|data| data.insert_temp(told, model.presents));
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(model.presents));
    }
}

/// The menu.
pub fn menu(ui: &mut Ui, model: &mut Model) {
    ui.checkbox(&mut model.settings.is_light, "Light panels");
    ui.label("Text size").on_hover_text("Ctrl and + or -");
    ui.horizontal(|ui| {
        for zoom in ZOOMS {
            if ui.selectable_label(model.settings.zoom == zoom, format!("{:.0} %", 100.0 * zoom)).clicked() {
                model.settings.zoom = zoom;
                ui.ctx().set_zoom_factor(zoom);
            }
        }
    });
    if ui.button("Picture alone").on_hover_text("The picture alone, on the whole screen (F11)").clicked() {
        model.presents = true;
    }
}
