//! WHAT is shown: a scene as plain data, its TOML, the presets, and the events that make its history.
//!
//! Nothing here knows how the scene is computed or drawn, and nothing here touches files: reading a path is the caller's business.
//! Angles are in degrees and units stand in the names, as in the files; lengths are metres unless the name says otherwise.
//!
//! The file format, which a test holds to the code:
#![doc = include_str!("../../assets/scenes/README.md")]

mod bubble;
mod camera;
mod check;
mod document;
mod error;
mod event;
mod generator;
mod lens;
pub mod lesson;
mod light;
mod memory;
mod motion;
mod preset;
mod section;
mod setting;
mod source;
mod syntax;
#[cfg(test)]
mod tests;
mod words;

pub use crate::physics::{
    curve::Ease,
    film::{Boundary, Flow},
    transport::Scheme,
};
pub use bubble::{Bubble, BubbleKeys, Detail, Film, FilmIndexName, FilmKeys, FilmStateName};
pub use camera::{Camera, CameraKeys, Keyframe, KeyframeKeys, MAX_KEYFRAMES};
pub use check::Fault;
pub use error::{Problem, SceneError};
pub use event::{Blow, BlowKeys, Change, Drag, DragKeys, Event, Prick, PrickKeys, Stir, StirKeys};
pub use generator::{Generator, GeneratorKeys, Layout};
pub use lens::{Lens, LensKeys};
pub use light::{
    Backdrop, Environment, LampShape, Light, LightKeys, LightLamp, LightLampKeys, LightPatch, LightPatchKeys,
    LightSpectrum, LightSpectrumKeys, MAX_LAMPS, MAX_PATCHES, MAX_SPECTRUM_POINTS, Quality, View, ViewKeys,
};
pub use motion::{Motion, MotionChange, MotionKeys};
pub use preset::{PRESET_GROUPS, TEST_PRESETS, preset, preset_names, preset_sentence, preset_toml};
pub use section::{Key, Range};
pub use setting::Setting;
pub use source::SceneSource;
pub use words::{nearest, shorten};

use check::Checked;
use memory::Memory;
use serde::{Deserialize, Serialize};

/// The version of the scene format that this program reads and writes.
pub const VERSION: u32 = 1;

/// Everything that decides a picture, apart from its size, its quality and the moment it shows.
///
/// A value made in memory may break the ranges of its fields; [`Scene::validate`] tells. [`Scene::from_toml`] only returns valid ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scene {
    /// Version of the format: [`VERSION`].
    pub version: u32,
    /// The bubbles that have films of their own. A file without any `[[bubble]]` has one default bubble; `bubble = []` has none.
    #[serde(rename = "bubble")]
    pub bubbles: Vec<Bubble>,
    /// Bubbles that share films, many at once.
    #[serde(rename = "generator", skip_serializing_if = "Vec::is_empty")]
    pub generators: Vec<Generator>,
    /// From where it is seen, and how the camera moves.
    pub camera: Camera,
    /// Through which lens.
    pub lens: Lens,
    /// What lights it.
    pub light: Light,
    /// How the radiance becomes a picture.
    pub view: View,
    /// How the films move from tick 0 on.
    pub motion: Motion,
    /// What happens later, in the order of the ticks.
    #[serde(rename = "event", skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<Event>,
}

impl Default for Scene {
    /// The scene of the file `version = 1`, which is the preset `tent`.
    fn default() -> Self {
        Self {
            version: VERSION,
            bubbles: vec![Bubble::default()],
            generators: Vec::new(),
            camera: Camera::default(),
            lens: Lens::default(),
            light: Light::default(),
            view: View::default(),
            motion: Motion::default(),
            events: Vec::new(),
        }
    }
}

/// Whether the name of a liquid or of an illuminant is the path of a `.csv` file.
#[must_use]
pub fn is_table(name: &str) -> bool {
    name.trim().to_ascii_lowercase().ends_with(".csv")
}

