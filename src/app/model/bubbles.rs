//! Bubbles as things: selected, added, moved, deleted, edited together.

use glam::{DVec2, DVec3};

use super::Model;
use crate::{
    app::{
        edit::Edit,
        group::Group,
        history,
        tools::{self, Press, Tool},
        wand::Wand,
    },
    scene::{Boundary, Bubble, Change, Drag},
};

/// Size of the world, m: bubbles stay within it along each axis.
const FARTHEST_M: f64 = 1000.0;

impl Model {
    /// The indices of all selected bubbles, in the order of the scene.
    #[must_use]
    pub fn selection(&self) -> Vec<usize> {
        (0..self.scene.bubbles.len()).filter(|index| self.is_selected(*index)).collect()
    }

    /// Whether a bubble is selected.
    #[must_use]
    pub fn is_selected(&self, index: usize) -> bool {
        index == self.selected || self.also_selected.contains(&index)
    }

    /// Selects one bubble, and no others.
    pub fn select_one(&mut self, index: usize) {
        self.selected = index;
        self.also_selected.clear();
    }

    /// Selects all bubbles.
    pub fn select_all(&mut self) {
        self.also_selected = (0..self.scene.bubbles.len()).collect();
        self.outlines = !self.scene.bubbles.is_empty();
    }

    /// Selects the bubble at a place in the picture, right and up from its middle in heights of it; beside all bubbles, none is outlined. If it `adds`, the
    /// bubble is selected beside others, or no longer if it was.
    pub fn select(&mut self, place: DVec2, adds: bool) {
        let bubble = tools::bubble_at(&self.scene, self.clock.tick, place);
        match bubble {
            // The panels show a bubble that was never clicked: it is none of several.
            Some(index) if adds && self.outlines => self.toggle(index),
            Some(index) => self.select_one(index),
            None if adds => return,
            None => self.also_selected.clear(),
        }
        self.outlines = bubble.is_some();
    }

    /// Adds a bubble to the selected ones, or takes it from them; one remains.
    fn toggle(&mut self, index: usize) {
        self.also_selected.insert(self.selected);
        if !self.is_selected(index) {
            self.also_selected.insert(index);
            self.selected = index;
            return;
        }
        if self.also_selected.len() > 1 {
            self.also_selected.remove(&index);
        }
        if self.selected == index {
            self.selected = self.also_selected.first().copied().unwrap_or(index);
        }
    }

    /// What the selected bubbles have in common.
    #[must_use]
    pub fn group(&self) -> Group {
        Group::new(self.selection().into_iter().map(|index| &self.scene.bubbles[index]))
    }

    /// Edits the selected bubble; what has changed, or was set, also changes in all others that are selected.
    pub fn edit_selected(&mut self, edited: Bubble, group: &Group) {
        let Some(before) = self.scene.bubbles.get(self.selected) else { return };
        if edited == *before && !group.is_set() {
            return;
        }
        let mut bubbles = self.scene.bubbles.clone();
        for index in self.selection().into_iter().filter(|index| *index != self.selected) {
            bubbles[index] = group.change(before, &edited, &bubbles[index]);
        }
        bubbles[self.selected] = edited;
        if bubbles != self.scene.bubbles {
            self.edit(Edit::Films(bubbles, self.scene.generators.clone()));
        }
    }

    /// Adds a bubble to the right of the selected one, and selects it.
    pub fn add_bubble(&mut self, mut bubble: Bubble) {
        if let Some(beside) = self.scene.bubbles.get(self.selected) {
            let gap_m = 1.1e-3 * (beside.radius_mm + bubble.radius_mm);
            let place = DVec3::from(beside.center_m) + gap_m * self.scene.camera.right();
            bubble.center_m = rounded(place);
        }
        self.add_bubbles(vec![bubble]);
    }

    /// Adds copies of the selected bubbles to the right of all of them, and selects the copies.
    pub fn duplicate(&mut self) {
        let right = self.scene.camera.right();
        let originals = self.selection().into_iter().map(|index| self.scene.bubbles[index].clone());
        let mut copies: Vec<Bubble> = originals.collect();
        let reach =
            |bubble: &Bubble, side: f64| DVec3::from(bubble.center_m).dot(right) + side * 1e-3 * bubble.radius_mm;
        let left_m = copies.iter().map(|bubble| reach(bubble, -1.0)).fold(f64::INFINITY, f64::min);
        let right_m = copies.iter().map(|bubble| reach(bubble, 1.0)).fold(f64::NEG_INFINITY, f64::max);
        for copy in &mut copies {
            copy.center_m = rounded(DVec3::from(copy.center_m) + 1.1 * (right_m - left_m) * right);
        }
        self.add_bubbles(copies);
    }

