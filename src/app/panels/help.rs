//! The help: keys and pointer.

use egui::{Context, Grid, Id, Modal};

use crate::app::keys::{BINDINGS, POINTER};

/// Shows the help over everything, until it is clicked away.
pub fn show(ctx: &Context, shows_help: &mut bool) {
    if !*shows_help {
        return;
    }
    let modal = Modal::new(Id::unique("help")).show(ctx, |ui| {
        ui.heading("Keys and pointer");
        ui.add_space(6.0);
        egui::ScrollArea::vertical().show(ui, |ui| {
            Grid::new("keys").num_columns(2).spacing([28.0, 5.0]).show(ui, |ui| {
                let mut bindings: Vec<_> = BINDINGS.iter().collect();
                // Of two keys with the same action, one is listed.
                bindings.dedup_by_key(|binding| binding.action);
                let keys = bindings.iter().map(|binding| (ctx.format_shortcut(&binding.shortcut), binding.help));
                let pointer = POINTER.iter().map(|(what, help)| ((*what).to_owned(), *help));
                for (what, help) in pointer.chain(keys) {
                    ui.strong(what);
                    ui.label(help);
                    ui.end_row();
                }
            });
        });
        ui.add_space(6.0);
        ui.button("Close").clicked()
    });
    if modal.inner || modal.should_close() {
        *shows_help = false;
    }
}