impl Scene {
    /// Reads a scene from TOML. `name` stands for the text in error messages: a path, or a preset's name.
    ///
    /// # Errors
    ///
    /// The first of: text that is not TOML, a version that is missing or not [`VERSION`], an unknown key, a value of the wrong type,
    /// a value out of its range; each with the line it stands on.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, SceneError> {
        SceneSource::new(name, text, &[]).read()
    }

    /// The scene as TOML, which [`Scene::from_toml`] reads back to an equal scene.
    ///
    /// Every key is written, the default ones too: the file then lists what can be changed, and shows the same picture after a
    /// default changes in a later version. Only what is absent has no key (`constant`, `[[event]]`, what an event leaves alone).
    pub fn to_toml(&self) -> String {
        // Every field is a number, a word, a list or a struct with named fields, and TOML can write all of these.
        toml::to_string(self).expect("plain data is always TOML")
    }

    /// Tells whether every value lies in its range.
    ///
    /// # Errors
    ///
    /// The first value that does not, by the path of its key.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.check().map_err(|fault| SceneError::InMemory(fault.into()))
    }

    /// What is allowed, but no real bubble does; a sentence each.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.bubbles.iter().enumerate().filter_map(|(index, bubble)| bubble.warning(index + 1)).collect()
    }

    /// The motion in force at a tick: `[motion]` as changed by every event up to and including that tick.
    pub fn motion_at(&self, tick: u64) -> Motion {
        let past = self.events.iter().take_while(|event| event.tick <= tick);
        past.fold(self.motion.clone(), |motion, event| match &event.change {
            Change::Motion(change) => change.applied_to(motion),
            _ => motion,
        })
    }

    /// Every motion that is in force for some time, and the tick from which it is, in order: `[motion]` at first, then what the events make
    /// of it.
    pub fn motions(&self) -> impl Iterator<Item = (u64, Motion)> {
        self.numbered_motions().into_iter().map(|(tick, motion, _)| (tick, motion))
    }

    /// The motions, each with the index of the last event that shaped it; none has shaped the first.
    fn numbered_motions(&self) -> Vec<(u64, Motion, Option<usize>)> {
        let (mut motions, mut now) = (vec![(0, self.motion.clone(), None)], self.motion.clone());
        for (index, event) in self.events.iter().enumerate() {
            let Change::Motion(change) = &event.change else { continue };
            now = change.applied_to(now);
            // Of several changes at one tick none but the last leaves a motion that holds.
            motions.pop_if(|(tick, ..)| *tick == event.tick);
            motions.push((event.tick, now.clone(), Some(index)));
        }
        motions
    }

    /// The paths of all files that the scene names, as written: relative paths start from the scene's folder.
    pub fn paths_mut(&mut self) -> impl Iterator<Item = &mut String> {
        let environment = match &mut self.light.environment {
            Environment::File(path) => Some(path),
            Environment::Tent | Environment::Windows | Environment::Park | Environment::Studio => None,
        };
        let patches = self.light.patches.iter_mut().map(|patch| &mut patch.illuminant);
        let films = self.bubbles.iter_mut().map(|bubble| &mut bubble.film);
        let films = films.chain(self.generators.iter_mut().map(|generator| &mut generator.film));
        let liquids = films.filter_map(|film| match &mut film.index {
            FilmIndexName::Named(name) => Some(name),
            FilmIndexName::Water | FilmIndexName::Constant(_) => None,
        });
        let names = std::iter::once(&mut self.light.illuminant).chain(patches).chain(liquids);
        environment.into_iter().chain(&mut self.view.plate).chain(names.filter(|name| is_table(name)))
    }

    fn check(&self) -> Checked {
        check::in_range("version", self.version, VERSION..=VERSION)?;
        check::each("bubble", &self.bubbles, Bubble::check)?;
        self.check_memory()?;
        check::each("generator", &self.generators, Generator::check)?;
        self.camera.check().map_err(|fault| fault.inside("camera"))?;
        self.lens.check_ranges().map_err(|fault| fault.inside("lens"))?;
        self.light.check().map_err(|fault| fault.inside("light"))?;
        self.view.check_ranges().map_err(|fault| fault.inside("view"))?;
        self.motion.check().map_err(|fault| fault.inside("motion"))?;
        check::each("event", &self.events, |event| event.check(self.bubbles.len()))?;
        self.check_boundaries()?;
        self.check_order()
    }

    /// Refuses more films and more bubbles than there is memory for, before any is made.
    fn check_memory(&self) -> Checked {
        let mut memory = Memory::default();
        for (index, bubble) in self.bubbles.iter().enumerate() {
            memory
                .add_films(&bubble.film, 1)
                .map_err(|reason| Fault::new("film", reason).inside_item("bubble", index))?;
        }
        for (index, generator) in self.generators.iter().enumerate() {
            memory.add_bubbles(generator).map_err(|fault| fault.inside_item("generator", index))?;
        }
        Ok(())
    }

    /// A bath is one plane that all bubbles stand on, and films that end somewhere do not turn that end away.
    fn check_boundaries(&self) -> Checked {
        let mut baths = self.bubbles.iter().filter(|bubble| bubble.boundary == Boundary::Bath);
        if let Some(first) = baths.next() {
            let stands = |bubble: &Bubble| (bubble.boundary, bubble.center_m[2]) == (first.boundary, first.center_m[2]);
            if let Some(other) = self.bubbles.iter().position(|bubble| !stands(bubble)) {
                let reason = "is not on the bath that others stand on; give all bubbles `boundary = \"bath\"` and the same height";
                return Err(Fault::new("boundary", reason).inside_item("bubble", other));
            }
            if !self.generators.is_empty() {
                let reason =
                    "makes bubbles over a bath, which cannot be drawn yet; leave out the bath or the generator";
                return Err(Fault::new("layout", reason).inside_item("generator", 0));
            }
            let lifts =
                |event: &Event| matches!(&event.change, Change::Drag(drag) if drag.to_m[2] != first.center_m[2]);
            if let Some(event) = self.events.iter().position(lifts) {
                let reason = format!("takes a bubble off its bath; end at its height, {}", first.center_m[2]);
                return Err(Fault::new("to_m", reason).inside_item("event", event));
            }
        }
        if self.bubbles.iter().all(|bubble| bubble.boundary == Boundary::Free) {
            return Ok(());
        }
        self.numbered_motions().into_iter().try_for_each(|(_, motion, event)| {
            motion.check_with_rims().map_err(|fault| match event {
                Some(index) => fault.inside_item("event", index),
                None => fault.inside("motion"),
            })
        })
    }

    fn check_order(&self) -> Checked {
        let late = self.events.windows(2).position(|pair| pair[1].tick < pair[0].tick);
        late.map_or(Ok(()), |first| {
            let (before, tick) = (self.events[first].tick, self.events[first + 1].tick);
            let reason = format!("is {tick} after an event at tick {before}; sort the events by tick");
            Err(Fault::new("tick", reason).inside_item("event", first + 1))
        })
    }
}