    /// Blows a new bubble with the wand while the pointer is pressed, and adds it once the pointer is let go. Tells whether the camera shall stand.
    pub fn blow(&mut self, pressed: Option<Press>) -> bool {
        if self.tool != Tool::Wand {
            self.wand = None;
            return false;
        }
        if let Some(press) = pressed {
            self.wand = Wand::new(&self.scene.camera, press);
        } else if let Some(wand) = self.wand.take() {
            let bubble = wand.bubble();
            self.add_bubbles(vec![Bubble { center_m: rounded(wand.center_m), ..bubble }]);
        }
        true
    }

    fn add_bubbles(&mut self, added: Vec<Bubble>) {
        let (mut bubbles, generators) = (self.scene.bubbles.clone(), self.scene.generators.clone());
        let first = bubbles.len();
        bubbles.extend(added);
        let after = bubbles.len();
        if after > first && self.edit(Edit::Films(bubbles, generators)) {
            self.select_one(after - 1);
            self.also_selected.extend(first..after - 1);
            (self.outlines, self.shows_added) = (true, true);
        }
    }

    /// Whether all selected bubbles are in a picture of an aspect, which is its width over its height.
    pub(super) fn sees_selection(&self, aspect: f64) -> bool {
        let is_inside =
            |(middle, radius): (DVec2, f64)| (middle.abs() + radius).cmple(0.5 * DVec2::new(aspect, 1.0)).all();
        let tick = self.clock.tick;
        self.selection().into_iter().all(|index| tools::outline(&self.scene, tick, index).is_some_and(is_inside))
    }

    /// Deletes the selected bubbles; what would have happened to them is forgotten, and what happens to others stays.
    pub fn delete_bubbles(&mut self) {
        let (mut bubbles, mut events) = (self.scene.bubbles.clone(), self.scene.events.clone());
        let selection = self.selection();
        let Some(first) = selection.first().copied() else { return };
        // From the last on, so that the others keep their indices.
        for index in selection.into_iter().rev() {
            bubbles.remove(index);
            events = history::without_bubble(&events, index);
        }
        if self.edit(Edit::Bubbles(bubbles, events)) {
            self.select_one(first.saturating_sub(1));
            self.outlines = false;
        }
    }

    /// Where a bubble is put at the clock's tick, m: its center, or the place that it was last dragged to.
    #[must_use]
    pub fn put_m(&self, index: usize) -> DVec3 {
        let dragged = history::last_drag(&self.scene.events, index, self.clock.tick);
        match dragged.map(|event| &self.scene.events[event].change) {
            Some(Change::Drag(drag)) => drag.to_m.into(),
            _ => self.scene.bubbles.get(index).map_or(DVec3::ZERO, |bubble| bubble.center_m.into()),
        }
    }

    /// Moves the selected bubbles by a way in m: from the beginning, or those that were dragged before now, from there on. Bubbles on a bath keep their
    /// height.
    pub fn move_selected(&mut self, by_m: DVec3) {
        let (mut bubbles, mut events) = (self.scene.bubbles.clone(), self.scene.events.clone());
        for index in self.selection() {
            let to_m = self.moved(index, by_m);
            let dragged = history::last_drag(&events, index, self.clock.tick);
            match dragged.map(|event| &mut events[event].change) {
                Some(Change::Drag(drag)) => drag.to_m = to_m,
                _ => bubbles[index].center_m = to_m,
            }
        }
        if bubbles != self.scene.bubbles || events != self.scene.events {
            self.edit(Edit::Bubbles(bubbles, events));
        }
    }

    /// Where a bubble goes that is moved by a way in m.
    fn moved(&self, index: usize, by_m: DVec3) -> [f64; 3] {
        let put_m = self.put_m(index);
        // Without the noise of a sum, which would stand in a saved scene.
        let mut to_m = (put_m + by_m).to_array().map(|part| (part * 1e9).round() / 1e9);
        to_m = to_m.map(|part| part.clamp(-FARTHEST_M, FARTHEST_M));
        if self.scene.bubbles.get(index).is_some_and(|bubble| bubble.boundary == Boundary::Bath) {
            to_m[2] = put_m.z;
        }
        to_m
    }

    /// Takes the other selected bubbles along with one that the pointer drags.
    pub(super) fn drag_along(&mut self, drag: &Drag) {
        if !self.is_selected(drag.bubble) {
            return;
        }
        let by_m = DVec3::from(drag.to_m) - self.put_m(drag.bubble);
        for bubble in self.selection().into_iter().filter(|index| *index != drag.bubble) {
            let to_m = self.moved(bubble, by_m);
            self.edit(Edit::Happens(Change::Drag(Drag { bubble, to_m })));
        }
    }
}

/// To a ten-thousandth, so that a saved scene shows short numbers, and within the world.
fn rounded(place_m: DVec3) -> [f64; 3] {
    let within = |part: f64| ((part * 1e4).round() / 1e4).clamp(-FARTHEST_M, FARTHEST_M);
    place_m.to_array().map(within)
}
