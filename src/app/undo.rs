//! Undo and redo: each step holds the edits that take it back, under a name that people read.

use std::mem::discriminant;

use super::edit::Edit;
use crate::{
    plan::Resources,
    scene::{Bubble, Camera, Change, Event, Film, Generator, Key, Lens, Light, Motion, MotionChange, Scene, View},
};

/// Steps that are remembered.
const REMEMBERED: usize = 500;
/// Moves of the camera within this time are one step, s: a wheel has no end that could be seen.
const GOES_ON_S: f64 = 1.0;

/// What one undo takes back.
#[derive(Debug)]
pub struct Step {
    /// What was done, for people.
    pub name: String,
    /// What takes it back, the latest last.
    pub back: Vec<Edit>,
    /// What the scene named before, if that has changed too.
    pub resources: Option<Resources>,
    /// Tells states of the scene apart.
    id: u64,
}

/// The steps that can be taken back and made again.
#[derive(Debug, Default)]
pub struct Undo {
    past: Vec<Step>,
    future: Vec<Step>,
    /// The state before the first step that is remembered.
    oldest: u64,
    /// The state that is in a file.
    saved: u64,
    newest: u64,
    /// Whether the last step may still grow.
    grows: bool,
    now_s: f64,
    edited_s: f64,
}

impl Undo {
    /// Lets time pass: what is done while the pointer is held is one step.
    pub fn pass(&mut self, now_s: f64, is_held: bool) {
        self.now_s = now_s;
        let moves = self.past.last().is_some_and(|step| matches!(step.back[..], [Edit::Camera(_)]));
        self.grows &= is_held || (moves && now_s - self.edited_s < GOES_ON_S);
    }

    /// Enters a change of the scene, which is made already, by what takes it back.
    pub fn record(&mut self, back: Edit, scene: &Scene) {
        self.future.clear();
        self.edited_s = self.now_s;
        self.newest += 1;
        let grows = std::mem::replace(&mut self.grows, true);
        match self.past.last_mut() {
            Some(step) if grows && discriminant(&step.back[0]) == discriminant(&back) => {
                // The oldest of several whole values takes all of them back.
                if matches!(back, Edit::Forget(_)) {
                    step.back.push(back);
                }
                (step.name, step.id) = (name(&step.back[0], scene), self.newest);
            }
            _ => self.push(Step { name: name(&back, scene), back: vec![back], resources: None, id: self.newest }),
        }
    }

    /// Enters a change of several parts of the scene, or of what it names, as one step.
    pub fn record_whole(&mut self, name: &str, back: Vec<Edit>, resources: Option<Resources>) {
        self.future.clear();
        self.newest += 1;
        self.grows = false;
        self.push(Step { name: name.to_owned(), back, resources, id: self.newest });
    }

    fn push(&mut self, step: Step) {
        self.past.push(step);
        if self.past.len() > REMEMBERED {
            self.oldest = self.past.remove(0).id;
        }
    }

    /// Takes the last step to be taken back; see [`Undo::undone`].
    pub fn last_done(&mut self) -> Option<Step> {
        self.grows = false;
        self.past.pop()
    }

    /// Takes the step to be made again; see [`Undo::redone`].
    pub fn last_undone(&mut self) -> Option<Step> {
        self.grows = false;
        self.future.pop()
    }

    /// Enters what makes a step again that was taken back.
    pub fn undone(&mut self, step: Step) {
        self.future.push(step);
    }

    /// Enters what takes a step back that was made again.
    pub fn redone(&mut self, step: Step) {
        self.past.push(step);
    }

    /// The name of what would be taken back.
    #[must_use]
    pub fn last_name(&self) -> Option<&str> {
        self.past.last().map(|step| step.name.as_str())
    }

    /// The name of what would be made again.
    #[must_use]
    pub fn next_name(&self) -> Option<&str> {
        self.future.last().map(|step| step.name.as_str())
    }

    /// The state that the scene is in now.
    #[must_use]
    pub fn state(&self) -> u64 {
        self.past.last().map_or(self.oldest, |step| step.id)
    }

    /// How many steps can be taken back.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.past.len()
    }

    /// Whether the scene differs from the one in its file.
    #[must_use]
    pub fn is_dirty(&self) -> bool {
        self.state() != self.saved
    }

    /// A state of the scene is in a file now.
    pub fn saved(&mut self, state: u64) {
        self.saved = state;
    }

    /// What there is now is in no file, though no step led to it: it was recovered.
    pub fn recovered(&mut self) {
        (self.newest, self.oldest) = (1, 1);
    }
}

