//! Edits: whatever a user changes of a scene goes through one gate, [`super::model::Model::edit`].
//!
//! The rule for all controls: what moves the films (the keys that [`MotionChange`] has) is an event at the clock's tick, and so is what the
//! pointer does to a film; the past stays as it was. At tick 0 nothing has happened yet, and the change is one of how the scene begins.
//! Everything else holds for the whole history: editing it changes the past too, and a film that would have begun differently is blown again.

use super::history;
use crate::scene::{
    Bubble, Camera, Change, Event, FilmIndexName, Generator, Lens, Light, Motion, MotionChange, Scene, View,
};

/// A change of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Another camera.
    Camera(Camera),
    /// Another lens.
    Lens(Lens),
    /// Another view.
    View(View),
    /// Another light.
    Light(Light),
    /// Another generator in the place of one.
    Generator(usize, Box<Generator>),
    /// New lists of bubbles and of generators.
    Films(Vec<Bubble>, Vec<Generator>),
    /// New lists of bubbles and of events: bubbles that are put elsewhere, or are gone with what happens to them.
    Bubbles(Vec<Bubble>, Vec<Event>),
    /// Every film blown again, with a new seed for film and flow.
    Reseed,
    /// Another motion; the keys that can change do so from now on.
    Motion(Box<Motion>),
    /// Something happens now.
    Happens(Change),
    /// Another beginning of the motion, and other events.
    History(Box<Motion>, Vec<Event>),
    /// The history without an event, by its index.
    Forget(usize),
}

impl Edit {
    /// Makes the change at the clock's tick, and returns the one that takes it back.
    pub fn apply(self, scene: &mut Scene, tick: u64) -> Self {
        match self {
            Self::Camera(camera) => Self::Camera(std::mem::replace(&mut scene.camera, camera)),
            Self::Lens(lens) => Self::Lens(std::mem::replace(&mut scene.lens, lens)),
            Self::View(view) => Self::View(std::mem::replace(&mut scene.view, view)),
            Self::Light(light) => Self::Light(std::mem::replace(&mut scene.light, light)),
            Self::Generator(index, generator) => {
                change_films(scene, |scene| put(&mut scene.generators, index, *generator))
            }
            Self::Reseed => change_films(scene, reseed),
            Self::Films(bubbles, generators) => Self::Films(
                std::mem::replace(&mut scene.bubbles, bubbles),
                std::mem::replace(&mut scene.generators, generators),
            ),
            Self::Bubbles(bubbles, events) => Self::Bubbles(
                std::mem::replace(&mut scene.bubbles, bubbles),
                std::mem::replace(&mut scene.events, events),
            ),
            Self::History(motion, events) => {
                let motion = std::mem::replace(&mut scene.motion, *motion);
                Self::History(motion.into(), std::mem::replace(&mut scene.events, events))
            }
            Self::Motion(motion) => {
                let before = Self::History(scene.motion.clone().into(), scene.events.clone());
                move_by(scene, tick, *motion);
                before
            }
            Self::Happens(change) => Self::Forget(history::insert(scene, Event { tick, change })),
            Self::Forget(index) => {
                let before = Self::History(scene.motion.clone().into(), scene.events.clone());
                if index < scene.events.len() {
                    scene.events.remove(index);
                }
                before
            }
        }
    }
}

/// Changes bubbles or generators, and returns what takes it back.
fn change_films(scene: &mut Scene, change: impl FnOnce(&mut Scene)) -> Edit {
    let before = Edit::Films(scene.bubbles.clone(), scene.generators.clone());
    change(scene);
    before
}

/// Puts an item in the place of another, if there is one.
fn put<T>(items: &mut [T], index: usize, item: T) {
    if let Some(slot) = items.get_mut(index) {
        *slot = item;
    }
}

fn reseed(scene: &mut Scene) {
    scene.bubbles.iter_mut().for_each(|bubble| bubble.film.seed = new_seed());
    for generator in &mut scene.generators {
        (generator.seed, generator.film.seed) = (new_seed(), new_seed());
    }
}

