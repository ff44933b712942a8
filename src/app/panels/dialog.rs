//! What dialogs over everything have in common.

use egui::{ScrollArea, Ui};

/// Room around a dialog with its margins, points.
const AROUND: f32 = 44.0;

/// The part of a dialog that scrolls, where the rest of it needs a height in points. It is as high as what it holds, or as the window allows: a
/// dialog that grew by and by would move under the pointer.
pub fn scroll(ui: &Ui, rest: f32) -> ScrollArea {
    let height = (ui.ctx().content_rect().height() - AROUND - rest).max(60.0);
    ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink([false, true])
}

/// The width of a dialog that would like to have one.
pub fn width(ui: &Ui, wanted: f32) -> f32 {
    (ui.ctx().content_rect().width() - AROUND).clamp(60.0, wanted)
}