/// What was done, from what takes it back and the scene after it.
fn name(back: &Edit, scene: &Scene) -> String {
    match back {
        Edit::Camera(before) => camera(before, &scene.camera),
        Edit::View(before) => one_of(before, &scene.view, View::ALL_KEYS, "View"),
        Edit::Lens(before) => one_of(before, &scene.lens, Lens::ALL_KEYS, "Lens"),
        Edit::Light(before) => one_of(before, &scene.light, Light::ALL_KEYS, "Light"),
        Edit::Films(bubbles, generators) => films(bubbles, generators, scene),
        Edit::Bubbles(bubbles, _) if bubbles.len() > scene.bubbles.len() => "Delete bubble".to_owned(),
        Edit::Bubbles(..) => "Move bubble".to_owned(),
        Edit::History(motion, events) => history(motion, events, scene),
        Edit::Forget(index) => scene.events.get(*index).map_or("History".to_owned(), |event| happening(&event.change)),
        _ => "Change".to_owned(),
    }
}

fn camera(before: &Camera, after: &Camera) -> String {
    // A drag changes place and direction, a row of a panel one of the others.
    let Camera { fov_y_deg, focal_mm, sensor_mm, follow_deg, .. } = *before;
    if *before == (Camera { fov_y_deg, focal_mm, sensor_mm, follow_deg, ..after.clone() }) {
        one_of(before, after, Camera::ALL_KEYS, "Camera")
    } else {
        "Camera".to_owned()
    }
}

fn films(bubbles: &[Bubble], generators: &[Generator], scene: &Scene) -> String {
    let lengths = |a: usize, b: usize, one: &str| match a.cmp(&b) {
        std::cmp::Ordering::Less => Some(format!("Add {one}")),
        std::cmp::Ordering::Greater => Some(format!("Delete {one}")),
        std::cmp::Ordering::Equal => None,
    };
    let changed = || {
        let bubble = bubbles.iter().zip(&scene.bubbles).find(|(a, b)| a != b).map(|(a, b)| {
            if a.film == b.film {
                one_of(a, b, Bubble::ALL_KEYS, "Bubble")
            } else {
                one_of(&a.film, &b.film, Film::ALL_KEYS, "Film")
            }
        });
        let generator = || {
            let (a, b) = generators.iter().zip(&scene.generators).find(|(a, b)| a != b)?;
            Some(one_of(a, b, Generator::ALL_KEYS, "Generator"))
        };
        bubble.or_else(generator).unwrap_or_else(|| "Films".to_owned())
    };
    lengths(bubbles.len(), scene.bubbles.len(), "bubble")
        .or_else(|| lengths(generators.len(), scene.generators.len(), "generator"))
        .unwrap_or_else(changed)
}

fn history(motion: &Motion, events: &[Event], scene: &Scene) -> String {
    if *motion != scene.motion {
        return one_of(motion, &scene.motion, Motion::ALL_KEYS, "Motion");
    }
    match events.len().cmp(&scene.events.len()) {
        std::cmp::Ordering::Greater => "Remove event".to_owned(),
        std::cmp::Ordering::Equal => "Move event".to_owned(),
        std::cmp::Ordering::Less => {
            let added = scene.events.iter().zip(events).position(|(a, b)| a != b).unwrap_or(events.len());
            scene.events.get(added).map_or("History".to_owned(), |event| happening(&event.change))
        }
    }
}

/// What happens at an event, as a thing that one does.
fn happening(change: &Change) -> String {
    let verb = match change {
        Change::Motion(change) => return one_of(&MotionChange::default(), change, MotionChange::ALL_KEYS, "Motion"),
        Change::Stir(_) => "Stir",
        Change::Blow(_) => "Blow",
        Change::Drag(_) => "Move bubble",
        Change::Prick(_) => "Prick",
    };
    verb.to_owned()
}

/// The name of the one key that differs, or that of the whole where several do.
fn one_of<T: serde::Serialize>(before: &T, after: &T, keys: &[Key], whole: &str) -> String {
    let [before, after] = [before, after].map(|value| toml::Table::try_from(value).unwrap_or_default());
    let mut changed = keys.iter().filter(|key| before.get(key.name) != after.get(key.name));
    match (changed.next(), changed.next()) {
        (Some(key), None) => key.label.to_owned(),
        _ => whole.to_owned(),
    }
}