/// A seed that was not there before, short enough to be written down.
#[must_use]
pub fn new_seed() -> u64 {
    use std::hash::{BuildHasher, RandomState};
    // Every `RandomState` has other keys, which the system drew at random.
    RandomState::new().hash_one(0) % 100_000
}

/// Puts a motion in force at a tick: what can change while time runs changes from then on, the rest for the whole history.
fn move_by(scene: &mut Scene, tick: u64, motion: Motion) {
    let change = MotionChange::between(&scene.motion_at(tick), &motion);
    scene.motion = MotionChange::all_of(&scene.motion).applied_to(motion);
    if change != MotionChange::default() {
        history::record(scene, tick, change);
    }
}

/// Whether a film begins otherwise than it did, by the owners of all films.
#[must_use]
pub fn begins_anew(before: &[Bubble], after: &[Bubble]) -> bool {
    // What a film is made of, and the size and place of its bubble, shape no film at its beginning.
    let beginning = |bubble: &Bubble| {
        let mut same = Bubble { center_m: [0.0; 3], radius_mm: 1.0, ..bubble.clone() };
        (same.film.index, same.film.skin_nm) = (FilmIndexName::Water, 0.0);
        same
    };
    before.len() != after.len() || before.iter().zip(after).any(|(a, b)| a != b && beginning(a) != beginning(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Flow, Prick, Quality};

    /// Every edit, taken back by what it returns, leaves the scene as it was.
    #[test]
    fn an_edit_returns_its_inverse() {
        let stirred = MotionChange { flow: Some(Flow::Stirred), ..MotionChange::default() };
        let events = vec![Event { tick: 30, change: Change::Motion(stirred) }];
        let scene = Scene { events, generators: vec![Generator::default()], ..Scene::default() };
        let edits = [
            Edit::Camera(Camera { azimuth_deg: 77.0, ..Camera::default() }),
            Edit::Lens(Lens { aperture_mm: 20.0, ..Lens::default() }),
            Edit::View(View { quality: Quality::Fast, ..View::default() }),
            Edit::Light(Light { intensity: 3.0, ..Light::default() }),
            Edit::Films(Vec::new(), vec![Generator::default()]),
            Edit::Bubbles(vec![Bubble::default(); 2], Vec::new()),
            Edit::Generator(0, Generator { count: 7, ..Generator::default() }.into()),
            Edit::Reseed,
            Edit::Motion(Motion { drainage: 7.0, speed: 2.0, ..Motion::default() }.into()),
            Edit::Happens(Change::Prick(Prick::default())),
            Edit::Forget(0),
        ];
        for edit in edits {
            let (mut edited, name) = (scene.clone(), format!("{edit:?}"));
            let back = edit.apply(&mut edited, 60);
            assert_ne!(edited, scene, "{name}");
            back.apply(&mut edited, 60);
            assert_eq!(edited, scene, "{name}");
        }
    }

    #[test]
    fn motion_changes_from_now_on_and_the_method_for_the_whole_history() {
        let mut scene = Scene::default();
        Edit::Motion(Motion { drainage: 7.0, speed: 2.0, ..Motion::default() }.into()).apply(&mut scene, 60);
        assert_eq!([59, 60].map(|tick| scene.motion_at(tick).drainage), [0.0, 7.0]);
        assert_eq!(scene.motion_at(0).speed, 2.0);
    }

    #[test]
    fn a_film_is_blown_again_if_its_beginning_changes() {
        let bubble = Bubble::default();
        let anew = |change: fn(&mut Bubble)| {
            let mut other = bubble.clone();
            change(&mut other);
            begins_anew(std::slice::from_ref(&bubble), &[other])
        };
        assert!(anew(|bubble| bubble.film.thickness_nm = 300.0) && anew(|bubble| bubble.rim_deg = 50.0));
        assert!(!anew(|bubble| bubble.radius_mm = 3.0) && !anew(|bubble| bubble.film.skin_nm = 2.0));
        assert!(begins_anew(&[bubble], &[]));
    }
}
