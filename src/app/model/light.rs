//! The light of the scene: changed once it is loaded, and its lamps as things that the pointer holds.

use std::sync::Arc;

use super::Model;
use crate::{
    app::{
        edit::Edit,
        lamps::Grip,
        request::Request,
        tools::{Hand, Press, Tool},
    },
    physics::picture::Plate,
    plan::Resources,
    scene::{Light, View},
};

impl Model {
    /// Shows the scene in another light.
    pub fn adopt_light(&mut self, light: Light, resources: Resources) {
        // What was turned while the light was loading stays as it is.
        let Light { rotation_deg, intensity, .. } = self.scene.light;
        if let Some(back) = self.apply(Edit::Light(Light { rotation_deg, intensity, ..light })) {
            let before = std::mem::replace(&mut self.resources, resources);
            self.undo.record_whole("Light", vec![back], Some(before));
        }
        self.loading = None;
    }

    /// Puts a photograph that was loaded behind the bubbles.
    pub fn adopt_plate(&mut self, path: String, plate: Arc<Plate>) {
        if let Some(back) = self.apply(Edit::View(View { plate: Some(path), ..self.scene.view.clone() })) {
            let resources = Resources { plate: Some(plate), ..self.resources.clone() };
            let before = std::mem::replace(&mut self.resources, resources);
            self.undo.record_whole("Plate", vec![back], Some(before));
        }
        self.loading = None;
    }

    /// Whether a light is being loaded, or will be.
    #[must_use]
    pub fn loads_light(&self) -> bool {
        self.loading.is_some() || self.requests.iter().any(|request| matches!(request, Request::LoadLight(_)))
    }

    /// Lets the pointer, pressed or not, hold a lamp; it is loaded where it is let go. Tells whether it holds one.
    pub fn hold_lamp(&mut self, pressed: Option<Press>) -> bool {
        let (story, tick) = (&self.scene, self.clock.tick);
        match (&mut self.lamps.grip, pressed) {
            (Some(grip), Some(press)) => grip.at = press.at,
            (Some(grip), None) => {
                let moved = grip.moved(story, tick).map(|lamp| (grip.lamp, lamp));
                self.lamps.grip = None;
                let mut light = story.light.clone();
                moved.into_iter().for_each(|(index, lamp)| light.lamps[index] = lamp);
                if light != self.scene.light {
                    self.requests.push(Request::LoadLight(light));
                }
            }
            (None, Some(press)) if self.tool == Tool::Lamp && self.hand == Hand::Free => {
                self.lamps.grip = Grip::new(story, tick, press.from);
                self.lamps.selected = self.lamps.grip.map_or(self.lamps.selected, |grip| grip.lamp);
                if story.light.lamps.is_empty() {
                    self.messages.note("This light has no lamp: add one in the panel Light");
                }
            }
            (None, _) => {}
        }
        self.lamps.grip.is_some()
    }
}
