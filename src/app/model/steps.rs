//! Changes of the scene, each made through one gate, taken back and made again.

use super::Model;
use crate::{
    app::{
        edit::{Edit, begins_anew, new_seed},
        time_line::Mark,
        tools::Hand,
        undo::Step,
    },
    plan::{film_owners, settle_detail},
    scene::Motion,
};

impl Model {
    /// Makes a change of the scene that can be taken back, or reports why it is not valid; returns whether it was made. The only way to change
    /// a scene, but for a camera that follows the pointer or its keyframes.
    pub fn edit(&mut self, edit: Edit) -> bool {
        let back = self.apply(edit);
        let is_made = back.is_some();
        back.into_iter().for_each(|back| self.undo.record(back, &self.scene));
        is_made
    }

    /// Makes a change of the scene, and returns what takes it back, or reports why it is not valid.
    pub(super) fn apply(&mut self, edit: Edit) -> Option<Edit> {
        let tick = self.clock.tick;
        let back = self.scene.change(|scene| {
            let back = edit.apply(scene, tick);
            // A bubble that was just added must not begin anew when the camera moves.
            settle_detail(scene);
            back
        });
        if let Err(error) = self.scene.validate() {
            self.scene.change(|scene| back.apply(scene, tick));
            self.messages.problem(error.to_string());
            return None;
        }
        let owners = match &back {
            Edit::Films(bubbles, generators) => Some(film_owners(bubbles, generators)),
            Edit::Bubbles(bubbles, _) => Some(film_owners(bubbles, &self.scene.generators)),
            _ => None,
        };
        if owners.is_some_and(|before| begins_anew(&before, self.scene.owners())) {
            self.clock.reset();
        }
        self.forget_selection(&back);
        Some(back)
    }

    /// Events and keyframes are selected by their index, which another list gives to another one.
    fn forget_selection(&mut self, back: &Edit) {
        let is_other = match back {
            Edit::History(..) | Edit::Bubbles(..) | Edit::Forget(_) => true,
            Edit::Camera(before) => before.keyframes != self.scene.camera.keyframes,
            _ => false,
        };
        if is_other {
            self.time_line.selected = None;
        }
    }

    /// Takes the last step back.
    pub fn undo(&mut self) {
        let Some(step) = self.undo.last_done() else { return };
        let step = self.reverse(step);
        self.undone_at = Some(self.clock.moment(&self.scene.motion));
        self.messages.note(format!("Undone: {}", step.name));
        self.undo.undone(step);
    }

    /// Makes the step again that was taken back last.
    pub fn redo(&mut self) {
        let Some(step) = self.undo.last_undone() else { return };
        let step = self.reverse(step);
        // A view is of its moment: at another one the keyframes say where the camera is.
        self.followed = self.followed.filter(|(moment, _)| self.undone_at == Some(*moment));
        self.messages.note(format!("Redone: {}", step.name));
        self.undo.redone(step);
    }

    /// Takes a step back, and returns the one that makes it again.
    fn reverse(&mut self, mut step: Step) -> Step {
        let (owners, tick) = (self.scene.owners().to_vec(), self.clock.tick);
        let edits = std::mem::take(&mut step.back).into_iter().rev();
        step.back = self.scene.change(|scene| edits.map(|edit| edit.apply(scene, tick)).collect());
        step.back.iter().for_each(|edit| self.forget_selection(edit));
        step.resources = step.resources.map(|before| std::mem::replace(&mut self.resources, before));
        if begins_anew(&owners, self.scene.owners()) {
            self.clock.reset();
        }
        // What a slider or the hand holds is of another scene.
        (self.motion_draft, self.hand, self.gizmo) = (None, Hand::default(), None);
        step
    }

    /// Removes the event or keyframe that is selected on the time line.
    pub fn remove_selected(&mut self) {
        match self.time_line.selected.take() {
            Some(Mark::Event(index)) if index < self.scene.events.len() => drop(self.edit(Edit::Forget(index))),
            Some(Mark::Keyframe(index)) => self.delete_keyframe(index),
            _ => {}
        }
    }

    /// Blows every film again, with a new seed for film and flow.
    pub fn new_seeds(&mut self) {
        self.clock.reset();
        let motion = Motion { seed: new_seed(), ..self.motion() };
        let back = [Edit::Motion(motion.into()), Edit::Reseed].into_iter().filter_map(|edit| self.apply(edit));
        let back = back.collect();
        self.undo.record_whole("New seeds", back, None);
    }
}
