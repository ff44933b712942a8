//! Bubbles as things: selected, added, deleted.

use glam::{DVec2, DVec3};

use super::Model;
use crate::{
    app::{edit::Edit, history, tools},
    scene::Bubble,
};

impl Model {
    /// Selects the bubble at a place in the picture, right and up from its middle in heights of it; beside all bubbles, none is outlined.
    pub fn select(&mut self, place: DVec2) {
        let bubble = tools::bubble_at(&self.scene, self.clock.tick, place);
        self.outlines = bubble.is_some();
        self.selected = bubble.unwrap_or(self.selected);
    }

    /// Adds a copy of a bubble to the right of the selected one, and selects it.
    pub fn add_bubble(&mut self, mut bubble: Bubble) {
        let (mut bubbles, generators) = (self.scene.bubbles.clone(), self.scene.generators.clone());
        if let Some(beside) = bubbles.get(self.selected) {
            let gap_m = 1.1e-3 * (beside.radius_mm + bubble.radius_mm);
            let place = DVec3::from(beside.center_m) + gap_m * self.scene.camera.right();
            bubble.center_m = place.to_array().map(|part| (part * 1e4).round() / 1e4);
        }
        bubbles.push(bubble);
        let last = bubbles.len() - 1;
        if self.edit(Edit::Films(bubbles, generators)) {
            (self.selected, self.outlines) = (last, true);
        }
    }

    /// Deletes the selected bubble; what would have happened to it is forgotten, and what happens to others stays.
    pub fn delete_bubble(&mut self) {
        let (mut bubbles, generators) = (self.scene.bubbles.clone(), self.scene.generators.clone());
        if self.selected >= bubbles.len() {
            return;
        }
        bubbles.remove(self.selected);
        let events = history::without_bubble(&self.scene.events, self.selected);
        let back = [Edit::History(self.scene.motion.clone().into(), events), Edit::Films(bubbles, generators)];
        let back = back.into_iter().filter_map(|edit| self.apply(edit)).collect();
        self.undo.record_whole("Delete bubble", back, None);
        (self.selected, self.outlines) = (self.selected.saturating_sub(1), false);
    }
}
