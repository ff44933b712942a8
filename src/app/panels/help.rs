//! The help: keys and pointer.

use egui::{Align, Context, Id, Label, Layout, Modal, RichText, Ui, vec2};

use super::dialog;
use crate::app::keys::{POINTER, Topic, listed};

/// Width of the help and of its keys, points; they are narrower in a narrow window.
const WIDTH: f32 = 620.0;
const KEYS: f32 = 200.0;

/// Shows the help over everything, until it is clicked away.
pub fn show(ctx: &Context, shows_help: &mut bool) {
    if !*shows_help {
        return;
    }
    let modal = Modal::new(Id::unique("help")).show(ctx, |ui| {
        ui.set_width(dialog::width(ui, WIDTH));
        ui.heading("Keys and pointer");
        ui.add_space(6.0);
        dialog::scroll(ui, 66.0).show(ui, |ui| {
            let pointer = POINTER.iter().map(|(what, help)| ((*what).to_owned(), *help));
            group(ui, "Pointer", pointer);
            for (topic, title) in Topic::ALL {
                let keys = listed(topic).map(|binding| (ctx.format_shortcut(&binding.shortcut), binding.help));
                group(ui, title, keys);
            }
        });
        ui.add_space(6.0);
        ui.button("Close").clicked()
    });
    if modal.inner || modal.should_close() {
        *shows_help = false;
    }
}

/// Lines under a heading: what is pressed or done, and what happens then.
fn group(ui: &mut Ui, title: &str, lines: impl Iterator<Item = (String, &'static str)>) {
    ui.label(RichText::new(title).strong().underline());
    for (what, help) in lines {
        ui.horizontal_top(|ui| {
            let width = KEYS.min(0.4 * ui.available_width());
            let size = vec2(width, 0.0);
            ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
                ui.set_width(width);
                ui.add(Label::new(RichText::new(what).strong()).wrap());
            });
            ui.add(Label::new(help).wrap());
        });
    }
    ui.add_space(8.0);
}
